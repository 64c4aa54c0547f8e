#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

// Rules of the sources that no compiler checks.
namespace wingbeat {
namespace {

namespace fs = std::filesystem;

constexpr std::array chain{"core", "partition", "flow", "structure", "adjoint", "optimize", "apps"};

std::string text_of(const fs::path& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Calls f(path, text, place in the chain) for every source of the library and the program.
void for_each_source(const std::function<void(const fs::path&, const std::string&, std::size_t)>& f) {
  const fs::path root = WINGBEAT_SOURCE_DIR;
  for (std::size_t place = 0; place < chain.size(); ++place) {
    if (!fs::exists(root / chain[place])) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / chain[place])) {
      const auto extension = entry.path().extension();
      if (extension == ".hpp" || extension == ".cpp") f(entry.path(), text_of(entry.path()), place);
    }
  }
}

std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    found.push_back((*match)[1]);
  return found;
}

TEST(SourceTree, FoldersIncludeOnlyThoseBeforeThem) {
  std::size_t count = 0;
  for_each_source([&](const fs::path& path, const std::string& text, std::size_t place) {
    for (const auto& folder : matches(text, std::regex("#include \"([a-z]+)/"))) {
      const auto included = std::ranges::find(chain, folder);
      ASSERT_NE(included, chain.end()) << path << " includes " << folder;
      EXPECT_LE(static_cast<std::size_t>(included - chain.begin()), place) << path << " includes " << folder;
      ++count;
    }
  });
  EXPECT_GT(count, 50u);
}

TEST(SourceTree, OnlyParallelAndPartitionSeeMpi) {
  for_each_source([](const fs::path& path, const std::string& text, std::size_t) {
    const std::string folder = fs::relative(path.parent_path(), WINGBEAT_SOURCE_DIR).string();
    if (folder == "core/parallel" || folder.starts_with("partition")) return;
    EXPECT_EQ(text.find("<mpi.h>"), std::string::npos) << path;
    EXPECT_EQ(text.find("MPI_"), std::string::npos) << path;
  });
}

TEST(SourceTree, EveryEquationThatCodeCitesIsInTheTheory) {
  const std::regex label("(eq:[a-z0-9-]+)");
  const auto listed =
      matches(text_of(fs::path(WINGBEAT_SOURCE_DIR) / "docs/theory.md"), std::regex("`(eq:[a-z0-9-]+)`"));
  const std::set<std::string> theory(listed.begin(), listed.end());
  EXPECT_EQ(theory.size(), listed.size()) << "a label is defined twice";
  for_each_source([&](const fs::path& path, const std::string& text, std::size_t) {
    for (const auto& cited : matches(text, label))
      EXPECT_TRUE(theory.contains(cited)) << path << " cites " << cited;
  });
}

TEST(SourceTree, LinksOfThePagesLeadSomewhere) {
  const fs::path root = WINGBEAT_SOURCE_DIR;
  std::vector<fs::path> pages{root / "README.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  for (const auto& page : pages)
    for (const auto& link : matches(text_of(page), std::regex("\\]\\(([^)#:]+)\\)")))
      EXPECT_TRUE(fs::exists(page.parent_path() / link)) << page << " links to " << link;
}

}  // namespace
}  // namespace wingbeat
