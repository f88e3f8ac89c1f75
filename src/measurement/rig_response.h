// SPDX-License-Identifier: Apache-2.0
// Effect of a rig's own resonance on a force, by one mode and a direct part:
//
//   TF(s) = A / (s^2 + 2 f zeta s + f^2) + c                                               (3-3)
//   [thesis K, 3.1]; f in rad/s, gain A/f^2 + c at rest
//
// The inverse has the same form, since 1/TF = (1/c) (1 - (A/c) / (s^2 + 2 f zeta s + f^2 + A/c)):
//
//   A' = -A/c^2,  f'^2 = f^2 + A/c,  f' zeta' = f zeta,  c' = 1/c
//
// so a filter from the dummy rim to the real one has the form (3-3) as well and can be fitted
// directly. The inverse exists if c is not 0 and is stable if f'^2 > 0. For c -> 0 the gain of the
// inverse is unbounded at high frequency, and the inverse needs a low-pass behind it:
//
//   1/TF(s) * g^2 / (s^2 + sqrt2 g s + g^2)
#pragma once

#include <complex>
#include <numbers>
#include <optional>

#include "base/result.h"
#include "numerics/signals/bilinear.h"

namespace latsch {

inline constexpr double kTwoPi = 2.0 * std::numbers::pi;

struct RigResponse {
  double A = 0.0;     // 1/s^2
  double f = 1.0;     // rad/s
  double zeta = 0.1;  // damping ratio
  double c = 1.0;

  static RigResponse of(double gain /* A/f^2 */, double f, double zeta, double c) {
    return {gain * f * f, f, zeta, c};
  }
  double gain() const { return A / (f * f); }
  std::complex<double> at(double omega) const;
  bool stable() const { return f > 0.0 && zeta > 0.0; }
};

/// Returns nothing if c is 0 or f^2 + A/c is not positive.
std::optional<RigResponse> inverse(const RigResponse& response);

/// Returns the causal filter with this response, exact at 0 and at f (bilinear transform, see
/// numerics/signals/bilinear.h). Returns a Failure if the response is not stable or f is above half
/// the rate.
Result<numerics::RationalFilter> filter_of(const RigResponse& response, double rate);

/// Returns the causal filter with the response 1/TF, followed by a low-pass filter of second order
/// at `low_pass` Hz, which can be omitted only if c is not 0. Returns a Failure if the inverse is
/// not stable.
Result<numerics::RationalFilter> inverse_filter(const RigResponse& response,
                                                double rate,
                                                std::optional<double> low_pass = std::nullopt);

}  // namespace latsch
