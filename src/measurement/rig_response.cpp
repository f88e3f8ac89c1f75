// SPDX-License-Identifier: Apache-2.0
#include "measurement/rig_response.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace latsch {
namespace {

/// Returns the coefficients of s^2 + 2 f zeta s + f^2 in ascending powers.
std::vector<double> resonance(const RigResponse& r) { return {r.f * r.f, 2.0 * r.f * r.zeta, 1.0}; }

std::vector<double> product(const std::vector<double>& p, const std::vector<double>& q) {
  std::vector<double> all(p.size() + q.size() - 1, 0.0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j < q.size(); ++j) all[i + j] += p[i] * q[j];
  }
  return all;
}

/// Returns the coefficients of A + c (s^2 + 2 f zeta s + f^2) in ascending powers.
std::vector<double> numerator(const RigResponse& r) {
  std::vector<double> b = resonance(r);
  for (double& value : b) value *= r.c;
  b[0] += r.A;
  while (b.size() > 1 && b.back() == 0.0) b.pop_back();
  return b;
}

Result<numerics::RationalFilter> stable_filter(const numerics::ContinuousFilter& analog,
                                               double rate,
                                               double exact_at) {
  auto filter = numerics::bilinear(analog, rate, exact_at);
  if (!numerics::is_stable(filter)) return Failure{"the filter is not stable"};
  return filter;
}

}  // namespace

std::complex<double> RigResponse::at(double omega) const {
  const std::complex<double> s(0.0, omega);
  return A / (s * s + 2.0 * f * zeta * s + f * f) + c;  // (3-3)
}

std::optional<RigResponse> inverse(const RigResponse& r) {
  if (r.c == 0.0) return std::nullopt;
  const double square = r.f * r.f + r.A / r.c;
  if (!(square > 0.0)) return std::nullopt;
  const double f = std::sqrt(square);
  return RigResponse{-r.A / (r.c * r.c), f, r.f * r.zeta / f, 1.0 / r.c};
}

Result<numerics::RationalFilter> filter_of(const RigResponse& r, double rate) {
  if (!r.stable()) {
    return Failure{
        fmt::format("the response with f = {:.4g} Hz and zeta = {:.3g} is not stable, "
                    "expected both positive",
                    r.f / kTwoPi,
                    r.zeta)};
  }
  if (r.f >= std::numbers::pi * rate) {
    return Failure{
        fmt::format("the resonance at {:.4g} Hz lies above half the sampling rate of "
                    "{:g} Hz",
                    r.f / kTwoPi,
                    rate)};
  }
  return stable_filter({numerator(r), resonance(r)}, rate, r.f);
}

Result<numerics::RationalFilter> inverse_filter(const RigResponse& r,
                                                double rate,
                                                std::optional<double> low_pass) {
  const std::vector<double> denominator = numerator(r);
  // Hurwitz criterion up to degree 2: all coefficients have the same sign
  for (const double a : denominator) {
    if (!(a * denominator.back() > 0.0)) {
      return Failure{
          fmt::format("the inverse is not stable: A/f^2 + c = {:.4g} and c = {:.4g} "
                      "differ in sign or zeta = {:.3g} is not positive; fit the filter "
                      "from the dummy to the real rim directly",
                      r.gain() + r.c,
                      r.c,
                      r.zeta)};
    }
  }
  if (!low_pass && r.c == 0.0) {
    return Failure{"the inverse of a response with c = 0 grows without limit: give a low-pass"};
  }
  numerics::ContinuousFilter analog{resonance(r), denominator};
  const double f = std::sqrt(std::abs(denominator.front() / denominator.back()));
  const double exact_at = r.c != 0.0 && f < std::numbers::pi * rate ? f : r.f;
  if (low_pass) {
    if (*low_pass >= rate / 2.0) {
      return Failure{
          fmt::format("the low-pass at {:g} Hz lies above half the sampling rate of "
                      "{:g} Hz",
                      *low_pass,
                      rate)};
    }
    // The bilinear transform compresses frequencies but `exact_at`. This corner becomes the stated
    // one.
    const double g =
        exact_at / std::tan(0.5 * exact_at / rate) * std::tan(std::numbers::pi * *low_pass / rate);
    for (double& b : analog.b) b *= g * g;
    analog.a = product(analog.a, {g * g, std::numbers::sqrt2 * g, 1.0});
  }
  return stable_filter(analog, rate, exact_at);
}

}  // namespace latsch
