// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/weak_directions.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "optimization/problem/feasible_region.h"

namespace latsch {
namespace {

// Lengths of the moves along a direction, as shares of the range.
constexpr std::array kMoves{2e-3, 2e-4};
// A direction is weak if its effect is less than this multiple of the errors caused by curvature.
constexpr double kBesideCurvature = 2.0;
// In a fit without noise, a direction is weak if its effect is below this share of the strongest
// direction's effect.
constexpr double kWeak = 1e-2;
// Spread of the residuals below which a fit counts as free of noise, if no noise is stated.
constexpr double kNoNoiseLeft = 1e-4;
// Spread of the residuals, as a share of the stated noise, below which a fit counts as free of
// noise.
constexpr double kOfStatedNoise = 1e-2;
// Largest difference of two slopes that agree, as a share of the smaller slope.
constexpr double kAgree = 0.25;
// Smallest ratio of two lengths whose slopes may be compared.
constexpr double kOtherLength = 4.0;
// Multiple of the error above which a component of a direction counts as known.
constexpr double kOfErrors = 3.0;
// Share of the error above which an effect counts as a slope different from zero.
constexpr double kFeltBeside = 0.1;
// Smallest component of a direction of length 1 with which a variable takes part in it.
constexpr double kTakesPart = 0.1;

/// True if the residuals are so small that they contain no noise.
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

/// True if two slopes agree and their lengths differ enough. Slopes over similar lengths always
/// agree, which proves nothing.
bool agree(const SlopeAlong& a, const SlopeAlong& b) {
  const auto [shorter, longer] = std::minmax(a.length, b.length);
  return longer >= kOtherLength * shorter &&
         (a.g - b.g).norm() <= kAgree * std::min(a.g.norm(), b.g.norm());
}

/// Returns the shortest length of the differences that J v is computed from.
double length_along(const Eigen::VectorXd& v, const Eigen::VectorXd& lengths) {
  double least = 1.0;
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (std::abs(v[i]) > kTakesPart) least = std::min(least, lengths[i]);
  return least;
}

/// Returns v without the components that do not exceed the errors of the slopes, whose norm is
/// `error`. A variable without a component in v is not undetermined along v.
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
    // The model fails at the points along the direction, so only the differences of J are left.
    if (slopes.size() == 1) continue;
    // If two slopes agree, the one over the shorter length is used; if one of them is J v, J v is
    // kept.
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
