// SPDX-License-Identifier: Apache-2.0
#include "numerics/signals/local_response.h"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "numerics/dense/orthogonal_factors.h"
#include "numerics/signals/fft.h"

namespace latsch::numerics {

namespace {

/// Returns the transform of the differences between successive samples. Before and after the record
/// the signal counts as constant, so these differences are zero.
Spectrum transform_of_steps(std::span<const double> x, int length) {
  std::vector<double> steps(x.size(), 0.0);
  for (std::size_t i = 1; i < x.size(); ++i) steps[i] = x[i] - x[i - 1];
  return real_fft(steps, length);
}

struct Fitted {
  std::complex<double> response;
  double coherence;
};

/// Sum of squares at `count` lines from `first` on.
double power_of(const Spectrum& B, std::size_t first, Eigen::Index count) {
  double power = 0.0;
  if (B.empty()) return power;
  for (Eigen::Index i = 0; i < count; ++i)
    power += std::norm(B[first + static_cast<std::size_t>(i)]);
  return power;
}

/// Fits the polynomial to the lines `first`, first + 1, ... of the three transforms. r holds the
/// frequencies of these lines relative to the requested one. The delay rotates the phase of the
/// response by -angle * r, rad.
Fitted fit(const Spectrum& U,
           const Spectrum& Y,
           const Spectrum& B,
           std::size_t first,
           const std::vector<double>& r,
           double angle,
           int order) {
  const auto m = static_cast<Eigen::Index>(r.size());
  const Eigen::Index n = order + 1;
  // The complex equations are written as real ones: (Re -Im; Im Re) (Re h; Im h) = (Re Y; Im Y).
  Eigen::MatrixXd A(2 * m, 2 * n);
  Eigen::VectorXd b(2 * m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const auto k = first + static_cast<std::size_t>(i);
    const std::complex<double> turned =
        std::polar(1.0, -angle * r[static_cast<std::size_t>(i)]) * U[k];
    double power = 1.0;
    for (Eigen::Index p = 0; p < n; ++p, power *= r[static_cast<std::size_t>(i)]) {
      const std::complex<double> u = power * turned;
      A(i, p) = A(m + i, n + p) = u.real();
      A(m + i, p) = u.imag();
      A(i, n + p) = -u.imag();
    }
    b[i] = Y[k].real();
    b[m + i] = Y[k].imag();
  }
  const double size = b.squaredNorm(), beside = power_of(B, first, m);
  if (!(A.squaredNorm() > 0.0) || !(size > 0.0)) return {0.0, 0.0};
  const Eigen::VectorXd h = shortest_solution(A, b);
  const double left = (b - A * h).squaredNorm() / static_cast<double>(m - n) +
                      beside / static_cast<double>(m),
               all = (size + beside) / static_cast<double>(m);
  return {{h[0], h[n]}, std::clamp(1.0 - left / all, 0.0, 1.0)};
}

}  // namespace

LocalResponse local_response(std::span<const double> x,
                             std::span<const double> y,
                             double rate,
                             std::span<const double> frequencies,
                             const LocalSettings& settings,
                             std::span<const double> beside) {
  assert(x.size() == y.size() && x.size() > 1 && rate > 0.0);
  assert(beside.empty() || beside.size() == x.size());
  const int length = fast_length(static_cast<int>(x.size()));
  const Spectrum U = transform_of_steps(x, length), Y = transform_of_steps(y, length);
  const Spectrum B = beside.empty() ? Spectrum() : transform_of_steps(beside, length);
  const double spacing = rate / length;
  // Zeros appended to the record move the lines of its transform closer together but add no
  // information, so the spacing of lines is that of the record without them.
  const double apart = rate / static_cast<double>(x.size());
  const double width = std::max(settings.width, settings.lines * apart);
  const long last = std::ssize(U) - 1;
  LocalResponse found;
  for (const double f : frequencies) {
    long low = std::lround((f - width) / spacing), high = std::lround((f + width) / spacing);
    // Near the ends of the record's band the range of lines is shifted inward and keeps its width.
    if (low < 1) high += 1 - std::exchange(low, 1);
    if (high > last) low = std::max(1L, low - (high - std::exchange(high, last)));
    std::vector<double> r;
    for (long k = low; k <= high; ++k) r.push_back((static_cast<double>(k) * spacing - f) / width);
    assert(std::ssize(r) > settings.order + 1);
    const double angle = 2.0 * std::numbers::pi * width * settings.delay;
    const Fitted fitted = fit(U, Y, B, static_cast<std::size_t>(low), r, angle, settings.order);
    found.response.push_back(fitted.response);
    found.coherence.push_back(fitted.coherence);
  }
  return found;
}

}  // namespace latsch::numerics
