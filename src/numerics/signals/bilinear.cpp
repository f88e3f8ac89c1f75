// SPDX-License-Identifier: Apache-2.0
#include "numerics/signals/bilinear.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace latsch::numerics {
namespace {

/// Returns the polynomial p(q) multiplied by (1 + sign q).
std::vector<double> times(const std::vector<double>& p, double sign) {
  std::vector<double> product(p.size() + 1, 0.0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    product[i] += p[i];
    product[i + 1] += sign * p[i];
  }
  return product;
}

/// Returns sum_i c_i K^i (1 - q)^i (1 + q)^(n - i) in powers of q = 1/z.
std::vector<double> substituted(const std::vector<double>& c, std::size_t n, double K) {
  std::vector<double> sum(n + 1, 0.0);
  double power = 1.0;
  for (std::size_t i = 0; i < c.size(); ++i, power *= K) {
    std::vector<double> term{c[i] * power};
    for (std::size_t j = 0; j < n; ++j) term = times(term, j < i ? -1.0 : 1.0);
    for (std::size_t j = 0; j <= n; ++j) sum[j] += term[j];
  }
  return sum;
}

}  // namespace

RationalFilter bilinear(const ContinuousFilter& filter, double rate, double exact_at) {
  assert(!filter.a.empty() && filter.b.size() <= filter.a.size());
  assert(exact_at >= 0.0 && exact_at < std::numbers::pi * rate);
  const double K = exact_at > 0.0 ? exact_at / std::tan(exact_at / (2.0 * rate)) : 2.0 * rate;
  const std::size_t degree = filter.a.size() - 1;
  RationalFilter digital{substituted(filter.b, degree, K), substituted(filter.a, degree, K)};
  const double a0 = digital.a[0];
  for (double& b : digital.b) b /= a0;
  for (double& a : digital.a) a /= a0;
  return digital;
}

}  // namespace latsch::numerics
