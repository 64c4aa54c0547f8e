#include "core/parallel/failure_agreement.hpp"

#include <gtest/gtest.h>

namespace wingbeat {
namespace {

TEST(FailureAgreement, IsReachedWhenEveryRankFails) {
  FailureAgreement agreement{Comm()};
  EXPECT_TRUE(agreement.all_failed(30.0));
}

TEST(FailureAgreement, IsNotReachedWhileAnotherRankIsAtWork) {
  const Comm comm;
  FailureAgreement agreement(comm);
  if (comm.is_root()) {
    EXPECT_EQ(agreement.all_failed(0.05), comm.size() == 1);
  }
  // The pending call of rank 0 must not disturb the work of the others.
  EXPECT_EQ(comm.sum(1L), comm.size());
  EXPECT_TRUE(agreement.all_failed(30.0));
}

}  // namespace
}  // namespace wingbeat
