// SPDX-License-Identifier: Apache-2.0
#include "numerics/chi_square.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace latsch::numerics {
namespace {

// Degrees of freedom above which the cube-root approximation is used.
constexpr double kMany = 1000.0;

/// Returns sum_k z^k / ((a + 1) ... (a + k)), the series of equation 8.7.1 divided by its first
/// term.
double series(double a, double z) {
  double sum = 1.0, term = 1.0;
  for (double k = a + 1.0; term > 1e-17 * sum; k += 1.0) {
    term *= z / k;
    sum += term;
  }
  return sum;
}

/// Evaluates the continued fraction of equation 8.9.2 from its last term backward.
double continued_fraction(double a, double z) {
  constexpr int kTerms = 500;
  double tail = z;
  for (int k = kTerms; k >= 1; --k) tail = z + (k - a) / (1.0 + k / tail);
  return 1.0 / tail;
}

double normal_probability(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

double chi_square_density(double x, double nu) {
  const double a = 0.5 * nu, z = 0.5 * x;
  return 0.5 * std::exp((a - 1.0) * std::log(z) - z - std::lgamma(a));
}

double wilson_hilferty(double z, double nu) {
  const double k = 2.0 / (9.0 * nu);
  return nu * std::pow(1.0 - k + z * std::sqrt(k), 3.0);
}

}  // namespace

double chi_square_probability(double x, double nu) {
  assert(nu > 0.0 && x >= 0.0);
  if (x == 0.0) return 0.0;
  const double a = 0.5 * nu, z = 0.5 * x;
  const double front = std::exp(a * std::log(z) - z - std::lgamma(a));  // z^a e^-z / Gamma(a)
  return z < a + 1.0 ? front / a * series(a, z) : 1.0 - front * continued_fraction(a, z);
}

/// Solves F(x; nu) = p by Newton's method; a step that leaves the bracket of the solution is
/// replaced by bisection.
double chi_square_quantile(double p, double nu) {
  assert(0.0 < p && p < 1.0);
  // Number of steps in which bisection alone reaches the last digit of a double.
  constexpr int kMost = 200;
  double low = 0.0, high = nu + 1.0;
  while (chi_square_probability(high, nu) < p) high *= 2.0;
  double x = 0.5 * (low + high);
  for (int i = 0; i < kMost; ++i) {
    const double off = chi_square_probability(x, nu) - p;
    (off < 0.0 ? low : high) = x;
    double next = x - off / chi_square_density(x, nu);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const bool stands = std::abs(next - x) <= 4e-16 * x;
    x = next;
    if (stands) break;
  }
  return x;
}

double chi_square_at(double z, double nu) {
  return nu > kMany ? wilson_hilferty(z, nu) : chi_square_quantile(normal_probability(z), nu);
}

}  // namespace latsch::numerics
