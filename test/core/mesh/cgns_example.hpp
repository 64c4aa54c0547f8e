#pragma once

#include <cgnslib.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/mesh_file.hpp"
#include "test/core/mesh/message.hpp"
#include "test/core/mesh/temporary_folder.hpp"

// CGNS files that other programs might have written.
namespace wingbeat::example {

inline void copy_as_adf(const std::filesystem::path& from, const std::filesystem::path& to) {
  int fn = 0;
  ASSERT_EQ(cg_open(from.c_str(), CG_MODE_READ, &fn), CG_OK);
  ASSERT_EQ(cg_save_as(fn, to.c_str(), CG_FILE_ADF, 0), CG_OK);
  ASSERT_EQ(cg_close(fn), CG_OK);
}

// Changes a file through the library, as another program might have written it.
inline void edit(const std::filesystem::path& path, const std::function<void(int fn)>& change) {
  int fn = 0;
  ASSERT_EQ(cg_open(path.c_str(), CG_MODE_MODIFY, &fn), CG_OK) << cg_get_error();
  change(fn);
  ASSERT_EQ(cg_close(fn), CG_OK) << cg_get_error();
}

// A file written by other means than write_cgns: one zone, as told.
struct RawFile {
  int cell_dim = 2;
  int physical_dim = 2;
  std::vector<cgsize_t> size{3, 3, 2, 2, 0, 0};
  ZoneType_t type = Structured;
  std::vector<std::pair<std::string, std::vector<float>>> coordinates;
  struct Patch {
    std::string name;
    BCType_t type = BCFarfield;
    std::vector<cgsize_t> range;
    GridLocation_t location = Vertex;
    PointSetType_t points = PointRange;
  };
  std::vector<Patch> patches;

  void write(const std::filesystem::path& path) const {
    int fn = 0, base = 0, zone = 0, n = 0;
    cg_set_file_type(CG_FILE_ADF);
    ASSERT_EQ(cg_open(path.c_str(), CG_MODE_WRITE, &fn), CG_OK);
    ASSERT_EQ(cg_base_write(fn, "Base", cell_dim, physical_dim, &base), CG_OK);
    ASSERT_EQ(cg_zone_write(fn, base, "raw", size.data(), type, &zone), CG_OK) << cg_get_error();
    for (const auto& [name, values] : coordinates)
      ASSERT_EQ(cg_coord_write(fn, base, zone, RealSingle, name.c_str(), values.data(), &n), CG_OK);
    for (const Patch& patch : patches) {
      const auto count = static_cast<cgsize_t>(patch.range.size()) / cell_dim;
      ASSERT_EQ(cg_boco_write(fn, base, zone, patch.name.c_str(), patch.type, patch.points, count,
                              patch.range.data(), &n),
                CG_OK)
          << cg_get_error();
      if (patch.location != Vertex) {
        ASSERT_EQ(cg_boco_gridlocation_write(fn, base, zone, n, patch.location), CG_OK) << cg_get_error();
      }
    }
    ASSERT_EQ(cg_close(fn), CG_OK);
  }
};

// The unit square of 2 x 2 cells between far-field sides, in single precision.
inline RawFile raw_square() {
  RawFile raw;
  raw.coordinates = {{"CoordinateX", {0, .5F, 1, 0, .5F, 1, 0, .5F, 1}},
                     {"CoordinateY", {0, 0, 0, .5F, .5F, .5F, 1, 1, 1}}};
  raw.patches = {{"west", BCFarfield, {1, 1, 1, 3}},
                 {"east", BCFarfield, {3, 1, 3, 3}},
                 {"south", BCWallViscous, {1, 1, 3, 1}},
                 {"north", BCFarfield, {1, 3, 3, 3}}};
  return raw;
}

inline std::string refusal(const RawFile& raw, const TemporaryFolder& folder) {
  raw.write(folder / "raw.cgns");
  return message_of([&] { read_mesh(folder / "raw.cgns"); });
}

}  // namespace wingbeat::example
