// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/lost_variables.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>

#include "optimization/problem/point_vector.h"

namespace latsch {
namespace {

/// Factors that are tried, as multiples of the present value. They go farther toward zero than away
/// from it: near zero most parts of a model have little influence, while far out their effect
/// vanishes.
constexpr std::array kFactors{0.5, 2.0, 0.25, 4.0, 0.125, 8.0, 0.0625, 16.0, 0.03125, 0.015625};

// Distance, as a share of the ranges, within which two points count as equal because bounds stopped
// the move.
constexpr double kSamePlace = 1e-9;

}  // namespace

LostVariables::LostVariables(const DesignSpace& space,
                             const FeasibleRegion& region,
                             const Eigen::VectorXd& u,
                             const Eigen::VectorXd& slopes,
                             const Eigen::VectorXd& test)
    : space_(space), region_(region), u_(u), test_(test), order_(u.size()), at_most_(space.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::stable_sort(
      order_.begin(), order_.end(), [&](int i, int j) { return slopes[i] < slopes[j]; });
}

Eigen::VectorXd LostVariables::next() const {
  assert(has_next());
  if (!is_testing()) return places_.back().u;
  Eigen::VectorXd moved = u_;
  const auto first = order_.begin() + (is_bisecting() ? 0 : tested_alone_);
  const auto end = is_bisecting() ? order_.begin() + bisected() : first + 1;
  for (auto i = first; i != end; ++i) {
    const double to = u_[*i] + test_[*i];
    moved[*i] = to < 0.0 || to > 1.0 ? u_[*i] - test_[*i] : to;
  }
  return region_.nearest(moved);
}

void LostVariables::observe(bool is_felt) {
  assert(has_next());
  if (!is_testing()) return places_.pop_back();
  learn(is_felt);
  if (!is_testing() && !lost_.empty()) find_places();
}

void LostVariables::learn(bool is_felt) {
  const auto n = static_cast<int>(std::ssize(order_));
  if (is_bisecting()) {
    (is_felt ? at_most_ : at_least_) = is_felt ? bisected() - 1 : bisected();
    if (is_bisecting()) return;
    lost_.assign(order_.begin(), order_.begin() + at_least_);
    // The bisection has shown that the next variable in the order has an effect.
    tested_alone_ = lost_.empty() ? n : std::min(n, at_least_ + 1);
  } else {
    if (!is_felt) lost_.push_back(order_[tested_alone_]);
    ++tested_alone_;
  }
}

void LostVariables::find_places() {
  std::vector<Place> places;
  const auto add = [&](const Eigen::VectorXd& moved, double factor) {
    const Eigen::VectorXd u = region_.nearest(moved);
    const auto is_near = [&](const Eigen::VectorXd& other) {
      return (u - other).lpNorm<Eigen::Infinity>() < kSamePlace;
    };
    const auto is_known = [&](const Place& place) { return is_near(place.u); };
    if (!is_near(u_) && std::none_of(places.begin(), places.end(), is_known)) {
      places.push_back({u, factor});
    }
  };
  const DesignPoint settled = space_.from_unit({u_.begin(), u_.end()});
  for (const double factor : kFactors) {
    DesignPoint scaled = settled;
    for (const int i : lost_) scaled.values[i] *= factor;
    add(to_vector(space_.to_unit(scaled)), factor);
  }
  places_.assign(places.rbegin(), places.rend());
}

}  // namespace latsch
