// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/trust_region_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "optimization/trust_region/flat_directions.h"

namespace latsch {
namespace {

using Kind = Wanted::Kind;

// Largest number of times that a run goes on from a better point that the tests of its end found.
constexpr int kMostReturns = 3;

}  // namespace

TrustRegionRun::TrustRegionRun(const DesignSpace& space,
                               const ResidualTrustRegionOptions& options,
                               const TrustRegionTuning& tuning)
    : options_(options),
      tuning_(tuning),
      box_(space, options.initial_radius, options.seed),
      radius_(options.initial_radius, tuning.radius),
      restarts_(tuning.restarts) {
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

/// Returns the next point in addition to those already in wanted_; nullopt at the end.
std::optional<Wanted> TrustRegionRun::next() {
  if (state_ == State::searching) {
    if (auto point = next_of_run()) return point;
  }
  if (state_ == State::settled || !tests_end_) return std::nullopt;
  const bool is_waiting = state_ == State::searching && !wanted_.empty();
  return is_waiting ? std::nullopt : next_at_end();
}

/// Returns the next point of the search, of its verification or of a restart.
std::optional<Wanted> TrustRegionRun::next_of_run() {
  if (verification_) return next_to_verify();
  if (auto point = next_of_search()) return point;
  if (is_hopeless() || !box_.has_center()) return std::nullopt;
  if (wanted_.empty() && radius_.widen_in_noise(box_)) {
    if (auto point = next_of_search()) return point;
  }
  if (wanted_.empty() && begin_verification()) return next_to_verify();
  if (wanted_.empty()) return restart();
  return look_around();
}

/// Returns the next probe or step of the search in the box, after adjusting geometry, model and
/// radius; nullopt if no step predicts a gain.
std::optional<Wanted> TrustRegionRun::next_of_search() {
  while (box_.radius >= options_.step_tolerance && !is_hopeless()) {
    const bool bears_probes = !box_.has_center() || radius_.bears_probes();
    const OpenDirection open = open_direction();
    if (bears_probes) {
      if (auto unknown = probe(open, tuning_.geometry.unknown)) return unknown;
    }
    if (!box_.has_center()) return box_.scatter(wanted_);
    if (radius_.doubts_geometry()) {
      if (auto poor = probe(open, tuning_.geometry.poor)) return poor;
    }
    const ResidualKriging m = box_.model(radius_.suspects_noise());
    if (radius_.widen_if_drowned(box_)) continue;
    if (is_step_awaited()) return another_step(m);
    const Wanted first = box_.step(m, tuning_.search.boxes.front(), wanted_);
    if (first.length > 0.0) return first;
    if (bears_probes) {
      if (auto poor = probe(open, tuning_.geometry.poor)) return poor;
    }
    // Outcomes that are still awaited may change the model, so the box is not judged before them.
    if (!wanted_.empty()) return look_around();
    if (!box_.promises(first) && box_.radius < settled_radius()) break;
    radius_.shrink_without_step(box_);
  }
  return std::nullopt;
}

void TrustRegionRun::observe(const DesignPoint& point,
                             const Eigen::VectorXd& u,
                             const std::optional<ResidualSample>& sample) {
  const std::optional<Wanted> own = wanted_.take(point);
  if (!own) returns_ = 0;
  // A failed point that this run did not propose contains no information about its steps.
  if (!own && !sample) {
    box_.memory.add_failure(u);
    return;
  }
  const Wanted tried = own ? *own : Wanted{u, point, Kind::probe, box_.center(), box_.f()};
  radius_.observe_outcome();
  if (sample && sample->f < box_.explosion() && !box_.leaps(*sample)) {
    take(tried, {tried.u, sample->r, sample->J, sample->f, sample->stand_ins});
  } else {
    take_failure(tried, sample);
  }
  fill();
}

void TrustRegionRun::take(const Wanted& tried, ResidualSample sample) {
  radius_.observe_success();
  const double gain = (tried.f_center - sample.f) / (tried.f_center - tried.predicted);
  const bool is_of_center = tried.center == box_.center();
  if (tried.kind == Kind::start && restarts_.is_scouting() && is_same(sample.r, best().r)) {
    wanted_.push_back(restarts_.start(box_, options_.initial_radius));
    return;
  }
  const bool is_known = f_first_ < std::numeric_limits<double>::infinity();
  if (restarts_.count() == 0 && (tried.kind == Kind::start || !is_known)) f_first_ = sample.f;
  if (tried.kind == Kind::probe && box_.has_center() && !box_.knows_slopes()) {
    box_.learn_from_first_probe(change_of(sample));
  }
  if (state_ == State::ending) observe_at_end(tried, sample.r);
  const bool is_best = box_.take(std::move(sample));
  if (is_best) explored_ = 0;
  if (is_best && state_ == State::ending && !verification_ && box_.f() < f_verified_ &&
      returns_++ < kMostReturns) {
    go_on_searching();
  }
  if (tried.kind != Kind::step) return;
  if (verification_) return judge_verifying_step(gain, tried.f_center - tried.predicted);
  radius_.judge_step(box_, tried, gain, is_best, is_of_center);
}

void TrustRegionRun::take_failure(const Wanted& tried,
                                  const std::optional<ResidualSample>& exploded) {
  box_.memory.add_failure(tried.u);
  radius_.observe_failure();
  if (tried.kind == Kind::start && !box_.has_center()) return start_again(tried.u);
  if (state_ == State::ending && !verification_) return observe_at_end(tried, std::nullopt);
  if (!verification_) return radius_.shrink_after_failure(box_, tried);
  if (tried.kind == Kind::step) verification_->observe_failed_step();
  if (tried.kind == Kind::probe) verification_->observe_failed_probe(change_of(exploded));
}

/// Returns the change of the residuals from the center to the sample, relative to their size at the
/// center; NaN if there is no sample or no center.
double TrustRegionRun::change_of(const std::optional<ResidualSample>& sample) const {
  if (!sample || !box_.has_center()) return std::numeric_limits<double>::quiet_NaN();
  const Eigen::VectorXd& r = box_.memory[box_.center()].r;
  return (sample->r - r).norm() / r.norm();
}

/// Returns the direction along which the slopes are known least. It is empty if the model computes
/// its derivatives, or if the region is a single point.
TrustRegionRun::OpenDirection TrustRegionRun::open_direction() const {
  if (box_.has_center() && box_.memory[box_.center()].J.size() > 0) return {};
  const SlopeVariance g = box_.geometry(wanted_);
  const Eigen::Index last = g.share.size() - 1;
  if (last < 0) return {};
  return {g.share[last], g.directions.col(last)};
}

/// Returns a probe along the direction if more than `least_share` of the variance of its slope
/// remains; nullopt otherwise.
std::optional<Wanted> TrustRegionRun::probe(const OpenDirection& open, double least_share) const {
  return open.share > least_share ? box_.probe(open.direction, wanted_) : std::nullopt;
}

bool TrustRegionRun::is_step_awaited() const {
  return std::any_of(wanted_.begin(), wanted_.end(), [&](const Wanted& w) {
    return w.kind == Kind::step && w.center == box_.center();
  });
}

/// Returns a further point while the outcome of a step is awaited: a probe beside the best awaited
/// step, a step in a box of another size, or a point near the best predicted one.
std::optional<Wanted> TrustRegionRun::another_step(const ResidualKriging& m) {
  const Wanted* best = nullptr;
  int steps = 0;
  for (const Wanted& w : wanted_) {
    if (w.kind != Kind::step || w.center != box_.center()) continue;
    ++steps;
    if (!best || w.predicted < best->predicted) best = &w;
  }
  if (best) {
    if (auto beside = box_.probe_beside(*best, tuning_.geometry.beside, wanted_)) return beside;
  }
  const int most = std::min(1 + options_.outstanding / 4, tuning_.search.most_steps);
  for (std::size_t k = 1; k < tuning_.search.boxes.size() && steps < most; ++k) {
    Wanted other = box_.step(m, tuning_.search.boxes[k], wanted_);
    if (other.length > 0.0) return other;
  }
  return box_.explore(wanted_);
}

/// Returns a random point near the best predicted one while outcomes are outstanding. The number of
/// such points is limited by the option `outstanding`.
std::optional<Wanted> TrustRegionRun::look_around() {
  if (explored_++ >= options_.outstanding) return std::nullopt;
  return box_.knows_slopes() ? box_.explore(wanted_) : box_.scatter(wanted_);
}

/// Begins the verification. Returns false if nothing is left to gain, if the last verification
/// still holds within noise, if the model computes its derivatives, or if the region is a single
/// point.
bool TrustRegionRun::begin_verification() {
  if (box_.memory[box_.center()].J.size() > 0 || box_.f() >= f_verified_) return false;
  if (box_.f() < nothing_left()) {
    forget_ending(Ending::explained);
    return false;
  }
  verification_.emplace(box_, verification_options());
  if (!verification_->has_axes()) {
    forget_ending(Ending::verified);
    verification_.reset();
  }
  return verification_.has_value();
}

FreshSlopes::Options TrustRegionRun::verification_options() const {
  return {.shortest = tuning_.verification.shortest * options_.step_tolerance,
          .noise_alone = options_.noise_alone,
          .f_least = nothing_left(),
          .f_first = f_first_};
}

/// Returns the next point of the verification, or a restart if no gain above noise is predicted.
std::optional<Wanted> TrustRegionRun::next_to_verify() {
  if (auto point = verification_->next(box_, wanted_)) return point;
  if (!wanted_.empty()) return look_around();
  take_ending();
  return restart();
}

/// Ends the verification; takes over what it found if it ended at the best point.
void TrustRegionRun::take_ending() {
  f_verified_ =
      std::max(box_.f() - verification_->deviation(), tuning_.verification.beyond_noise * box_.f());
  if (box_.center() == box_.best()) {
    ending_ = verification_->ending();
    evidence_ = verification_->evidence();
    slopes_ = verification_->slopes();
    slopes_at_ = box_.center();
    noise_ = verification_->noise();
  }
  verification_.reset();
}

/// Sets an ending that no slopes verified.
void TrustRegionRun::forget_ending(Ending ending) {
  ending_ = ending;
  if (slopes_at_ == box_.best()) return;
  evidence_ = {};
  slopes_at_ = -1;
}

/// Starts a new search in a box if a step of the verification improved the value by a large amount.
void TrustRegionRun::judge_verifying_step(double gain, double promise) {
  verification_->observe_step(gain, radius_.is_bad(gain), promise);
  if (verification_->is_sharp() || !radius_.is_good(gain)) return;
  if (state_ == State::ending && returns_ >= kMostReturns) return;
  if (box_.f() < tuning_.verification.worth_a_search * verification_->f_begin()) {
    returns_ += state_ == State::ending;
    radius_.begin(box_, settled_radius());
    verification_.reset();
    go_on_searching();
  }
}

/// Ends the tests of the end, if they have begun.
void TrustRegionRun::go_on_searching() {
  ending_trials_.reset();
  noise_check_.reset();
  is_shorter_ = false;
  state_ = State::searching;
}

/// Returns the first point of the next search; nullopt if no search follows, or if the run settles
/// before it.
std::optional<Wanted> TrustRegionRun::restart() {
  if (box_.has_center() && (ends_.empty() || ends_.back() != box_.center()))
    ends_.push_back(box_.center());
  if (!restarts_.may_follow(box_, options_)) return std::nullopt;
  const bool is_explained = restarts_.is_explained(best().f, f_first_, options_);
  if (!is_explained && box_.center() == box_.best()) {
    if (restarts_.is_worth_a_look(best().f)) {
      state_ = State::settled;
      return std::nullopt;
    }
    restarts_.find_flat_directions(box_, options_.initial_radius);
  }
  auto first = restarts_.release(box_, options_.initial_radius, nothing_left());
  if (!first && !is_explained) first = restarts_.begin(box_, options_);
  if (first) explored_ = 0;
  return first;
}

/// Continues after a failed start: with the next point along a flat direction or the next restart.
/// If no point has succeeded yet, chooses a new start at a growing distance.
void TrustRegionRun::start_again(const Eigen::VectorXd& failed) {
  if (is_hopeless()) return;
  if (box_.best() >= 0) {
    auto another = restarts_.is_scouting()
                       ? std::optional(restarts_.start(box_, options_.initial_radius))
                       : restart();
    state_ = another ? State::searching : State::over;
    if (another) wanted_.push_back(*another);
    return;
  }
  const int rounds = radius_.failures() / n();  // number of complete rounds of n failures
  const double reach = options_.initial_radius * (1.0 + rounds);
  for (int k = 0; k < tuning_.search.tries; ++k) {
    const Eigen::VectorXd u = box_.drawn_near(failed, reach);
    // The point may have been proposed before and would fail again.
    if (box_.memory.has_failed_near(u)) continue;
    box_.move_to(u);
    wanted_.push_back(box_.at(u, Kind::start));
    return;
  }
}

/// True if many points were evaluated and none has ever succeeded.
bool TrustRegionRun::is_hopeless() const {
  return box_.best() < 0 && radius_.failures() > tuning_.search.hopeless * (n() + 1);
}

void TrustRegionRun::go_on(int restarts_left) {
  if (state_ == State::settled) state_ = State::searching;
  options_.restarts = restarts_.count() + restarts_left;
  fill();
}

void TrustRegionRun::widen(int count) {
  options_.outstanding = count;
  fill();
}

}  // namespace latsch
