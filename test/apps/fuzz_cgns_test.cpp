#include <algorithm>
#include <sstream>

#include "test/apps/fuzz.hpp"
#include "test/apps/mutation.hpp"

namespace wingbeat {
namespace {

// Meshes and solutions with damaged bytes are read or refused.
class FuzzedCgns : public Fuzz {
 protected:
  void SetUp() override {
    Fuzz::SetUp();
    write("case.toml", section_ + "airfoil = \"naca0012\"\ncells = [16, 4]\nblocks = 2\n" + flow_);
    ASSERT_EQ(run({"mesh", "case.toml", "--output", "out"}).exit_code, 0);
    ASSERT_EQ(run({"steady", "case.toml", "--output", "out"}).exit_code, 0);
    for (const std::string folder : {"a", "b", "c", "d"}) {
      write(folder + "/mesh.toml", section_ + "file = \"damaged.cgns\"\n" + flow_);
      write(folder + "/restart.toml", read("case.toml"));
    }
  }

  std::string fault_of(const std::string& subfolder, const std::vector<std::string>& arguments,
                       const std::vector<int>& allowed) const {
    const End end = end_of(subfolder, arguments);
    const bool is_allowed = std::ranges::find(allowed, end.exit_code) != allowed.end();
    if (end.signal == 0 && is_allowed) return {};
    std::ostringstream report;
    if (end.hangs())
      report << "hangs";
    else if (end.signal != 0)
      report << "killed by signal " << end.signal;
    else
      report << "exit code " << end.exit_code;
    report << '\n' << end.errors;
    return report.str();
  }
  std::string damaged(const std::string& name, unsigned seed) const {
    Mutation mutation(seed);
    const std::string bytes = read(name);
    return mutation.of_bytes(bytes, std::min<std::size_t>(bytes.size(), 8192));
  }

  const std::string section_ = "[mesh]\n", flow_ = "[flow]\nmach = 0.5\n";
};

TEST_F(FuzzedCgns, MeshesAreReadOrRefused) {
  attempt_all(first_seed(1), attempts(100, 5000), [&](unsigned seed, const std::string& subfolder) {
    write(subfolder + "/damaged.cgns", damaged("out/mesh.cgns", seed));
    return fault_of(subfolder, {"steady", "mesh.toml", "--dry-run"}, {0, 2});
  });
}

TEST_F(FuzzedCgns, SolutionsAreStartedFromOrRefused) {
  attempt_all(first_seed(1), attempts(100, 5000), [&](unsigned seed, const std::string& subfolder) {
    write(subfolder + "/damaged.cgns", damaged("out/solution.cgns", seed));
    return fault_of(subfolder,
                    {"steady", "restart.toml", "--output", "out", "--restart", "damaged.cgns",
                     "solver.max_steady_iterations=1"},
                    {0, 1, 2});
  });
}

}  // namespace
}  // namespace wingbeat
