// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/prediction_band.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace latsch {
namespace {

// Smallest share of a band's width for which its cause is reported.
constexpr double kLeastShare = 0.1;

}  // namespace

PredictionBands::Reach PredictionBands::Reach::times(double factor) const {
  return {std::min(factor * lower, factor * upper), std::max(factor * lower, factor * upper)};
}

void PredictionBands::Reach::operator+=(const Reach& other) {
  lower += other.lower;
  upper += other.upper;
}

PredictionBands::Reach PredictionBands::reach(const Eigen::VectorXd& g) const {
  Reach all;
  for (Eigen::Index i = 0; i < g.size(); ++i) all += Reach{-u_[i], 1.0 - u_[i]}.times(g[i]);
  return all;
}

PredictionBands::PredictionBands(const Eigen::VectorXd& u, const Confidence& confidence)
    : u_(u), free_(confidence.free), open_(free_.axes.cols()), held_(u.size()) {
  assert(std::isfinite(confidence.sigma));
  for (Eigen::Index k = 0; k < free_.axes.cols(); ++k) {
    const Reach cube = reach(free_.axes.col(k));
    if (free_.t * std::sqrt(free_.covariance(k, k)) < std::max(-cube.lower, cube.upper)) continue;
    open_[static_cast<size_t>(k)] = cube;
    free_.covariance.row(k).setZero();
    free_.covariance.col(k).setZero();
    free_.left[k] = 0.0;
    free_.following.row(k).setZero();
  }
  for (size_t i = 0; i < held_.size(); ++i) {
    const Interval& interval = confidence.intervals[i];
    const double at = u[static_cast<Eigen::Index>(i)];
    if (confidence.held[i] == Bound::lower) held_[i].upper = std::min(interval.upper, 1.0) - at;
    if (confidence.held[i] == Bound::upper) held_[i].lower = std::max(interval.lower, 0.0) - at;
  }
}

PredictionBand PredictionBands::of(const Eigen::VectorXd& g) const {
  const Eigen::VectorXd a = free_.axes.transpose() * g;
  const double half =
      free_.t * std::sqrt(std::max(0.0, a.dot(free_.covariance * a))) + std::abs(a.dot(free_.left));
  Reach band{-half, half};
  // Contributions of open directions and of held variables to the width.
  std::vector<double> open, held;
  for (size_t k = 0; k < open_.size(); ++k) {
    const Reach moved = open_[k].times(a[static_cast<Eigen::Index>(k)]);
    open.push_back(moved.width());
    band += moved;
  }
  for (size_t i = 0; i < held_.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    double slope = g[column] + a.dot(free_.following.col(column));
    if (free_.kept.size() > 0) slope += g.dot(free_.kept.col(column));
    const Reach moved = held_[i].times(slope);
    held.push_back(moved.width());
    band += moved;
  }
  const auto largest = [&](const std::vector<double>& parts) {
    const auto most = std::max_element(parts.begin(), parts.end());
    const bool counts = most != parts.end() && *most > 0.0 && *most >= kLeastShare * band.width();
    return counts ? static_cast<int>(most - parts.begin()) : -1;
  };
  const Reach cube = reach(g);
  return {std::max(band.lower, cube.lower),
          std::min(band.upper, cube.upper),
          largest(open),
          largest(held)};
}

}  // namespace latsch
