#include "core/mesh/cgns_file.hpp"

#include <cgnslib.h>
#include <fmt/format.h>

#include <utility>

#include "core/io/error.hpp"

namespace wingbeat {

namespace fs = std::filesystem;

CgnsFile CgnsFile::open(const fs::path& path) {
  // The library's message for both is about its own file format.
  if (!fs::exists(path)) throw InputError(fmt::format("{}: no such file", path.string()));
  if (!fs::is_regular_file(path)) throw InputError(fmt::format("{}: not a regular file", path.string()));
  int number = -1;
  if (cg_open(path.c_str(), CG_MODE_READ, &number) != CG_OK)
    throw InputError(
        fmt::format("{}: not a readable CGNS file (ADF or HDF5): {}", path.string(), cg_get_error()));
  return {number, path.string()};
}

CgnsFile CgnsFile::create(const fs::path& path, const fs::path& reported) {
  int number = -1;
  if (cg_set_file_type(CG_FILE_HDF5) != CG_OK || cg_open(path.c_str(), CG_MODE_WRITE, &number) != CG_OK)
    throw InputError(fmt::format("{}: cannot create the file: {}", reported.string(), cg_get_error()));
  return {number, reported.string()};
}

CgnsFile::CgnsFile(CgnsFile&& other) noexcept
    : number_(std::exchange(other.number_, -1)), name_(std::move(other.name_)) {}

CgnsFile::~CgnsFile() {
  if (number_ >= 0) cg_close(number_);
}

void CgnsFile::check(int status, const std::string& doing) const {
  if (status != CG_OK) refuse(fmt::format("{}: {}", doing, cg_get_error()));
}

void CgnsFile::refuse(const std::string& message) const { throw InputError(name_ + ": " + message); }

void CgnsFile::close() { check(cg_close(std::exchange(number_, -1)), "cannot finish writing"); }

}  // namespace wingbeat
