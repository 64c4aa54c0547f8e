#pragma once

#include <mpi.h>

#include <complex>
#include <source_location>

namespace wingbeat {

// Throws InternalError with rank, place and MPI's own words unless `code` is MPI_SUCCESS.
void check_mpi(int code, std::source_location where = std::source_location::current());

// The MPI name of a C++ type.
template <class T>
MPI_Datatype mpi_type();
template <>
inline MPI_Datatype mpi_type<int>() {
  return MPI_INT;
}
template <>
inline MPI_Datatype mpi_type<long>() {
  return MPI_LONG;
}
template <>
inline MPI_Datatype mpi_type<double>() {
  return MPI_DOUBLE;
}
template <>
inline MPI_Datatype mpi_type<std::complex<double>>() {
  return MPI_CXX_DOUBLE_COMPLEX;
}

// A length as MPI wants it; throws InternalError beyond the range of int.
int mpi_count(std::size_t length, std::source_location where = std::source_location::current());

}  // namespace wingbeat
