// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/trust_restarts.h"

#include <algorithm>

#include "optimization/trust_region/flat_directions.h"

namespace latsch {
namespace {

/// Returns the mean increase of the sum of squares over moves of the given length in all
/// directions, from the slopes J.
double mean_rise(const Eigen::MatrixXd& J, double length) {
  return length * length * J.squaredNorm() / static_cast<double>(J.cols());
}

}  // namespace

bool TrustRestarts::may_follow(TrustBox& box, const ResidualTrustRegionOptions& options) {
  if (count_ >= options.restarts || box.best() < 0 || box.is_point()) return false;
  if (box.center() == box.best()) rise_ = mean_rise(box.slopes(), options.initial_radius);
  return !box.is_down_to(options.noise_alone);
}

bool TrustRestarts::is_explained(double f_best,
                                 double f_first,
                                 const ResidualTrustRegionOptions& options) const {
  const bool is_noise_stated = options.noise_alone > 0.0;
  return !is_noise_stated && f_best < options.explained * std::min(f_first, rise_);
}

bool TrustRestarts::is_worth_a_look(double f_best) {
  if (!(f_best < tuning_.worth_a_look * f_settled_)) return false;
  f_settled_ = f_best;
  return true;
}

void TrustRestarts::find_flat_directions(TrustBox& box, double initial_radius) {
  flat_ = flat_directions(box.slopes(), initial_radius, box.memory[box.best()].r.norm());
}

std::optional<Wanted> TrustRestarts::release(TrustBox& box, double initial_radius, double f_least) {
  const ResidualSample& best = box.memory[box.best()];
  if (!box.region.is_cube() || best.f >= tuning_.worth_a_look * f_released_) return std::nullopt;
  if (best.f < f_least) return std::nullopt;
  Eigen::VectorXd u = best.u;
  bool is_held = false;
  for (double& value : u) {
    if (value > tuning_.at_bound && value < 1.0 - tuning_.at_bound) continue;
    value = 0.5;
    is_held = true;
  }
  if (!is_held) return std::nullopt;
  f_released_ = best.f;
  ++count_;
  scouts_ = 0;
  is_scouting_ = false;
  box.radius = initial_radius;
  box.move_to(u);
  return box.at(box.c(), Wanted::Kind::start);
}

Wanted TrustRestarts::begin(TrustBox& box, const ResidualTrustRegionOptions& options) {
  scouts_ = flat_.cols() > 0 ? box.n() + 1 : 0;
  const double jump = tuning_.jumps[count_++ % tuning_.jumps.size()] * options.initial_radius;
  box.radius = std::max(jump, options.step_tolerance);
  return start(box, options.initial_radius);
}

Wanted TrustRestarts::start(TrustBox& box, double initial_radius) {
  const Eigen::VectorXd best = box.memory[box.best()].u;
  is_scouting_ = scouts_-- > 0;
  if (is_scouting_) {
    const Eigen::VectorXd along = flat_ * (flat_.transpose() * box.draw());
    box.move_to(box.region.nearest(best + initial_radius * along));
  } else {
    box.move_to(box.moved(best, box.radius));
  }
  return box.at(box.c(), Wanted::Kind::start);
}

}  // namespace latsch
