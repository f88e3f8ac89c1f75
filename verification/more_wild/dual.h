// SPDX-License-Identifier: Apache-2.0
// Dual numbers a + b e with e e = 0. A function of a dual number is f(a) + f'(a) b e, so a formula
// that is evaluated with dual numbers computes its own derivative, exact except for rounding.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace latsch::more_wild {

struct Dual {
  double value = 0.0, slope = 0.0;

  Dual() = default;
  /// a plain number is a constant with derivative 0
  Dual(double a, double b = 0.0) : value(a), slope(b) {}

  Dual& operator+=(const Dual& b) { return *this = {value + b.value, slope + b.slope}; }
  Dual& operator*=(const Dual& b) {
    return *this = {value * b.value, slope * b.value + value * b.slope};
  }
};

inline Dual operator-(const Dual& a) { return {-a.value, -a.slope}; }
inline Dual operator+(Dual a, const Dual& b) { return a += b; }
inline Dual operator-(const Dual& a, const Dual& b) {
  return {a.value - b.value, a.slope - b.slope};
}
inline Dual operator*(Dual a, const Dual& b) { return a *= b; }
inline Dual operator/(const Dual& a, const Dual& b) {
  const double quotient = a.value / b.value;
  return {quotient, (a.slope - quotient * b.slope) / b.value};
}
inline bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
inline bool operator!=(const Dual& a, const Dual& b) { return a.value != b.value; }

inline Dual exp(const Dual& a) { return {std::exp(a.value), std::exp(a.value) * a.slope}; }
inline Dual expm1(const Dual& a) { return {std::expm1(a.value), std::exp(a.value) * a.slope}; }
inline Dual log(const Dual& a) { return {std::log(a.value), a.slope / a.value}; }
inline Dual sin(const Dual& a) { return {std::sin(a.value), std::cos(a.value) * a.slope}; }
inline Dual cos(const Dual& a) { return {std::cos(a.value), -std::sin(a.value) * a.slope}; }
inline Dual atan(const Dual& a) {
  return {std::atan(a.value), a.slope / (1.0 + a.value * a.value)};
}
inline Dual sqrt(const Dual& a) { return {std::sqrt(a.value), 0.5 * a.slope / std::sqrt(a.value)}; }
inline Dual hypot(const Dual& a, const Dual& b) {
  const double length = std::hypot(a.value, b.value);
  return {length, (a.value * a.slope + b.value * b.slope) / length};
}
/// Computes a^b for a constant exponent b, or for a constant base a above 0.
inline Dual pow(const Dual& a, const Dual& b) {
  const double power = std::pow(a.value, b.value);
  double slope = b.value * std::pow(a.value, b.value - 1.0) * a.slope;
  if (b.slope != 0.0) slope += power * std::log(a.value) * b.slope;
  return {power, slope};
}

/// Returns the derivatives of f at x, a row of x.size() numbers for each value.
template <class Function>
std::vector<double> jacobian_of(const Function& f, const std::vector<double>& x) {
  const std::size_t n = x.size();
  std::vector<double> jacobian;
  for (std::size_t j = 0; j < n; ++j) {
    std::vector<Dual> at(x.begin(), x.end());
    at[j].slope = 1.0;
    const std::vector<Dual> r = f(at);
    jacobian.resize(r.size() * n);
    for (std::size_t i = 0; i < r.size(); ++i) jacobian[i * n + j] = r[i].slope;
  }
  return jacobian;
}

}  // namespace latsch::more_wild
