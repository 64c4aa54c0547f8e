#include "core/mesh/cgns_file.hpp"

#include <cgnslib.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <utility>

#include "core/io/error.hpp"

namespace wingbeat {

namespace fs = std::filesystem;

namespace {

// HDF5 would tidy up at the program's exit, and crashes there over a file that a full disk kept it from
// closing. It must be told before its first call; looked up at run time, since nothing here links it but the
// CGNS library.
void keep_hdf5_from_exit() {
  using DontAtExit = int (*)();
  static const bool told = [] {
    if (void* symbol = dlsym(RTLD_DEFAULT, "H5dont_atexit")) reinterpret_cast<DontAtExit>(symbol)();
    return true;
  }();
  static_cast<void>(told);
}

}  // namespace

CgnsFile CgnsFile::open(const fs::path& path) {
  // The library's message for both is about its own file format.
  if (!fs::exists(path)) throw InputError(fmt::format("{}: no such file", path.string()));
  if (!fs::is_regular_file(path)) throw InputError(fmt::format("{}: not a regular file", path.string()));
  keep_hdf5_from_exit();
  int number = -1;
  if (cg_open(path.c_str(), CG_MODE_READ, &number) != CG_OK)
    throw InputError(
        fmt::format("{}: not a readable CGNS file (ADF or HDF5): {}", path.string(), cg_get_error()));
  return {number, path.string(), static_cast<double>(fs::file_size(path))};
}

CgnsFile CgnsFile::create(const fs::path& path, const fs::path& reported) {
  keep_hdf5_from_exit();
  int number = -1;
  if (cg_set_file_type(CG_FILE_HDF5) != CG_OK || cg_open(path.c_str(), CG_MODE_WRITE, &number) != CG_OK)
    throw InputError(fmt::format("{}: cannot create the file: {}", reported.string(), cg_get_error()));
  return {number, reported.string(), 0.0};
}

CgnsFile::CgnsFile(CgnsFile&& other) noexcept
    : number_(std::exchange(other.number_, -1)), name_(std::move(other.name_)), bytes_(other.bytes_) {}

CgnsFile::~CgnsFile() {
  if (number_ >= 0) cg_close(number_);
}

void CgnsFile::check(int status, const std::string& doing) const {
  if (status != CG_OK) refuse(fmt::format("{}: {}", doing, cg_get_error()));
}

void CgnsFile::refuse(const std::string& message) const { throw InputError(name_ + ": " + message); }

void CgnsFile::check_count(double values, const std::string& where) const {
  constexpr double densest = 1000.0;  // values a byte, in a file that is compressed
  if (!(values >= 0.0 && values <= densest * bytes_))
    refuse(fmt::format("{}: tells of {:.6g} values in a file of {:.0f} bytes; it is damaged", where, values,
                       bytes_));
}

void CgnsFile::close() { check(cg_close(std::exchange(number_, -1)), "cannot finish writing"); }

}  // namespace wingbeat
