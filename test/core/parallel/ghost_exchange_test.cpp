#include "core/parallel/ghost_exchange.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/io/error.hpp"

namespace wingbeat {
namespace {

int owned_count(int rank) { return 5 + 3 * rank; }

// Random ghosts of every rank, this one included, some of them repeated and in no order.
std::vector<GhostSource> random_sources(const Comm& comm) {
  std::mt19937 random(17 + comm.rank());
  std::vector<GhostSource> sources(20 + comm.rank());
  for (GhostSource& source : sources) {
    source.rank = static_cast<int>(random() % comm.size());
    source.index = static_cast<int>(random() % owned_count(source.rank));
  }
  return sources;
}

template <class T>
T name_of(int rank, int entry, int instance, int component) {
  return T(1000 * rank + 40 * entry + 10 * instance + component);
}
template <>
std::complex<double> name_of(int rank, int entry, int instance, int component) {
  return {name_of<double>(rank, entry, instance, component), -1.0 * entry};
}

template <class T>
class GhostExchangeOf : public ::testing::Test {};
using Types = ::testing::Types<int, double, std::complex<double>>;
TYPED_TEST_SUITE(GhostExchangeOf, Types);

TYPED_TEST(GhostExchangeOf, GatherCopiesEveryInstanceOfTheOwner) {
  const Comm comm;
  const int instances = 3, width = 4;
  const std::vector<GhostSource> sources = random_sources(comm);
  const GhostExchange exchange(comm, sources);

  std::vector<TypeParam> owned;
  for (int n = 0; n < instances; ++n)
    for (int entry = 0; entry < owned_count(comm.rank()); ++entry)
      for (int v = 0; v < width; ++v) owned.push_back(name_of<TypeParam>(comm.rank(), entry, n, v));
  std::vector<TypeParam> ghosts(sources.size() * instances * width);
  exchange.gather<TypeParam>(owned, ghosts, instances, width);

  std::size_t position = 0;
  for (int n = 0; n < instances; ++n)
    for (const auto& [rank, index] : sources)
      for (int v = 0; v < width; ++v)
        ASSERT_EQ(ghosts[position++], name_of<TypeParam>(rank, index, n, v)) << rank << " " << index;
}

// Whole numbers: every product and sum is exact, so the two inner products must be equal.
TYPED_TEST(GhostExchangeOf, ScatterAddIsTheExactTransposeOfGather) {
  const Comm comm;
  const int instances = 2, width = 3;
  const std::vector<GhostSource> sources = random_sources(comm);
  const GhostExchange exchange(comm, sources);
  std::mt19937 random(5 + comm.rank());
  const auto fill = [&](std::vector<TypeParam>& values) {
    for (TypeParam& value : values) value = TypeParam(static_cast<int>(random() % 21) - 10);
  };
  std::vector<TypeParam> x(owned_count(comm.rank()) * instances * width), transpose(x.size());
  std::vector<TypeParam> v(sources.size() * instances * width), gathered(v.size());
  fill(x);
  fill(v);
  exchange.gather<TypeParam>(x, gathered, instances, width);
  exchange.scatter_add<TypeParam>(v, transpose, instances, width);

  std::complex<double> ghost_side = 0.0, owner_side = 0.0, one_sided = 0.0;
  for (std::size_t i = 0; i < v.size(); ++i) ghost_side += std::complex<double>(v[i] * gathered[i]);
  for (std::size_t i = 0; i < x.size(); ++i) owner_side += std::complex<double>(transpose[i] * x[i]);
  for (std::size_t i = 0; i < x.size(); ++i) one_sided += std::complex<double>(transpose[i]);
  EXPECT_EQ(comm.sum(ghost_side), comm.sum(owner_side));
  std::complex<double> total = 0.0;
  for (const TypeParam& value : v) total += std::complex<double>(value);
  EXPECT_EQ(comm.sum(total), comm.sum(one_sided));
}

TEST(GhostExchange, ScatterAddKeepsWhatTheOwnerHas) {
  const Comm comm;
  const std::vector<GhostSource> sources(2, {0, 0});
  const GhostExchange exchange(comm, sources);
  std::vector<double> owned{7.0, 5.0};
  exchange.scatter_add<double>(std::vector<double>{1.0, 2.0}, owned, 1, 1);
  EXPECT_EQ(owned, (std::vector<double>{comm.is_root() ? 7.0 + 3.0 * comm.size() : 7.0, 5.0}));
}

TEST(GhostExchange, RefusesSourcesAndArraysThatDoNotFit) {
  const Comm comm(MPI_COMM_SELF);
  EXPECT_THROW(GhostExchange(comm, std::vector<GhostSource>{{1, 0}}), InternalError);
  EXPECT_THROW(GhostExchange(comm, std::vector<GhostSource>{{0, -1}}), InternalError);
  const GhostExchange exchange(comm, std::vector<GhostSource>{{0, 2}});
  std::vector<double> owned(4), short_owned(2), ghosts(1), long_ghosts(2);
  EXPECT_NO_THROW(exchange.gather<double>(owned, ghosts, 1, 1));
  EXPECT_THROW(exchange.gather<double>(short_owned, ghosts, 1, 1), InternalError);
  EXPECT_THROW(exchange.gather<double>(owned, long_ghosts, 1, 1), InternalError);
  EXPECT_THROW(exchange.scatter_add<double>(long_ghosts, owned, 1, 1), InternalError);
}

TEST(GhostExchange, WithoutGhostsDoesNothing) {
  const GhostExchange exchange;
  std::vector<double> owned(3, 1.0), ghosts;
  exchange.gather<double>(owned, ghosts, 1, 1);
  exchange.scatter_add<double>(ghosts, owned, 1, 1);
  EXPECT_EQ(owned, std::vector<double>(3, 1.0));
}

}  // namespace
}  // namespace wingbeat
