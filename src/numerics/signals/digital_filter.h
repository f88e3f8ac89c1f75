// SPDX-License-Identifier: Apache-2.0
// Linear filters of sampled signals.
//
//   a_0 y_n = b_0 x_n + b_1 x_(n-1) + ... - a_1 y_(n-1) - ...       (transposed direct form II)
//
// A filter is one rational function or a cascade of second-order sections. The cascade keeps its
// accuracy if a cut-off frequency is a small part of the sampling rate: rounding a coefficient of a
// function of order n moves poles that are close together by about eps^(1/n).
//
// Forward and backward filtering (zero phase) extends the signal at both ends by its point
// reflection, 2 x_0 - x_k, over 3 times the filter's length. Each pass starts in the steady state
// of its first sample [Gustafsson 1996; the padding and its length are those of SciPy's filtfilt
// and sosfiltfilt].
#pragma once

#include <span>
#include <vector>

namespace latsch::numerics {

/// Rational function b(z)/a(z) in powers of 1/z; a[0] must not be zero.
struct RationalFilter {
  std::vector<double> b, a;
};

/// Second-order section with a_0 = 1.
struct FilterSection {
  double b0 = 1.0, b1 = 0.0, b2 = 0.0, a1 = 0.0, a2 = 0.0;
};

/// Filters x from a state of rest, or from `state`, which holds the max(a.size(), b.size()) - 1
/// delay values before the first sample.
std::vector<double> filter(const RationalFilter& filter, std::span<const double> x);
std::vector<double> filter(const RationalFilter& filter,
                           std::span<const double> x,
                           std::vector<double> state);
std::vector<double> filter(const std::vector<FilterSection>& sections, std::span<const double> x);

/// Returns the state in which a constant input of 1 gives a constant output. The sum of a must not
/// vanish.
std::vector<double> steady_state(const RationalFilter& filter);

/// Filters with zero phase. x must have more samples than forward_backward_padding() returns.
std::vector<double> filter_forward_backward(const RationalFilter& filter,
                                            std::span<const double> x);
std::vector<double> filter_forward_backward(const std::vector<FilterSection>& sections,
                                            std::span<const double> x);
int forward_backward_padding(const RationalFilter& filter);
int forward_backward_padding(const std::vector<FilterSection>& sections);

/// True if every pole lies inside the unit circle.
bool is_stable(const RationalFilter& filter);

}  // namespace latsch::numerics
