// SPDX-License-Identifier: Apache-2.0
#include "more_wild/varied_problems.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "numerics/dense/orthogonal_factors.h"

namespace latsch::more_wild {
namespace {

Problem moved(Problem problem, RandomStream& random) {
  double largest = 0.0;
  for (const double x : problem.start) largest = std::max(largest, std::abs(x));
  for (double& x : problem.start) {
    x += 0.1 * std::max(std::abs(x), 0.1 * largest) * random.normal();
  }
  return problem;
}

/// Returns the problem with new variables y, where x = x_0 + T (y - x_0).
Problem in_other_variables(Problem problem, const Eigen::MatrixXd& T) {
  const Vector start = problem.start;
  const auto in_x = [start, T](const Vector& y) {
    const auto n = static_cast<Eigen::Index>(start.size());
    const Eigen::Map<const Eigen::VectorXd> x_0(start.data(), n), to(y.data(), n);
    const Eigen::VectorXd x = x_0 + T * (to - x_0);
    return Vector(x.begin(), x.end());
  };
  problem.residuals = [in_x, r = problem.residuals](const Vector& y) { return r(in_x(y)); };
  problem.jacobian = {};
  return problem;
}

template <typename Variation>
std::vector<Problem> varied(std::uint64_t seed, const Variation& variation) {
  std::vector<Problem> all;
  for (const Problem& problem : problems()) {
    RandomStream random(seed, all.size());
    const Problem here = moved(problem, random);
    all.push_back(variation(here, random));
  }
  return all;
}

}  // namespace

std::vector<Problem> moved(std::uint64_t seed) {
  return varied(seed, [](const Problem& problem, RandomStream&) { return problem; });
}

std::vector<Problem> rotated(std::uint64_t seed) {
  return varied(seed, [](const Problem& problem, RandomStream& random) {
    Eigen::MatrixXd A(problem.n(), problem.n());
    for (double& a : A.reshaped()) a = random.normal();
    return in_other_variables(problem, numerics::HouseholderQr(A).Q());
  });
}

std::vector<Problem> scaled(std::uint64_t seed) {
  return varied(seed, [](const Problem& problem, RandomStream& random) {
    Eigen::VectorXd s(problem.n());
    for (double& scale : s) scale = std::pow(10.0, 2.0 * random.uniform() - 1.0);
    return in_other_variables(problem, s.asDiagonal());
  });
}

}  // namespace latsch::more_wild
