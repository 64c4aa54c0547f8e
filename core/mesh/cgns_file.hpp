#pragma once

#include <filesystem>
#include <string>

namespace wingbeat {

// An open CGNS file. Closed when it goes out of scope; every failure of the library becomes an
// InputError that names the file, what was being done, and the library's own message.
class CgnsFile {
 public:
  // Opens an existing file, ADF or HDF5, for reading.
  static CgnsFile open(const std::filesystem::path& path);
  // Creates an HDF5 file, replacing an existing one. `reported` is the name that errors tell.
  static CgnsFile create(const std::filesystem::path& path, const std::filesystem::path& reported);

  CgnsFile(CgnsFile&& other) noexcept;
  CgnsFile& operator=(CgnsFile&&) = delete;
  ~CgnsFile();

  int number() const { return number_; }
  const std::string& name() const { return name_; }

  // Throws unless `status`, a library call's result, is success.
  void check(int status, const std::string& doing) const;
  // Throws an InputError about this file.
  [[noreturn]] void refuse(const std::string& message) const;
  // Refuses a file that tells of more values than its bytes can hold, however packed: such numbers are damaged,
  // and memory for them is not to be had.
  void check_count(double values, const std::string& where) const;
  // Writes what is buffered and closes, reporting failure, which the destructor cannot.
  void close();

 private:
  CgnsFile(int number, std::string name, double bytes)
      : number_(number), name_(std::move(name)), bytes_(bytes) {}

  int number_ = -1;
  std::string name_;
  double bytes_ = 0.0;
};

}  // namespace wingbeat
