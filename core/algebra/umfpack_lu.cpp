#include "core/algebra/umfpack_lu.hpp"

#include <SuiteSparse_config.h>
#include <sys/mman.h>
#include <umfpack.h>

#include <cstdint>
#include <cstdlib>
#include <new>
#include <numeric>
#include <string>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

// One name for the real and the complex routines; complex values are packed, hence the null parts.
template <class T>
struct Umfpack;

template <>
struct Umfpack<double> {
  static int analyze(int n, const int* begin, const int* index, const int* order, void** symbolic,
                     const double* control, double* info) {
    return umfpack_di_qsymbolic(n, n, begin, index, nullptr, order, symbolic, control, info);
  }
  static int factor(const int* begin, const int* index, const double* values, void* symbolic, void** numeric,
                    const double* control, double* info) {
    return umfpack_di_numeric(begin, index, values, symbolic, numeric, control, info);
  }
  static int solve(int system, const double* b, double* x, void* numeric, const double* control,
                   double* info) {
    return umfpack_di_solve(system, nullptr, nullptr, nullptr, x, b, numeric, control, info);
  }
  static void free_symbolic(void* object) { umfpack_di_free_symbolic(&object); }
  static void free_numeric(void* object) { umfpack_di_free_numeric(&object); }
};

template <>
struct Umfpack<std::complex<double>> {
  using Complex = std::complex<double>;
  static const double* parts(const Complex* values) { return reinterpret_cast<const double*>(values); }

  static int analyze(int n, const int* begin, const int* index, const int* order, void** symbolic,
                     const double* control, double* info) {
    return umfpack_zi_qsymbolic(n, n, begin, index, nullptr, nullptr, order, symbolic, control, info);
  }
  static int factor(const int* begin, const int* index, const Complex* values, void* symbolic, void** numeric,
                    const double* control, double* info) {
    return umfpack_zi_numeric(begin, index, parts(values), nullptr, symbolic, numeric, control, info);
  }
  static int solve(int system, const Complex* b, Complex* x, void* numeric, const double* control,
                   double* info) {
    return umfpack_zi_solve(system, nullptr, nullptr, nullptr, nullptr, reinterpret_cast<double*>(x), nullptr,
                            parts(b), nullptr, numeric, control, info);
  }
  static void free_symbolic(void* object) { umfpack_zi_free_symbolic(&object); }
  static void free_numeric(void* object) { umfpack_zi_free_numeric(&object); }
};

std::string status_text(int status) {
  switch (status) {
    case UMFPACK_WARNING_singular_matrix:
      return "the matrix is singular";
    case UMFPACK_ERROR_invalid_matrix:
      return "invalid matrix";
    case UMFPACK_ERROR_different_pattern:
      return "the pattern changed since the analysis";
    case UMFPACK_ERROR_ordering_failed:
      return "the ordering failed";
    default:
      return "status " + std::to_string(status);
  }
}

void check(int status, const std::string& action) {
  if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
  ensure(status == UMFPACK_OK, "UMFPACK " + action + ": " + status_text(status));
}

// Asks for huge pages where a block of memory holds any: factors are large and written but once, and by pages
// of 4 KiB the faults would take as long as the arithmetic. A wish: where it is not met nothing changes.
void* on_huge_pages(void* block, std::size_t bytes) {
  constexpr std::uintptr_t page = 2 << 20;
  const auto begin = (reinterpret_cast<std::uintptr_t>(block) + page - 1) / page * page;
  const auto end = (reinterpret_cast<std::uintptr_t>(block) + bytes) / page * page;
  if (block && begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
  return block;
}

// SuiteSparse takes its memory by the functions it is given.
bool give_huge_pages_to_suitesparse() {
  SuiteSparse_config.malloc_func = [](std::size_t bytes) {
    return on_huge_pages(std::malloc(bytes), bytes);
  };
  SuiteSparse_config.realloc_func = [](void* block, std::size_t bytes) {
    return on_huge_pages(std::realloc(block, bytes), bytes);
  };
  return true;
}

// Near-diagonal pivots on the given order; a few solves a Krylov iteration need no refinement.
std::vector<double> controls() {
  std::vector<double> control(UMFPACK_CONTROL);
  umfpack_di_defaults(control.data());
  control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
  control[UMFPACK_ORDERING] = UMFPACK_ORDERING_GIVEN;
  control[UMFPACK_SINGLETONS] = 0;
  control[UMFPACK_IRSTEP] = 0;
  return control;
}

}  // namespace

template <class T>
void UmfpackLu<T>::FreeSymbolic::operator()(void* object) const {
  Umfpack<T>::free_symbolic(object);
}

template <class T>
void UmfpackLu<T>::FreeNumeric::operator()(void* object) const {
  Umfpack<T>::free_numeric(object);
}

// UMFPACK takes compressed columns: it is handed the rows, and so factors the transpose.
template <class T>
UmfpackLu<T>::UmfpackLu(std::vector<int> row_begin, std::vector<int> columns)
    : row_begin_(std::move(row_begin)), columns_(std::move(columns)), control_(controls()) {
  [[maybe_unused]] static const bool has_huge_pages = give_huge_pages_to_suitesparse();
  const int n = static_cast<int>(row_begin_.size()) - 1;
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::vector<double> info(UMFPACK_INFO);
  void* symbolic = nullptr;
  const int status = Umfpack<T>::analyze(n, row_begin_.data(), columns_.data(), order.data(), &symbolic,
                                         control_.data(), info.data());
  symbolic_.reset(symbolic);
  check(status, "analysis");
}

template <class T>
void UmfpackLu<T>::factor(std::span<const T> values) {
  ensure(values.size() == columns_.size(), "UmfpackLu: values of a wrong size");
  numeric_.reset();  // before the new factors need the memory
  std::vector<double> info(UMFPACK_INFO);
  void* numeric = nullptr;
  const int status = Umfpack<T>::factor(row_begin_.data(), columns_.data(), values.data(), symbolic_.get(),
                                        &numeric, control_.data(), info.data());
  std::unique_ptr<void, FreeNumeric> factors(numeric);
  check(status, "factorization");
  numeric_ = std::move(factors);
  bytes_ = info[UMFPACK_NUMERIC_SIZE] * info[UMFPACK_SIZE_OF_UNIT];
}

template <class T>
void UmfpackLu<T>::solve(std::span<const T> b, std::span<T> x) const {
  solve_system(UMFPACK_Aat, b, x);
}

template <class T>
void UmfpackLu<T>::solve_transpose(std::span<const T> b, std::span<T> x) const {
  solve_system(UMFPACK_A, b, x);
}

template <class T>
void UmfpackLu<T>::solve_system(int system, std::span<const T> b, std::span<T> x) const {
  ensure(is_factored(), "UmfpackLu: solve before factor");
  ensure(b.size() + 1 == row_begin_.size() && x.size() == b.size(), "UmfpackLu: vector of a wrong size");
  std::vector<double> info(UMFPACK_INFO);
  check(Umfpack<T>::solve(system, b.data(), x.data(), numeric_.get(), control_.data(), info.data()), "solve");
}

template class UmfpackLu<double>;
template class UmfpackLu<std::complex<double>>;

}  // namespace wingbeat
