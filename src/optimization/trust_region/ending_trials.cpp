// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/ending_trials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "optimization/trust_region/flat_directions.h"

namespace latsch {
namespace {

// Distance from a bound, as a share of the range, within which a variable lies on it.
constexpr double kAtBound = 1e-9;
// Moves that show whether a variable has an effect, as shares of its range.
constexpr double kFarMove = 0.3, kNearMove = 0.1;
// Change of the residuals that the slopes predict over the far move, as a share of their norm,
// below which a variable may be flat. The slope of a variable without effect is not quite zero,
// because the curvature of others adds to it.
constexpr double kPerhapsFlat = 0.01;
// Share of its length that a move must keep inside of the bounds.
constexpr double kLeastRoom = 0.5;

bool is_at_upper(double u) { return u > 1.0 - kAtBound; }
bool is_at_bound(double u) { return u < kAtBound || is_at_upper(u); }

}  // namespace

EndingTrials::EndingTrials(const TrustBox& box,
                           int center,
                           const PointSlopes& slopes,
                           double tolerance,
                           bool r_has_vanished)
    : tolerance_(tolerance),
      r_has_vanished_(r_has_vanished),
      u_(box.memory[center].u),
      r_(box.memory[center].r) {
  if (!slopes.J.allFinite()) return;
  if (!r_has_vanished_) plan_bounds(box, slopes);
  plan_flat(box, slopes);
}

void EndingTrials::plan(const TrustBox& box, const Eigen::VectorXd& u, int of) {
  const bool is_inside = (box.region.nearest(u) - u).lpNorm<Eigen::Infinity>() < kAtBound;
  if (is_inside && !box.memory.has_failed_near(u)) left_.push_back({u, of});
}

void EndingTrials::plan_bounds(const TrustBox& box, const PointSlopes& slopes) {
  Eigen::VectorXd moved = u_;
  slope_ = std::numeric_limits<double>::infinity();
  for (int i = 0; i < box.n(); ++i) {
    if (!is_at_bound(u_[i])) continue;
    const double inward = is_at_upper(u_[i]) ? -1.0 : 1.0;
    const double slope = 2.0 * inward * r_.dot(slopes.J.col(i));
    const double m = static_cast<double>(r_.size());
    const double error = 2.0 * r_.norm() * std::sqrt(std::max(0.0, slopes.covariance(i, i)) / m);
    if (!(slope > error)) continue;
    at_bounds_.push_back(i);
    slope_ = std::min(slope_, slope / error);
    moved[i] += inward * tolerance_ * box.widths()[i];
  }
  if (!at_bounds_.empty()) plan(box, moved, kBounds);
}

void EndingTrials::plan_flat(const TrustBox& box, const PointSlopes& slopes) {
  for (int i = 0; i < box.n(); ++i) {
    const double felt = slopes.J.col(i).norm();
    // Compared with vanished residuals every effect is large, so the slope's own error decides.
    const bool is_unknown = r_has_vanished_ && felt * felt <= slopes.covariance(i, i);
    if (!is_unknown && !(kFarMove * felt <= kPerhapsFlat * r_.norm())) continue;
    Eigen::VectorXd moved = u_;
    moved[i] += u_[i] < 0.5 ? kFarMove : -kFarMove;
    plan(box, moved, i);
  }
}

void EndingTrials::plan_all_flat(const TrustBox& box) {
  is_flat_confirmed_ = true;
  for (const double move : {-kFarMove, kNearMove, -kNearMove}) {
    Eigen::VectorXd moved = u_;
    double longest = 0.0;
    for (const int i : flat_) {
      const double toward_middle = u_[i] < 0.5 ? move : -move;
      moved[i] = std::clamp(u_[i] + toward_middle, 0.0, 1.0);
      longest = std::max(longest, std::abs(moved[i] - u_[i]));
    }
    if (longest >= kLeastRoom * std::abs(move)) plan(box, moved, kAllFlat);
  }
}

std::optional<Wanted> EndingTrials::next(const TrustBox& box) {
  if (left_.empty() && awaited_.empty() && !flat_.empty() && !is_flat_confirmed_)
    plan_all_flat(box);
  if (left_.empty()) return std::nullopt;
  const Planned trial = left_.front();
  left_.erase(left_.begin());
  Wanted wanted = box.at(trial.u, Wanted::Kind::probe);
  awaited_.push_back({wanted.u, trial.of});
  return wanted;
}

void EndingTrials::observe(const Eigen::VectorXd& u, const std::optional<Eigen::VectorXd>& r) {
  const auto at = std::find_if(
      awaited_.begin(), awaited_.end(), [&](const Planned& trial) { return trial.u == u; });
  if (at == awaited_.end()) return;
  const int of = at->of;
  awaited_.erase(at);
  if (of == kBounds) {
    if (r && r->squaredNorm() > r_.squaredNorm())
      rise_ = (r->squaredNorm() - r_.squaredNorm()) / r_.squaredNorm();
    return;
  }
  const bool has_effect = !r || !is_same(*r, r_);
  if (of == kAllFlat && has_effect) flat_.clear();
  if (has_effect) return;
  if (of != kAllFlat) flat_.push_back(of);
  if (r_.norm() > 0.0) change_ = std::max(change_, (*r - r_).norm() / r_.norm());
  farthest_ = std::max(farthest_, (u - u_).lpNorm<Eigen::Infinity>());
}

void EndingTrials::report(const TrustBox& box, EndingEvidence& evidence) const {
  if (rise_) {
    EndingEvidence::Bounds bounds{.slope = slope_, .moved = tolerance_, .rise = *rise_};
    for (const int i : at_bounds_)
      (is_at_upper(u_[i]) ? bounds.upper : bounds.lower).push_back(box.space[i].name);
    evidence.bounds = bounds;
  }
  if (!flat_.empty()) {
    EndingEvidence::Flat flat{.change = change_, .farthest = farthest_};
    for (const int i : flat_) flat.names.push_back(box.space[i].name);
    evidence.flat = flat;
  }
}

}  // namespace latsch
