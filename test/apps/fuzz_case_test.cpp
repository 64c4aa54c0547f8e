#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "test/apps/fuzz.hpp"
#include "test/apps/mutation.hpp"

namespace wingbeat {
namespace {

namespace fs = std::filesystem;

// Whatever a case holds, the program reads it or says what is wrong with it.
class FuzzedCases : public Fuzz {
 protected:
  // The example cases as they are, and as the program gives them back, with every key.
  std::vector<std::string> example_cases() const {
    std::vector<std::string> texts;
    for (const auto& entry : fs::directory_iterator(fs::path(WINGBEAT_SOURCE_DIR) / "apps/cases")) {
      const fs::path path = entry.path() / "case.toml";
      std::ifstream stream(path);
      texts.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
      texts.push_back(run({"steady", path.string(), "--dry-run"}).output);
    }
    std::ranges::sort(texts);
    return texts;
  }

  static std::string fault_in(const End& end) {
    if (end.hangs()) return std::string("hangs");
    if (end.signal != 0) return std::string("killed by signal ").append(std::to_string(end.signal));
    if (end.exit_code != 0 && end.exit_code != 2)
      return std::string("exit code ").append(std::to_string(end.exit_code));
    return end.exit_code == 2 && end.errors.empty() ? std::string("refused without a word") : std::string();
  }
  std::string fault_of(const std::string& verb, const std::string& text, const std::string& subfolder) const {
    write(subfolder + "/case.toml", text);
    const End end = end_of(subfolder, {verb, "case.toml", "--dry-run"});
    std::string fault = fault_in(end);
    if (fault.empty()) return fault;
    std::ostringstream report;
    report << "wingbeat " << verb << " case.toml --dry-run " << fault << '\n'
           << end.errors.substr(0, 2000) << '\n'
           << text.substr(0, 20000);
    return report.str();
  }

  const std::vector<std::string> verbs_{"steady",   "pitch",    "flutter", "lco",  "march",    "pk",
                                        "gradient", "optimize", "sweep",   "mesh", "partition"};
};

TEST_F(FuzzedCases, AreReadOrRefused) {
  const std::vector<std::string> texts = example_cases();
  ASSERT_GE(texts.size(), 10U);
  attempt_all(first_seed(1), attempts(500, 10000), [&](unsigned seed, const std::string& subfolder) {
    Mutation mutation(seed);
    const std::string verb = mutation.one_of(verbs_);
    return fault_of(verb, mutation.of_case(texts), subfolder);
  });
}

// The same judgement of programs that fail in each way.
TEST_F(FuzzedCases, AreNotTakenForWellWhereTheProgramCrashesOrHangs) {
  program_ = std::string(WINGBEAT_WITH_FAKE_VERBS);
  fs::create_directories(folder_ / "a");
  EXPECT_EQ(fault_of("succeed", "", "a"), "");
  EXPECT_EQ(fault_of("succeed", "[", "a"), "");
  program_ = std::string("/bin/false");
  expect_in("exit code 1", fault_of("steady", "", "a"));
  write("crash", "#!/bin/sh\nkill -SEGV $$\n");
  write("hang", "#!/bin/sh\nkill -XCPU $$\n");
  write("silent", "#!/bin/sh\nexit 2\n");
  for (const auto& [name, fault] : {std::pair("crash", "killed by signal 11"), std::pair("hang", "hangs"),
                                    std::pair("silent", "refused without a word")}) {
    program_ = (folder_ / name).string();
    fs::permissions(program_, fs::perms::owner_all);
    expect_in(fault, fault_of("steady", "", "a"));
  }
}

}  // namespace
}  // namespace wingbeat
