// SPDX-License-Identifier: Apache-2.0
// Linear filters of sampled signals.
//
//   a_0 y_n = b_0 x_n + b_1 x_(n-1) + ... - a_1 y_(n-1) - ...       (transposed direct form II)
//
// As one rational function or as a cascade of sections of second order, which keeps its accuracy
// where a cut-off frequency is a small part of the sampling rate: rounding a coefficient moves the
// poles of an order n by about eps^(1/n) when they lie close together.
//
// Forward and backward (zero phase): the signal is extended at both ends by its point reflection,
// 2 x_0 - x_k, over 3 times the filter's length, and each pass starts in the steady state of its
// first sample [Gustafsson 1996; the padding and its length are those of SciPy's filtfilt and
// sosfiltfilt].
#pragma once

#include <span>
#include <vector>

namespace latsch::numerics {

/// b(z)/a(z) in powers of 1/z; a[0] is not zero.
struct RationalFilter {
  std::vector<double> b, a;
};

/// One section of second order, a_0 = 1.
struct Section {
  double b0 = 1.0, b1 = 0.0, b2 = 0.0, a1 = 0.0, a2 = 0.0;
};

/// From rest; `state` is that of max(a, b) - 1 delays before the first sample.
std::vector<double> filter(const RationalFilter& filter, std::span<const double> x);
std::vector<double> filter(const RationalFilter& filter,
                           std::span<const double> x,
                           std::vector<double> state);
std::vector<double> filter(const std::vector<Section>& sections, std::span<const double> x);

/// The state in which a constant input of 1 gives a constant output: sum a must not vanish.
std::vector<double> steady_state(const RationalFilter& filter);

/// Zero phase; x has more samples than forward_backward_padding() says.
std::vector<double> filter_forward_backward(const RationalFilter& filter,
                                            std::span<const double> x);
std::vector<double> filter_forward_backward(const std::vector<Section>& sections,
                                            std::span<const double> x);
int forward_backward_padding(const RationalFilter& filter);
int forward_backward_padding(const std::vector<Section>& sections);

/// Whether every pole lies inside the unit circle.
bool is_stable(const RationalFilter& filter);

}  // namespace latsch::numerics
