#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

// The rules of the house that a compiler does not check, read off the sources themselves.
namespace {

namespace fs = std::filesystem;

const fs::path root = WINGBEAT_SOURCE_DIR;
const std::vector<std::string> chain{"core", "partition", "flow", "structure", "adjoint", "optimize", "apps"};
// Within core: what each folder may include besides itself.
const std::map<std::string, std::set<std::string>> core_includes{{"number", {}},
                                                                 {"io", {}},
                                                                 {"parallel", {"io"}},
                                                                 {"mesh", {"number", "io"}},
                                                                 {"algebra", {"parallel", "number", "io"}},
                                                                 {"spectral", {"number", "io"}}};
constexpr std::size_t longest_file = 400;

struct Source {
  std::string path;  // from the root, with '/'
  std::vector<std::string> lines;
};

std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream in(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

const std::vector<Source>& sources() {
  static const std::vector<Source> all = [] {
    std::vector<Source> found;
    auto folders = chain;
    folders.insert(folders.end(), {"test", "benchmarks"});
    for (const std::string& folder : folders) {
      if (!fs::exists(root / folder)) continue;
      for (const auto& entry : fs::recursive_directory_iterator(root / folder))
        if (entry.path().extension() == ".hpp" || entry.path().extension() == ".cpp")
          found.push_back({fs::relative(entry.path(), root).generic_string(), lines_of(entry.path())});
    }
    return found;
  }();
  return all;
}

// Text between the delimiters of an #include line, with its opening one; empty for other lines.
std::string included(const std::string& line) {
  if (line.rfind("#include", 0) != 0) return {};
  const std::size_t open = line.find_first_of("<\"");
  const std::size_t close = open == std::string::npos ? open : line.find_first_of(">\"", open + 1);
  return close == std::string::npos ? std::string() : line.substr(open, close - open);
}

// "core/mesh" of "core/mesh/plot3d.hpp", component by component.
std::vector<std::string> folders_of(const std::string& path) {
  std::vector<std::string> folders;
  std::istringstream in(path);
  for (std::string part; std::getline(in, part, '/');) folders.push_back(part);
  folders.pop_back();
  return folders;
}

std::ptrdiff_t place_in_chain(const std::string& folder) {
  return std::find(chain.begin(), chain.end(), folder) - chain.begin();
}

bool may_include(const std::string& from, const std::string& to) {
  const auto source = folders_of(from), target = folders_of(to);
  if (source.empty() || source[0] == "test" || source[0] == "benchmarks") return true;
  if (target.empty() || place_in_chain(target[0]) > place_in_chain(source[0])) return false;
  if (source[0] != "core" || target[0] != "core") return true;
  return source.size() > 1 && target.size() > 1 &&
         (source[1] == target[1] ||
          (core_includes.count(source[1]) && core_includes.at(source[1]).count(target[1])));
}

// Tests may name communicators, which Comm takes.
bool is_test(const std::string& path) { return path.starts_with("test/"); }

bool may_see_mpi(const std::string& path) {
  return path.rfind("core/parallel/", 0) == 0 || path.rfind("partition/", 0) == 0 ||
         path == "test/main.cpp" || path.rfind("test/core/parallel/", 0) == 0;
}

// Ipopt's headers are named Ip..., in capitals as none of ours are.
bool is_ipopt_header(const std::string& include) {
  const std::string name =
      fs::path(include.substr(std::min<std::size_t>(1, include.size()))).filename().string();
  return name.starts_with("Ip");
}

// Labels "eq:name" that follow `before` in a line.
std::vector<std::string> labels(const std::string& line, const std::string& before = "") {
  std::vector<std::string> found;
  const std::string start = before + "eq:";
  for (std::size_t at = line.find(start); at != std::string::npos; at = line.find(start, at + 1)) {
    const std::size_t name = at + before.size();
    const std::size_t end = line.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-", name + 3);
    const std::string label = line.substr(name, end == std::string::npos ? end : end - name);
    if (label.size() > 3) found.push_back(label);
  }
  return found;
}

TEST(Architecture, TheRulesThemselvesTellRightFromWrong) {
  EXPECT_TRUE(may_include("flow/gas.hpp", "core/number/vec.hpp"));
  EXPECT_FALSE(may_include("flow/gas.hpp", "structure/energy.hpp"));
  EXPECT_FALSE(may_include("core/mesh/plot3d.cpp", "core/algebra/gmres.hpp"));
  EXPECT_FALSE(may_include("core/io/log.cpp", "partition/partition.hpp"));
  EXPECT_FALSE(may_include("flow/gas.hpp", "gas.hpp")) << "includes start at the project root";
  EXPECT_EQ(included("#include \"flow/gas.hpp\""), "\"flow/gas.hpp");
  EXPECT_EQ(included("#include <mpi.h>"), "<mpi.h");
  EXPECT_TRUE(is_ipopt_header("<IpTNLP.hpp"));
  EXPECT_TRUE(is_ipopt_header("<coin/IpTNLP.hpp"));
  EXPECT_FALSE(is_ipopt_header("\"optimize/ipopt_adapter.hpp"));
  EXPECT_EQ(labels("(eq:jst-sensor), eq:jst.").size(), 2U);
  EXPECT_EQ(labels("<a id=\"eq:gas\"></a> (`eq:gas`)", "id=\""), std::vector<std::string>{"eq:gas"});
  EXPECT_GE(sources().size(), 100U);
}

TEST(Architecture, IncludesFollowTheChainOfFolders) {
  for (const Source& source : sources())
    for (const std::string& line : source.lines) {
      const std::string target = included(line);
      if (target.empty() || target[0] != '"') continue;
      EXPECT_TRUE(may_include(source.path, target.substr(1))) << source.path << ": " << line;
      EXPECT_TRUE(fs::exists(root / target.substr(1))) << source.path << ": " << line;
    }
}

TEST(Architecture, OnlyParallelAndPartitionSeeMpi) {
  const std::regex mpi_name("\\bMPI_[A-Z]");
  for (const Source& source : sources())
    for (const std::string& line : source.lines) {
      const bool uses_mpi =
          included(line) == "<mpi.h" || (!is_test(source.path) && std::regex_search(line, mpi_name));
      EXPECT_TRUE(!uses_mpi || may_see_mpi(source.path)) << source.path << ": " << line;
    }
}

TEST(Architecture, OnlyTheAdapterSeesIpopt) {
  for (const Source& source : sources())
    for (const std::string& line : source.lines)
      EXPECT_TRUE(!is_ipopt_header(included(line)) || source.path == "optimize/ipopt_adapter.cpp")
          << source.path << ": " << line;
}

TEST(Architecture, FilesStayShort) {
  for (const Source& source : sources())
    EXPECT_LE(source.lines.size(), longest_file) << source.path << ": one concept a file";
}

TEST(Architecture, EveryCitedEquationStandsInTheTheory) {
  std::map<std::string, int> defined;
  std::set<std::string> linked;
  for (const std::string& line : lines_of(root / "docs/theory.md")) {
    for (const std::string& label : labels(line, "id=\"")) ++defined[label];
    for (const std::string& label : labels(line, "](#")) linked.insert(label);
  }
  ASSERT_FALSE(defined.empty()) << "docs/theory.md defines no equations";
  for (const auto& [label, count] : defined) EXPECT_EQ(count, 1) << label << " is defined more than once";
  for (const std::string& label : linked)
    EXPECT_TRUE(defined.count(label)) << label << " is linked, not defined";
  for (const Source& source : sources()) {
    if (source.path == "test/architecture_test.cpp") continue;
    for (const std::string& line : source.lines)
      for (const std::string& label : labels(line))
        EXPECT_TRUE(defined.count(label))
            << source.path << " cites " << label << ", which docs/theory.md lacks";
  }
}

TEST(Architecture, LinksOfThePagesLeadSomewhere) {
  std::vector<fs::path> pages{root / "README.md"};
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  const std::regex link("\\]\\(([^)#:]+)(#[^)]*)?\\)");
  std::size_t count = 0;
  for (const fs::path& page : pages)
    for (const std::string& line : lines_of(page))
      for (std::sregex_iterator match(line.begin(), line.end(), link), end; match != end; ++match, ++count)
        EXPECT_TRUE(fs::exists(page.parent_path() / (*match)[1].str()))
            << page << " links to " << (*match)[1];
  EXPECT_GT(count, 10U);
}

}  // namespace
