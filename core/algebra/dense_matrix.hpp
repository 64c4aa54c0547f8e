#pragma once

#include <Eigen/Core>

namespace wingbeat {

// Small dense matrices and vectors that every rank holds whole. T is double or std::complex<double>.
template <class T>
using DenseMatrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
template <class T>
using DenseVector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

}  // namespace wingbeat
