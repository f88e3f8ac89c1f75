// SPDX-License-Identifier: Apache-2.0
#include "numerics/student_t.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace latsch::numerics {
namespace {

/// Evaluates the continued fraction of equation 26.5.8, 1 / (1 + d_1 / (1 + d_2 / ...)), from its
/// last term backward. It converges fast for x < (a + 1) / (a + b + 2).
double continued_fraction(double x, double a, double b) {
  constexpr int kTerms = 400;
  double tail = 1.0;
  for (int k = kTerms; k >= 1; --k) {
    const int m = k / 2;
    const double d = k % 2 == 0 ? m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
                                : -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    tail = 1.0 + d / tail;
  }
  return 1.0 / tail;
}

/// Returns the incomplete beta function I_x(a, b).
double incomplete_beta(double x, double a, double b) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  const auto front = [](double x, double a, double b) {
    return std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) +
                    b * std::log1p(-x)) /
           a;
  };
  if (x < (a + 1.0) / (a + b + 2.0)) return front(x, a, b) * continued_fraction(x, a, b);
  return 1.0 - front(1.0 - x, b, a) * continued_fraction(1.0 - x, b, a);  // 26.5.2
}

}  // namespace

double student_t_probability(double t, double nu) {
  assert(nu > 0.0);
  // Above this number the differences of the logarithms of gamma functions lose digits, and the
  // approximation by the normal distribution [Abramowitz, Stegun, 26.7.8] has all of them.
  constexpr double kNearlyNormal = 1e5;
  if (nu > kNearlyNormal) {
    const double z = t * (1.0 - 0.25 / nu) / std::sqrt(1.0 + 0.5 * t * t / nu);
    return 0.5 * std::erfc(-z / std::numbers::sqrt2);
  }
  const double beyond = 0.5 * incomplete_beta(nu / (nu + t * t), 0.5 * nu, 0.5);  // 26.7.1
  return t < 0.0 ? beyond : 1.0 - beyond;
}

double student_t_quantile(double p, double nu) {
  assert(0.0 < p && p < 1.0);
  if (p < 0.5) return -student_t_quantile(1.0 - p, nu);
  double low = 0.0, high = 1.0;
  while (student_t_probability(high, nu) < p) high *= 2.0;
  for (int i = 0; i < 100 && low < high; ++i) {  // bisects to the last digit of a double
    const double middle = 0.5 * (low + high);
    (student_t_probability(middle, nu) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace latsch::numerics
