#include "core/mesh/solution_file.hpp"

#include <cgnslib.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

#include "core/mesh/cgns_mesh.hpp"
#include "test/core/mesh/example_meshes.hpp"
#include "test/core/mesh/message.hpp"
#include "test/core/mesh/temporary_folder.hpp"

namespace wingbeat {
namespace {

using namespace example;

// Numbers without a short decimal form, different everywhere.
template <int Dim>
Solution<Dim> example_solution(const MultiblockMesh<Dim>& mesh, int instances, bool moving) {
  Solution<Dim> solution;
  int seed = 0;
  const auto next = [&] { return std::sin(++seed) / 3.0; };
  for (int n = 0; n < instances; ++n) {
    SolutionInstance<Dim> instance{2.0 * n / instances, {}};
    for (const Zone<Dim>& zone : mesh.zones) {
      ZoneSolution<Dim> now;
      for (const char* name : {"Density", "MomentumX", "MomentumY", "EnergyStagnationDensity"}) {
        now.fields.push_back({name, std::vector<double>(box_of<Dim>(zone.cells).size())});
        for (double& value : now.fields.back().values) value = next();
      }
      if (moving)
        for_each<Dim>(zone.nodes.interior(), [&](const Index<Dim>& node) {
          now.nodes.push_back(zone.nodes(node));
          now.nodes.back()[0] += 0.01 * next();
        });
      instance.zones.push_back(std::move(now));
    }
    solution.instances.push_back(std::move(instance));
  }
  solution.data = {{"omega", {0.64732 / 3.0}}, {"r", {7.3e-9 / 3.0}}, {"y", {}}};
  for (int i = 0; i < 4 * instances; ++i) solution.data["y"].push_back(next());
  solution.text = {{"case", "flow.mach = 0.8\nmesh.airfoil = \"naca0012\"\n"}, {"stage", "steady flow"}};
  return solution;
}

template <int Dim>
void expect_equal(const Solution<Dim>& a, const Solution<Dim>& b) {
  EXPECT_EQ(a.data, b.data);
  EXPECT_EQ(a.text, b.text);
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t n = 0; n < a.instances.size(); ++n) {
    EXPECT_EQ(a.instances[n].time, b.instances[n].time);
    ASSERT_EQ(a.instances[n].zones.size(), b.instances[n].zones.size());
    for (std::size_t z = 0; z < a.instances[n].zones.size(); ++z) {
      const ZoneSolution<Dim>& p = a.instances[n].zones[z];
      const ZoneSolution<Dim>& q = b.instances[n].zones[z];
      EXPECT_EQ(p.nodes, q.nodes);
      ASSERT_EQ(p.fields.size(), q.fields.size());
      for (std::size_t f = 0; f < p.fields.size(); ++f) {
        EXPECT_EQ(p.fields[f].name, q.fields[f].name);
        EXPECT_EQ(p.fields[f].values, q.fields[f].values);
      }
    }
  }
}

TEST(SolutionFile, RestartsFromTheSameBits) {
  const TemporaryFolder folder;
  const auto check = [&]<int Dim>(const MultiblockMesh<Dim>& mesh, int instances, bool moving) {
    const Solution<Dim> solution = example_solution<Dim>(mesh, instances, moving);
    write_solution(folder / "solution.cgns", mesh, solution);
    expect_equal<Dim>(read_solution<Dim>(folder / "solution.cgns", mesh), solution);
    EXPECT_TRUE(same(std::get<MultiblockMesh<Dim>>(read_cgns(folder / "solution.cgns")), mesh));
  };
  check(ring(8, 3), 3, true);
  check(row_of_blocks<2>(12, {2, 3}), 11, false);
  check(row_of_blocks<3>(2, {2, 3, 4}), 5, true);
  check(row_of_blocks<3>(2, {2, 3, 4}), 1, false);
  EXPECT_EQ(folder.file_count(), 2U) << "the last and the one before";
}

// The nodes that a viewer follows from one step to the next.
TEST(SolutionFile, IsATimeSeriesForViewers) {
  const TemporaryFolder folder;
  const MultiblockMesh<2> mesh = ring(8, 3);
  write_solution(folder / "solution.cgns", mesh, example_solution<2>(mesh, 3, true));
  int fn = 0;
  int steps = 0;
  std::array<char, 33> name{};
  ASSERT_EQ(cg_open((folder / "solution.cgns").c_str(), CG_MODE_READ, &fn), CG_OK);
  ASSERT_EQ(cg_biter_read(fn, 1, name.data(), &steps), CG_OK);
  EXPECT_EQ(steps, 3);
  ASSERT_EQ(cg_goto(fn, 1, "BaseIterativeData_t", 1, "end"), CG_OK);
  std::array<double, 3> times{};
  ASSERT_EQ(cg_array_read(1, times.data()), CG_OK);
  EXPECT_EQ(times, (std::array<double, 3>{0.0, 2.0 / 3.0, 4.0 / 3.0}));

  ASSERT_EQ(cg_goto(fn, 1, "Zone_t", 1, "ZoneIterativeData_t", 1, "end"), CG_OK);
  const std::array<std::string, 2> arrays{"FlowSolutionPointers", "GridCoordinatesPointers"};
  const std::array<std::string, 2> targets{"FlowSolution", "GridCoordinates"};
  for (std::size_t a = 0; a < 2; ++a) {
    DataType_t type{};
    int dimension = 0;
    std::array<cgsize_t, 12> size{};
    ASSERT_EQ(cg_array_info(static_cast<int>(a) + 1, name.data(), &type, &dimension, size.data()), CG_OK);
    EXPECT_EQ(name.data(), arrays[a]);
    ASSERT_EQ(dimension, 2);
    ASSERT_EQ(size[0], 32);
    ASSERT_EQ(size[1], 3);
    std::string pointers(96, '?');
    ASSERT_EQ(cg_array_read(static_cast<int>(a) + 1, pointers.data()), CG_OK);
    for (std::size_t n = 0; n < 3; ++n) {
      std::string expected = targets[a] + std::to_string(n + 1);
      expected.resize(32, ' ');
      EXPECT_EQ(pointers.substr(32 * n, 32), expected);
    }
  }
  std::array<char, 33> solution{};
  GridLocation_t location{};
  ASSERT_EQ(cg_sol_info(fn, 1, 1, 1, solution.data(), &location), CG_OK);
  EXPECT_EQ(location, CellCenter);
  EXPECT_EQ(std::string(solution.data()), "FlowSolution1");
  cg_close(fn);
}

TEST(SolutionFile, RefusesTheSolutionOfAnotherMesh) {
  const TemporaryFolder folder;
  const MultiblockMesh<2> mesh = ring(8, 3);
  write_solution(folder / "solution.cgns", mesh, example_solution<2>(mesh, 1, false));
  const auto read_for = [&]<int Dim>(const MultiblockMesh<Dim>& other) {
    return message_of([&] { read_solution<Dim>(folder / "solution.cgns", other); });
  };
  expect_contains(read_for(ring(8, 4)),
                  "solution.cgns: zone 'ring': has 4 nodes in direction j, the mesh has 5");
  expect_contains(read_for(ring(8, 3, "disc")), "has no zone 'disc': it is the solution of another mesh");
  expect_contains(read_for(row_of_blocks<2>(2, {8, 3})), "has 1 zones, the mesh has 2");
  expect_contains(read_for(row_of_blocks<3>(1, {8, 3, 2})), "its CellDim is 2, the mesh has 3 dimensions");
}

TEST(SolutionFile, RefusesAMeshWithoutSolution) {
  const TemporaryFolder folder;
  write_cgns(ring(8, 3), folder / "mesh.cgns");
  expect_contains(message_of([&] { read_solution<2>(folder / "mesh.cgns", ring(8, 3)); }),
                  "mesh.cgns: holds no solution");
}

TEST(SolutionFile, LeavesTheOldFileWhereTheNewOneFails) {
  const TemporaryFolder folder;
  const MultiblockMesh<2> mesh = ring(8, 3);
  const Solution<2> old = example_solution<2>(mesh, 2, true);
  write_solution(folder / "solution.cgns", mesh, old);
  MultiblockMesh<2> unwritable = mesh;
  unwritable.zones[0].patches[1].name = unwritable.zones[0].patches[0].name;
  EXPECT_THROW(write_solution(folder / "solution.cgns", unwritable, old), InputError);
  expect_equal<2>(read_solution<2>(folder / "solution.cgns", mesh), old);
  EXPECT_EQ(folder.file_count(), 1U);
}

TEST(SolutionFile, KeepsTheOneBefore) {
  const TemporaryFolder folder;
  const MultiblockMesh<2> mesh = ring(8, 3);
  EXPECT_EQ(previous_solution("a/solution.cgns"), std::filesystem::path("a/solution.previous.cgns"));
  for (const double omega : {1.0, 2.0, 3.0}) {
    Solution<2> solution = example_solution<2>(mesh, 1, false);
    solution.data["omega"] = {omega};
    write_solution(folder / "solution.cgns", mesh, solution);
  }
  const auto omega_in = [&](const char* name) {
    return read_solution<2>(folder / name, mesh).data.at("omega");
  };
  EXPECT_EQ(omega_in("solution.cgns"), std::vector<double>{3.0});
  EXPECT_EQ(omega_in("solution.previous.cgns"), std::vector<double>{2.0});
  EXPECT_EQ(folder.file_count(), 2U);
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Where the bytes of a number stand in the file, another takes its place.
TEST(SolutionFile, RefusesDamage) {
  const TemporaryFolder folder;
  const MultiblockMesh<2> mesh = ring(8, 3);
  const Solution<2> solution = example_solution<2>(mesh, 2, true);
  write_solution(folder / "solution.cgns", mesh, solution);
  const std::string whole = bytes_of(folder / "solution.cgns");
  const auto read_with = [&](const std::string& bytes) {
    std::ofstream(folder / "damaged.cgns", std::ios::binary) << bytes;
    return message_of([&] { read_solution<2>(folder / "damaged.cgns", mesh); });
  };
  EXPECT_EQ(read_with(whole), "");
  const auto& values = solution.instances[1].zones[0].fields[2].values;
  const std::string number(reinterpret_cast<const char*>(&values[5]), sizeof(double));
  const auto at = whole.find(number);
  ASSERT_NE(at, std::string::npos);
  for (const std::size_t bit : {0U, 40U, 63U}) {
    std::string flipped = whole;
    flipped[at + bit / 8] = static_cast<char>(flipped[at + bit / 8] ^ (1 << bit % 8));
    expect_contains(read_with(flipped),
                    "damaged.cgns: is damaged: its numbers are not those that were written; "
                    "take damaged.previous.cgns");
  }
  for (const double share : {0.0, 0.1, 0.5, 0.9, 0.999})
    EXPECT_NE(read_with(whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size())))),
              "")
        << "cut off at " << share;
}

TEST(SolutionFile, RefusesAFormatOfTheFuture) {
  const TemporaryFolder folder;
  const MultiblockMesh<2> mesh = ring(8, 3);
  write_solution(folder / "solution.cgns", mesh, example_solution<2>(mesh, 1, false));
  int fn = 0;
  ASSERT_EQ(cg_open((folder / "solution.cgns").c_str(), CG_MODE_MODIFY, &fn), CG_OK);
  ASSERT_EQ(cg_goto(fn, 1, "RestartData", 0, "end"), CG_OK);
  ASSERT_EQ(cg_delete_node("format"), CG_OK);
  const cgsize_t one = 1;
  const double number = 7.0;
  ASSERT_EQ(cg_array_write("format", RealDouble, 1, &one, &number), CG_OK);
  ASSERT_EQ(cg_close(fn), CG_OK);
  expect_contains(message_of([&] { read_solution<2>(folder / "solution.cgns", mesh); }),
                  "its format has the number 7, this version reads 1");
}

TEST(SolutionFile, HoldsOnlyWholeSolutions) {
  const TemporaryFolder folder;
  const MultiblockMesh<2> mesh = ring(8, 3);
  Solution<2> solution = example_solution<2>(mesh, 2, false);
  solution.instances[1].zones[0].fields[2].values.pop_back();
  EXPECT_THROW(write_solution(folder / "solution.cgns", mesh, solution), InternalError);
  solution = example_solution<2>(mesh, 2, true);
  solution.instances[1].zones[0].nodes.clear();
  EXPECT_THROW(write_solution(folder / "solution.cgns", mesh, solution), InternalError);
  EXPECT_EQ(folder.file_count(), 0U);
}

}  // namespace
}  // namespace wingbeat
