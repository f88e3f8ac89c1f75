// SPDX-License-Identifier: Apache-2.0
// Kernels of kernel_math_test.cpp. Each evaluates a function for n numbers (a multiple of eight),
// in blocks of eight, of four and one at a time.
#include "numerics/kernels/kernel_math.h"

namespace latsch::kernel_math_testing::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

template <class Function>
LATSCH_INLINE void map(int width, int n, const double* x, double* y, const Function& function) {
  if (width == 8)
    for (int i = 0; i < n; i += 8) store(function(lanes(x + i)), y + i);
  if (width == 4)
    for (int i = 0; i < n; i += 4) store(function(lanes4(x + i)), y + i);
  if (width == 1)
    for (int i = 0; i < n; ++i) y[i] = function(Lane(x[i])).v;
}

void evaluate(Which which, int width, int n, const double* x, double* y) {
  switch (which) {
    case Which::atan:
      return map(width, n, x, y, [](const auto& v) { return atan(v); });
    case Which::atan_of_quotient:
      return map(width, n, x, y, [](const auto& v) {
        return atan_of_quotient(v, std::remove_cvref_t<decltype(v)>(3.0));
      });
    case Which::sin:
      return map(width, n, x, y, [](const auto& v) { return sin(v); });
    case Which::cos:
      return map(width, n, x, y, [](const auto& v) { return cos(v); });
    case Which::exp:
      return map(width, n, x, y, [](const auto& v) { return exp(v); });
    case Which::log:
      return map(width, n, x, y, [](const auto& v) { return log(v); });
    case Which::cbrt:
      return map(width, n, x, y, [](const auto& v) { return cbrt(v); });
    case Which::power:
      return map(width, n, x, y, [](const auto& v) { return power(v, 0.85); });
    case Which::power_zero:
      return map(width, n, x, y, [](const auto& v) { return power(v, 0.0); });
    case Which::sign:
      return map(width, n, x, y, [](const auto& v) { return sign(v); });
    case Which::sign_or_one:
      return map(width, n, x, y, [](const auto& v) { return sign_or_one(v); });
    case Which::fused:
      return map(width, n, x, y, [](const auto& v) { return v * v - 2.0; });
    case Which::fused_both:
      return map(width, n, x, y, [](const auto& v) { return v * 0.1 + v * v; });
    case Which::rounded:
      return map(width, n, x, y, [](const auto& v) {
        const std::remove_cvref_t<decltype(v)> square = v * v;
        return square - 2.0;
      });
    case Which::clamped:
      return map(width, n, x, y, [](const auto& v) { return smaller(larger(v, -1.0), 2.0); });
    case Which::chosen:
      return map(width, n, x, y, [](const auto& v) {
        return select((v > 0.5) | (v <= -3.0), 2.0 * v, -v);
      });
  }
}

double added(const double* x) { return sum(lanes(x)); }
bool any_above(const double* x, double limit) { return any(lanes(x) > limit); }
bool every_above(const double* x, double limit) { return every(lanes(x) > limit); }
void joined_halves(const double* x, double* y) {
  const Lanes v = lanes(x);
  store(joined(high_half(v), low_half(v)), y);
}

}  // namespace latsch::kernel_math_testing::LATSCH_KERNELS
