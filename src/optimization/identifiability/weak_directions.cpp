// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/weak_directions.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "optimization/problem/feasible_region.h"

namespace latsch {
namespace {

constexpr std::array kMoves{2e-3, 2e-4};  // shares of the range
// A direction is weak if its effect is less than this multiple of the curvature's errors.
constexpr double kBesideCurvature = 2.0;
// In a fit without noise, a direction is weak below this share of the strongest direction's effect.
constexpr double kWeak = 1e-2;
constexpr double kNoNoiseLeft = 1e-4;    // spread of residuals without stated noise
constexpr double kOfStatedNoise = 1e-2;  // spread of residuals relative to stated noise
constexpr double kAgree = 0.25;          // share of the smaller slope
constexpr double kOtherLength = 4.0;     // least ratio of two different lengths
// Multiple of the error from which on a component is known.
constexpr double kOfErrors = 3.0;
// Share of the error above which an effect counts as a slope.
constexpr double kFeltBeside = 0.1;
constexpr double kTakesPart = 0.1;  // least component of a unit vector that takes part

/// True if the residuals are smaller than any noise would leave.
bool fits_without_noise(const Linearization& at,
                        const Confidence& c,
                        const ConfidenceOptions& options) {
  const double rms = std::sqrt(at.sum_of_squares() / static_cast<double>(at.r.size()));
  return options.sigma ? rms < kOfStatedNoise * *options.sigma
                       : c.sigma < kNoNoiseLeft && rms < kNoNoiseLeft;
}

struct SlopeAlong {
  double length;
  Eigen::VectorXd g;
};

/// True if two slopes agree and their lengths differ enough: slopes over similar lengths always
/// agree.
bool agree(const SlopeAlong& a, const SlopeAlong& b) {
  const auto [shorter, longer] = std::minmax(a.length, b.length);
  return longer >= kOtherLength * shorter &&
         (a.g - b.g).norm() <= kAgree * std::min(a.g.norm(), b.g.norm());
}

/// Returns the shortest of the differences in J v.
double length_along(const Eigen::VectorXd& v, const Eigen::VectorXd& lengths) {
  double least = 1.0;
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (std::abs(v[i]) > kTakesPart) least = std::min(least, lengths[i]);
  return least;
}

/// Returns v with only the components that exceed the errors of slopes, whose norm is `error`: a
/// variable without a part in v is not as open as v.
Eigen::VectorXd without_errors(Eigen::VectorXd v, double error, const Eigen::MatrixXd& J) {
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (std::abs(v[i]) * J.col(i).norm() < kOfErrors * error) v[i] = 0.0;
  return v.normalized();
}

}  // namespace

WeakDirections::WeakDirections(const DesignSpace& space,
                               const Linearization& at,
                               const Confidence& c,
                               const Differences& made,
                               const ConfidenceOptions& options)
    : made_(made) {
  const bool has_no_noise = fits_without_noise(at, c, options);
  const FeasibleRegion region(space);
  for (Eigen::Index k = 0; k < c.singular_values.size(); ++k) {
    const Eigen::VectorXd v = c.directions.col(k);
    const double felt = c.singular_values[k];
    const double error = kBesideCurvature * made.curvature.cwiseProduct(v).norm();
    const bool is_weak = felt < error || (has_no_noise && felt < kWeak * c.singular_values[0]);
    if (!is_weak || !(c.deviation(static_cast<int>(k)) < 1.0)) continue;
    std::vector<Stencil> own;
    for (const double length : kMoves) {
      for (const auto& [near, far] : {std::pair(1.0, -1.0), {1.0, 2.0}, {-1.0, -2.0}}) {
        const Eigen::VectorXd u1 = at.u + near * length * v, u2 = at.u + far * length * v;
        if (!region.contains(u1) || !region.contains(u2)) continue;
        own.push_back({static_cast<int>(std::ssize(directions_)), length, near, far});
        break;
      }
    }
    if (own.size() < kMoves.size()) continue;
    directions_.push_back({v, length_along(v, made.lengths)});
    for (const Stencil& s : own) {
      stencils_.push_back(s);
      for (const double offset : {s.near, s.far})
        wanted_.emplace_back((at.u + offset * s.length * v).cwiseMax(0.0).cwiseMin(1.0));
    }
  }
}

std::optional<Eigen::VectorXd> WeakDirections::slope(const Stencil& s,
                                                     const Eigen::VectorXd& center,
                                                     const Eigen::VectorXd* near,
                                                     const Eigen::VectorXd* far) const {
  if (!near || !far) return std::nullopt;
  if (s.far == -s.near) return (*near - *far) / (2.0 * s.length);
  return s.near * (4.0 * *near - *far - 3.0 * center) / (2.0 * s.length);
}

Eigen::MatrixXd WeakDirections::checked(
    const Linearization& at, const std::vector<std::optional<Eigen::VectorXd>>& residuals) {
  assert(residuals.size() == wanted_.size());
  Eigen::MatrixXd J = at.J;
  for (size_t d = 0; d < directions_.size(); ++d) {
    const Eigen::VectorXd& v = directions_[d].v;
    std::vector<SlopeAlong> slopes{{directions_[d].length, at.J * v}};
    for (size_t k = 0; k < stencils_.size(); ++k) {
      if (stencils_[k].direction != static_cast<int>(d)) continue;
      const auto at_place = [&](size_t i) { return residuals[i] ? &*residuals[i] : nullptr; };
      if (auto g = slope(stencils_[k], at.r, at_place(2 * k), at_place(2 * k + 1)))
        slopes.push_back({stencils_[k].length, std::move(*g)});
    }
    if (slopes.size() == 1) continue;  // the model fails there: only the differences are left
    // The shorter length of an agreeing pair is used, or J v itself if it is in the pair.
    const SlopeAlong* held = nullptr;
    for (size_t a = 0; a < slopes.size() && !held; ++a)
      for (size_t b = a + 1; b < slopes.size() && !held; ++b)
        if (agree(slopes[a], slopes[b])) held = &slopes[a == 0 ? 0 : b];
    if (held == &slopes[0]) continue;
    double error = 0.0;
    for (const SlopeAlong& slope : slopes) error = std::max(error, (slope.g - slopes[0].g).norm());
    const bool is_felt = held && held->g.norm() > kFeltBeside * error;
    const Eigen::VectorXd w = is_felt ? v : without_errors(v, error, at.J);
    J -= (J * w) * w.transpose();
    if (is_felt) J += held->g * w.transpose();
    if (!held) unknown_.push_back(w);
    for (Eigen::Index i = 0; held && i < w.size(); ++i)
      if (std::abs(w[i]) > kTakesPart) made_.lengths[i] = std::min(made_.lengths[i], held->length);
  }
  return J;
}

}  // namespace latsch
