// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/trust_region_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "optimization/trust_region/flat_directions.h"

namespace latsch {
namespace {

using Kind = Wanted::Kind;

// Shares of the variance of slopes before anything was known:
constexpr double kUnknown = 0.5;  // a direction to probe before any step
constexpr double kPoor =
    0.02;  // a direction to probe when a step disappoints: no sample within 7 radii

constexpr double kGoodGain = 0.5;    // gain above which the radius may grow
constexpr double kBadGain = 0.1;     // gain below which the radius shrinks
constexpr double kGrowth = 2.0;      // least factor of the radius over the step after a good gain
constexpr double kMostGrowth = 4.0;  // largest factor
constexpr double kShrinkage = 0.7;   // largest factor of the radius after a bad gain
constexpr double kMostShrinkage = 0.1;  // least factor of the radius after a bad gain
constexpr double kWidest = 0.5;         // half the cube's width

constexpr double kSettled = 0.1;  // share of the initial radius: below it a flat model is believed

constexpr int kFailuresToShrink = 2;  // number in a row that halves the radius
constexpr int kFailuresToGiveUp = 4;  // number in a row after which this center gets no more probes
constexpr int kDisappointments = 3;   // number in a row before noise is estimated
constexpr double kDrowned = 1e4;      // noise relative to curvature: as large as the slopes
constexpr int kWidenings = 3;         // largest number, for a box too small for the noise

/// Box sizes of further steps while the outcome of the first one is awaited.
constexpr std::array kBoxes{1.0, 0.25, 2.0, 0.5, 0.1, 4.0, 0.03, 0.01};
/// Distances of restarts from the best point, one after the other, as shares of the initial radius.
constexpr std::array kJumps{0.1, 1.0, 0.03, 0.3};

// Constants of the verification:
constexpr double kSharp = 0.1;         // shortest move for fresh slopes over the step tolerance
constexpr double kWorthASearch = 0.5;  // share of the value: below it a new search starts
// Share of the value: less is verified again whatever the noise.
constexpr double kBeyondNoise = 0.9;
// Share of the first value: a ten-thousandth of the residuals.
constexpr double kNothingLeft = 1e-8;

constexpr double kAtBound = 1e-9;

constexpr double kWorthALook = 0.9;  // share of the value when it last settled

/// Mean rise of the sum of squares over moves of a length in all directions, by slopes J.
double mean_rise(const Eigen::MatrixXd& J, double length) {
  return length * length * J.squaredNorm() / static_cast<double>(J.cols());
}

}  // namespace

TrustRegionRun::TrustRegionRun(const DesignSpace& space, const ResidualTrustRegionOptions& options)
    : options_(options), box_(space, options.initial_radius, options.seed) {
  wanted_.push_back(box_.at(box_.c(), Kind::start));
  fill();
}

void TrustRegionRun::fill() {
  while (wanted_.size() < options_.outstanding) {
    auto next_point = next();
    if (!next_point) return;
    wanted_.push_back(std::move(*next_point));
  }
}

/// Returns the next point, after those already wanted_; nullopt at the end.
std::optional<Wanted> TrustRegionRun::next() {
  if (is_over_ || has_settled_) return std::nullopt;
  if (verification_) return next_to_verify();
  if (auto point = next_of_search()) return point;
  if (is_hopeless() || !box_.has_center()) return std::nullopt;
  if (wanted_.empty() && widen_in_noise()) {
    if (auto point = next_of_search()) return point;
  }
  if (wanted_.empty() && begin_verification()) return next_to_verify();
  if (wanted_.empty()) return restart();
  return look_around();
}

/// Handles geometry, model, step and radius; returns nullopt if no step predicts a gain.
std::optional<Wanted> TrustRegionRun::next_of_search() {
  while (box_.radius >= options_.step_tolerance && !is_hopeless()) {
    const bool bears_probes = !box_.has_center() || failures_ < kFailuresToGiveUp;
    const OpenDirection open = open_direction();
    if (open.share > kUnknown && bears_probes) {
      if (auto probe = box_.probe(open.direction, wanted_)) return probe;
    }
    if (!box_.has_center()) return box_.explore(wanted_);
    if (std::exchange(is_geometry_doubted_, false) && open.share > kPoor) {
      if (auto probe = box_.probe(open.direction, wanted_)) return probe;
    }
    const ResidualKriging m = box_.model(disappointments_ >= kDisappointments);
    if (box_.noise >= kDrowned && !has_widened_ && box_.radius < options_.initial_radius) {
      has_widened_ = true;
      box_.radius *= 2.0;
      continue;
    }
    if (is_step_awaited()) return another_step(m);
    const Wanted first = box_.step(m, kBoxes.front(), wanted_);
    if (first.length > 0.0) return first;
    if (open.share > kPoor && bears_probes) {
      if (auto probe = box_.probe(open.direction, wanted_)) return probe;
    }
    if (!box_.promises(first) && box_.radius < kSettled * options_.initial_radius) break;
    box_.radius *= 0.1;
  }
  return std::nullopt;
}

void TrustRegionRun::observe(const DesignPoint& point,
                             const Eigen::VectorXd& u,
                             const std::optional<ResidualSample>& sample) {
  const std::optional<Wanted> own = wanted_.take(point);
  if (!own && !sample) {  // a failure from any source carries no information about this run's steps
    box_.memory.add_failure(u);
    return;
  }
  const Wanted tried = own ? *own : Wanted{u, point, Kind::probe, box_.center(), box_.f()};
  has_widened_ = false;
  if (sample && sample->f < box_.explosion() && !box_.leaps(*sample)) {
    take(tried, {tried.u, sample->r, sample->J, sample->f, sample->stand_ins});
  } else {
    take_failure(tried, sample);
  }
  fill();
}

void TrustRegionRun::take(const Wanted& tried, ResidualSample sample) {
  failures_ = 0;
  const double gain = (tried.f_center - sample.f) / (tried.f_center - tried.predicted);
  const bool is_of_center = tried.center == box_.center();
  if (tried.kind == Kind::start && is_scouting_ && is_same(sample.r, box_.memory[box_.best()].r)) {
    wanted_.push_back(start());
    return;
  }
  const bool is_known = f_first_ < std::numeric_limits<double>::infinity();
  if (restarts_ == 0 && (tried.kind == Kind::start || !is_known)) f_first_ = sample.f;
  const bool is_best = box_.take(std::move(sample));
  if (is_best) explored_ = 0;
  if (tried.kind != Kind::step) return;
  if (verification_) return judge_verifying_step(gain, tried.f_center - tried.predicted);
  if (gain > kGoodGain) disappointments_ = 0;
  if (is_best && gain > kGoodGain) {
    box_.radius = std::clamp(box_.radius, kGrowth * tried.length, kMostGrowth * tried.length);
    box_.radius = std::min(box_.radius, kWidest);
  } else if (gain < kBadGain && is_of_center && tried.length <= 1.01 * box_.radius) {
    box_.radius *= std::clamp(tried.length / box_.radius, kMostShrinkage, kShrinkage);
    is_geometry_doubted_ = true;
    ++disappointments_;
  }
}

void TrustRegionRun::take_failure(const Wanted& tried,
                                  const std::optional<ResidualSample>& exploded) {
  box_.memory.add_failure(tried.u);
  ++failures_;
  if (tried.kind == Kind::start && !box_.has_center()) return start_again(tried.u);
  if (verification_) {
    if (tried.kind == Kind::step) verification_->observe_failed_step();
    if (tried.kind == Kind::probe) verification_->observe_failed_probe(change_of(exploded));
    return;
  }
  if (failures_ >= kFailuresToGiveUp) {
    box_.radius *= 0.1;
  } else if (tried.kind == Kind::step && failures_ >= kFailuresToShrink) {
    box_.radius *= 0.5;
  }
}

/// Returns the change of the residuals from the center relative to their size there; NaN if the
/// trial has none.
double TrustRegionRun::change_of(const std::optional<ResidualSample>& sample) const {
  if (!sample || !box_.has_center()) return std::numeric_limits<double>::quiet_NaN();
  const Eigen::VectorXd& r = box_.memory[box_.center()].r;
  return (sample->r - r).norm() / r.norm();
}

/// Returns the least known direction; none if the model brought its slopes, or the region is a
/// single point.
TrustRegionRun::OpenDirection TrustRegionRun::open_direction() const {
  if (box_.has_center() && box_.memory[box_.center()].J.size() > 0) return {};
  const SlopeVariance g = box_.geometry(wanted_);
  const Eigen::Index last = g.share.size() - 1;
  if (last < 0) return {};
  return {g.share[last], g.directions.col(last)};
}

bool TrustRegionRun::is_step_awaited() const {
  return std::any_of(wanted_.begin(), wanted_.end(), [&](const Wanted& w) {
    return w.kind == Kind::step && w.center == box_.center();
  });
}

std::optional<Wanted> TrustRegionRun::another_step(const ResidualKriging& m) {
  for (std::size_t k = 1; k < kBoxes.size(); ++k) {
    Wanted other = box_.step(m, kBoxes[k], wanted_);
    if (other.length > 0.0) return other;
  }
  return box_.explore(wanted_);
}

/// If noise led the steps until the box was too small to show anything else, widens it to twice the
/// radius at which curvature, whose variance in the box goes as radius^4, is as large as noise.
bool TrustRegionRun::widen_in_noise() {
  if (box_.noise <= 0.0 || box_.radius >= options_.initial_radius) return false;
  if (widenings_ >= kWidenings) return false;
  ++widenings_;
  const double wide = 2.0 * box_.radius * std::pow(std::max(1.0, box_.noise), 0.25);
  box_.radius = std::min(wide, options_.initial_radius);
  disappointments_ = 0;
  return true;
}

/// Explores around the center while outcomes are outstanding, once for each idle worker.
std::optional<Wanted> TrustRegionRun::look_around() {
  return explored_++ < options_.outstanding ? box_.explore(wanted_) : std::nullopt;
}

/// Returns false if nothing is left to gain, if the last verification still holds within noise, if
/// the model brings its slopes, or if the region is a single point.
bool TrustRegionRun::begin_verification() {
  if (box_.memory[box_.center()].J.size() > 0 || box_.f() >= f_verified_) return false;
  if (box_.f() < kNothingLeft * f_first_) {
    ending_ = Ending::explained;
    return false;
  }
  verification_.emplace(box_,
                        FreshSlopes::Options{.shortest = kSharp * options_.step_tolerance,
                                             .noise_alone = options_.noise_alone,
                                             .f_least = kNothingLeft * f_first_});
  if (!verification_->has_axes()) {
    ending_ = Ending::verified;
    verification_.reset();
  }
  return verification_.has_value();
}

/// Returns the next point of the verification, or a restart if no gain above noise is predicted.
std::optional<Wanted> TrustRegionRun::next_to_verify() {
  if (auto point = verification_->next(box_, wanted_)) return point;
  if (!wanted_.empty()) return look_around();
  f_verified_ = std::max(box_.f() - verification_->deviation(), kBeyondNoise * box_.f());
  if (box_.center() == box_.best()) ending_ = verification_->ending();
  verification_.reset();
  return restart();
}

/// Starts a new search if the step gained much.
void TrustRegionRun::judge_verifying_step(double gain, double promise) {
  verification_->observe_step(gain < kBadGain, promise);
  if (verification_->is_sharp()) return;
  if (gain > kGoodGain && box_.f() < kWorthASearch * verification_->f_begin()) {
    box_.radius = kSettled * options_.initial_radius;
    disappointments_ = 0;
    verification_.reset();
  }
}

std::optional<Wanted> TrustRegionRun::restart() {
  if (restarts_ >= options_.restarts || box_.best() < 0 || box_.is_point()) return std::nullopt;
  if (box_.center() == box_.best()) rise_ = mean_rise(box_.slopes(), options_.initial_radius);
  if (is_down_to_noise()) return std::nullopt;
  const bool is_noise_stated = options_.noise_alone > 0.0;
  const bool is_explained =
      !is_noise_stated && best().f < options_.explained * std::min(f_first_, rise_);
  if (!is_explained && box_.center() == box_.best()) {
    if (best().f < kWorthALook * f_settled_) {
      f_settled_ = best().f;
      has_settled_ = true;
      return std::nullopt;
    }
    flat_ = flat_directions(box_.slopes(), options_.initial_radius, best().r.norm());
  }
  if (auto released = release()) return released;
  if (is_explained) return std::nullopt;
  scouts_ = flat_.cols() > 0 ? n() + 1 : 0;
  explored_ = 0;
  const double jump = kJumps[restarts_++ % kJumps.size()] * options_.initial_radius;
  box_.radius = std::max(jump, options_.step_tolerance);
  return start();
}

/// Restarts with variables that ended on a bound moved to the middle of their ranges, once for each
/// best point.
std::optional<Wanted> TrustRegionRun::release() {
  if (!box_.region.is_cube() || best().f >= kWorthALook * f_released_) return std::nullopt;
  if (best().f < kNothingLeft * f_first_) return std::nullopt;
  Eigen::VectorXd u = best().u;
  bool is_held = false;
  for (double& value : u) {
    if (value > kAtBound && value < 1.0 - kAtBound) continue;
    value = 0.5;
    is_held = true;
  }
  if (!is_held) return std::nullopt;
  f_released_ = best().f;
  ++restarts_;
  scouts_ = 0;
  explored_ = 0;
  is_scouting_ = false;
  box_.radius = options_.initial_radius;
  box_.move_to(u);
  return box_.at(box_.c(), Kind::start);
}

/// Starts beside the best point, along flat_ directions as long as scouts_ are left.
Wanted TrustRegionRun::start() {
  const Eigen::VectorXd best = box_.memory[box_.best()].u;
  is_scouting_ = scouts_-- > 0;
  if (is_scouting_) {
    const Eigen::VectorXd along = flat_ * (flat_.transpose() * box_.draw());
    box_.move_to(box_.region.nearest(best + options_.initial_radius * along));
  } else {
    box_.move_to(box_.moved(best, box_.radius));
  }
  return box_.at(box_.c(), Kind::start);
}

/// After a failed start, begins the next scout or restart, or, as long as nothing has ever
/// succeeded, a start farther and farther away.
void TrustRegionRun::start_again(const Eigen::VectorXd& failed) {
  if (is_hopeless()) return;
  if (box_.best() >= 0) {
    auto another = is_scouting_ ? std::optional(start()) : restart();
    is_over_ = !another;
    if (another) wanted_.push_back(*another);
    return;
  }
  const double reach = options_.initial_radius * (1.0 + failures_ / n());
  constexpr int kTries = 100;  // many random points may be infeasible in a thin region
  for (int k = 0; k < kTries; ++k) {
    const Eigen::VectorXd u = box_.drawn_near(failed, reach);
    if (box_.memory.has_failed_near(u)) continue;  // a failed point repeated with the same bits
    box_.move_to(u);
    wanted_.push_back(box_.at(u, Kind::start));
    return;
  }
}

/// True if nothing ever succeeded, at many points.
bool TrustRegionRun::is_hopeless() const { return box_.best() < 0 && failures_ > 20 * (n() + 1); }

void TrustRegionRun::go_on(int restarts_left) {
  has_settled_ = false;
  options_.restarts = restarts_ + restarts_left;
  fill();
}

void TrustRegionRun::widen(int count) {
  options_.outstanding = count;
  fill();
}

}  // namespace latsch
