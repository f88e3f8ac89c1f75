// SPDX-License-Identifier: Apache-2.0
#include "numerics/signals/digital_filter.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <numeric>

namespace latsch::numerics {
namespace {

/// Returns both polynomials with the same length, divided by a_0.
RationalFilter normalized(const RationalFilter& given) {
  assert(!given.b.empty() && !given.a.empty() && given.a[0] != 0.0);
  RationalFilter filter = given;
  const std::size_t n = std::max(filter.a.size(), filter.b.size());
  filter.a.resize(n, 0.0);
  filter.b.resize(n, 0.0);
  const double a0 = filter.a[0];
  if (a0 != 1.0) {
    for (double& a : filter.a) a /= a0;
    for (double& b : filter.b) b /= a0;
  }
  return filter;
}

void run(const RationalFilter& f, std::vector<double>& x, std::vector<double>& state) {
  const std::size_t order = f.a.size() - 1;
  assert(state.size() == order);
  if (order == 0) {
    for (double& value : x) value *= f.b[0];
    return;
  }
  for (double& value : x) {
    const double in = value;
    const double out = f.b[0] * in + state[0];
    for (std::size_t i = 0; i + 1 < order; ++i) {
      state[i] = f.b[i + 1] * in + state[i + 1] - f.a[i + 1] * out;
    }
    state[order - 1] = f.b[order] * in - f.a[order] * out;
    value = out;
  }
}

void run(const FilterSection& s, std::vector<double>& x, double z0, double z1) {
  for (double& value : x) {
    const double in = value;
    const double out = s.b0 * in + z0;
    z0 = s.b1 * in - s.a1 * out + z1;
    z1 = s.b2 * in - s.a2 * out;
    value = out;
  }
}

double gain_at_rest(const FilterSection& s) { return (s.b0 + s.b1 + s.b2) / (1.0 + s.a1 + s.a2); }

/// Runs the sections, starting each in the steady state of the constant input x[0].
void run_from_steady_state(const std::vector<FilterSection>& sections, std::vector<double>& x) {
  double in = x.front();
  for (const FilterSection& s : sections) {
    const double out = in * gain_at_rest(s);
    const double z1 = s.b2 * in - s.a2 * out;
    run(s, x, s.b1 * in - s.a1 * out + z1, z1);
    in = out;
  }
}

/// Returns x extended at both ends by `count` samples of its point reflection: 2 x_0 - x_k before x
/// and 2 x_N - x_(N-k) after it.
std::vector<double> extended(std::span<const double> x, int count) {
  assert(static_cast<int>(x.size()) > count);
  std::vector<double> y;
  y.reserve(x.size() + 2 * count);
  for (int k = count; k >= 1; --k) y.push_back(2.0 * x.front() - x[k]);
  y.insert(y.end(), x.begin(), x.end());
  for (int k = 1; k <= count; ++k) y.push_back(2.0 * x.back() - x[x.size() - 1 - k]);
  return y;
}

template <class Pass>
std::vector<double> both_ways(std::span<const double> x, int padding, const Pass& pass) {
  std::vector<double> y = extended(x, padding);
  pass(y);
  std::reverse(y.begin(), y.end());
  pass(y);
  std::reverse(y.begin(), y.end());
  return {y.begin() + padding, y.end() - padding};
}

}  // namespace

std::vector<double> filter(const RationalFilter& given, std::span<const double> x) {
  const std::size_t order = std::max(given.a.size(), given.b.size()) - 1;
  return filter(given, x, std::vector<double>(order, 0.0));
}

std::vector<double> filter(const RationalFilter& given,
                           std::span<const double> x,
                           std::vector<double> state) {
  std::vector<double> y(x.begin(), x.end());
  run(normalized(given), y, state);
  return y;
}

std::vector<double> filter(const std::vector<FilterSection>& sections, std::span<const double> x) {
  std::vector<double> y(x.begin(), x.end());
  for (const FilterSection& section : sections) run(section, y, 0.0, 0.0);
  return y;
}

std::vector<double> steady_state(const RationalFilter& given) {
  const RationalFilter f = normalized(given);
  const double gain =
      std::accumulate(f.b.begin(), f.b.end(), 0.0) / std::accumulate(f.a.begin(), f.a.end(), 0.0);
  std::vector<double> state(f.a.size() - 1, 0.0);
  double sum = 0.0;
  for (std::size_t i = state.size(); i-- > 0;) {
    sum += f.b[i + 1] - f.a[i + 1] * gain;
    state[i] = sum;
  }
  return state;
}

std::vector<double> filter_forward_backward(const RationalFilter& given,
                                            std::span<const double> x) {
  const RationalFilter f = normalized(given);
  const std::vector<double> steady = steady_state(f);
  return both_ways(x, forward_backward_padding(given), [&](std::vector<double>& y) {
    std::vector<double> state = steady;
    for (double& z : state) z *= y.front();
    run(f, y, state);
  });
}

std::vector<double> filter_forward_backward(const std::vector<FilterSection>& sections,
                                            std::span<const double> x) {
  return both_ways(x, forward_backward_padding(sections), [&](std::vector<double>& y) {
    run_from_steady_state(sections, y);
  });
}

int forward_backward_padding(const RationalFilter& filter) {
  return 3 * static_cast<int>(std::max(filter.a.size(), filter.b.size()));
}

int forward_backward_padding(const std::vector<FilterSection>& sections) {
  int first_order_b = 0, first_order_a = 0;
  for (const FilterSection& s : sections) {
    first_order_b += s.b2 == 0.0;
    first_order_a += s.a2 == 0.0;
  }
  const int taps =
      2 * static_cast<int>(sections.size()) + 1 - std::min(first_order_b, first_order_a);
  return 3 * taps;
}

bool is_stable(const RationalFilter& given) {
  const RationalFilter f = normalized(given);
  const int order = static_cast<int>(f.a.size()) - 1;
  if (order == 0) return true;
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(order, order);
  for (int i = 0; i < order; ++i) companion(0, i) = -f.a[i + 1];
  companion.diagonal(-1).setOnes();
  return companion.eigenvalues().cwiseAbs().maxCoeff() < 1.0;
}

}  // namespace latsch::numerics
