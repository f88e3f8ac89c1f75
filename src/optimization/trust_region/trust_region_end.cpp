// SPDX-License-Identifier: Apache-2.0
// The end of a run of the residual trust region (trust_region_run.h). After the last restart the
// run returns to its best point, and up to four tests follow:
//
//   1. If the verification found noise there, trials over shorter moves show whether the residuals
//      scatter or are curved (noise_check.h). If they do not scatter, slopes are recomputed over
//      such moves.
//   2. If nothing is left of the residuals, fresh slopes show which variables they determine.
//   3. Variables at bounds, and those that seem to have no effect, are moved (ending_trials.h).
//   4. A trial halfway to another end shows whether a ridge lies between both.
//
// A run whose best point is at a minimum, without variables at bounds or without effect and without
// other ends, has no such trial.
#include <algorithm>
#include <cmath>
#include <utility>

#include "optimization/least_squares/open_variables.h"
#include "optimization/trust_region/trust_region_run.h"

namespace latsch {
namespace {

// Change of the residuals over the moves of slopes that replace those of noise that was refuted,
// relative to their norm, and largest number of rounds.
constexpr double kShorter = 0.1;
constexpr int kShorterRounds = 3;

}  // namespace

/// Returns the next trial that tests the end; nullopt if outcomes must arrive first or if none is
/// left.
std::optional<Wanted> TrustRegionRun::next_at_end() {
  if (state_ != State::ending && !begin_end()) return std::nullopt;
  if (verification_) {
    if (auto point = verification_->next(box_, wanted_)) return point;
    if (!wanted_.empty()) return std::nullopt;
    take_ending();
    // Noise that shorter moves do not show is none.
    if (std::exchange(is_shorter_, false) && ending_ == Ending::noise) ending_ = Ending::rough;
  }
  if (begin_noise_check()) {
    if (auto point = noise_check_->next(box_)) return point;
    if (!wanted_.empty()) return std::nullopt;
    noise_checked_ = box_.best();
    if (begin_shorter_slopes()) return next_at_end();
  }
  if (begin_fresh_slopes()) return next_at_end();
  if (begin_ending_trials()) {
    if (auto point = ending_trials_->next(box_)) return point;
    if (!wanted_.empty()) return std::nullopt;
    ending_trials_->report(box_, evidence_);
    ending_trials_.reset();
    tested_ = box_.best();
  }
  return wanted_.empty() ? look_for_ridge() : std::nullopt;
}

/// Returns to the best point. Returns false if there is none.
bool TrustRegionRun::begin_end() {
  if (box_.best() < 0 || box_.is_point()) return false;
  box_.return_to_best();
  state_ = State::ending;
  return true;
}

/// Begins a verification if nothing is left of the residuals and their slopes at the best point are
/// not fresh. Computes which variables are open if they are.
bool TrustRegionRun::begin_fresh_slopes() {
  if (best().J.size() > 0) {
    slopes_ = {best().J, Eigen::MatrixXd::Zero(n(), n())};
    slopes_at_ = box_.best();
  }
  if (best().f > nothing_left()) return false;
  if (slopes_at_ != box_.best()) {
    FreshSlopes::Options options = verification_options();
    options.asks_what_is_open = true;
    options.f_least = nothing_left_at_end();
    verification_.emplace(box_, options);
    if (verification_->has_axes()) return true;
    verification_.reset();
    return false;
  }
  if (best().f > nothing_left_at_end()) return false;
  ending_ = Ending::explained;
  evidence_.open = open_variables(box_.space, box_.c(), slopes_, std::sqrt(box_.f()));
  return false;
}

/// Begins the check of noise that the verification of the best point has found, once for every best
/// point. Returns true if it has begun.
bool TrustRegionRun::begin_noise_check() {
  if (noise_check_) return true;
  if (ending_ != Ending::noise || slopes_at_ != box_.best() || noise_checked_ == box_.best() ||
      noise_.norm == 0.0)
    return false;
  noise_check_.emplace(box_, noise_);
  return true;
}

/// Ends the check of noise. Begins a verification over shorter moves if it has refuted the noise:
/// the residuals are curved then, or they ripple.
bool TrustRegionRun::begin_shorter_slopes() {
  const bool is_refuted = noise_check_->is_refuted();
  noise_check_.reset();
  if (!is_refuted) return false;
  FreshSlopes::Options options = verification_options();
  options.change = kShorter;
  options.most_rounds = kShorterRounds;
  verification_.emplace(box_, options);
  is_shorter_ = true;
  return true;
}

/// Begins the trials around the point at which slopes are known, once for every best point.
/// Returns true if they have begun.
bool TrustRegionRun::begin_ending_trials() {
  if (ending_trials_) return true;
  const bool knows_slopes = ending_ == Ending::verified || ending_ == Ending::noise ||
                            ending_ == Ending::explained || ending_ == Ending::rough ||
                            ending_ == Ending::known;
  if (!knows_slopes || slopes_at_ < 0 || tested_ == box_.best()) return false;
  ending_trials_.emplace(
      box_, slopes_at_, slopes_, options_.step_tolerance, ending_ == Ending::explained);
  return true;
}

void TrustRegionRun::observe_at_end(const Wanted& tried, const std::optional<Eigen::VectorXd>& r) {
  if (ending_trials_) ending_trials_->observe(tried.u, r);
  if (noise_check_) noise_check_->observe(tried.u, r);
  if (other_end_ < 0 || tried.u != between_) return;
  if (r) judge_ridge(*r);
  other_end_ = -1;
}

double TrustRegionRun::nothing_left_at_end() const {
  if (options_.square_of_data == 0.0) return nothing_left();
  return std::min(nothing_left(), tuning_.search.nothing_left_of_data * options_.square_of_data);
}

EndingEvidence TrustRegionRun::evidence() const {
  EndingEvidence all = evidence_;
  if (box_.best() < 0) return all;
  all.left = best().f / f_first_;
  all.most_left = tuning_.search.nothing_left;
  if (options_.square_of_data > 0.0) {
    all.left_of_data = std::sqrt(best().f / options_.square_of_data);
    all.most_left_of_data = std::sqrt(tuning_.search.nothing_left_of_data);
  }
  if (box_.is_down_to(options_.noise_alone)) all.noise_alone = best().f / options_.noise_alone;
  return all;
}

/// Returns a trial halfway between the best point and another end of this run, which shows whether
/// a ridge separates them; nullopt if no search has ended elsewhere.
std::optional<Wanted> TrustRegionRun::look_for_ridge() {
  constexpr double kApart = 10.0;  // least distance of two ends, in step tolerances
  if (compared_ == box_.best() || best().f == 0.0) return std::nullopt;
  compared_ = box_.best();
  const auto distance = [&](int end) {
    const Eigen::VectorXd move = box_.memory[end].u - best().u;
    return move.cwiseQuotient(box_.widths()).lpNorm<Eigen::Infinity>();
  };
  for (const int end : ends_) {
    if (end == box_.best() || distance(end) < kApart * options_.step_tolerance) continue;
    if (other_end_ < 0 || box_.memory[end].f < box_.memory[other_end_].f) other_end_ = end;
  }
  if (other_end_ < 0) return std::nullopt;
  const Wanted between = box_.at(0.5 * (box_.memory[other_end_].u + best().u), Wanted::Kind::probe);
  between_ = between.u;
  return between;
}

/// Compares the point between two ends with both.
void TrustRegionRun::judge_ridge(const Eigen::VectorXd& r) {
  constexpr double kThresholds = 3.0;  // height of a ridge that counts
  constexpr double kInterval = 4.0;    // square of the standard deviations of a 95 % interval
  const ResidualSample& other = box_.memory[other_end_];
  const double free = std::max<double>(1.0, static_cast<double>(r.size() - n()));
  const double higher = std::max(other.f, best().f);
  const double least = kThresholds * kInterval * higher / free;
  const double ridge = r.squaredNorm() - higher;
  if (ridge < least) return;
  evidence_.other =
      EndingEvidence::OtherMinimum{.value = other.f / best().f,
                                   .ridge = ridge / best().f,
                                   .least = least / best().f,
                                   .distance = (other.u - best().u).lpNorm<Eigen::Infinity>()};
}

}  // namespace latsch
