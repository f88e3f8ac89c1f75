// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "optimization/problem/infinity.h"

namespace latsch {
namespace {

constexpr double kShortestRung = 0.005;  // shortest step of a profile, as a share of the range
constexpr double kLongestRung = 0.1;
// First step, as a share of half the width of the linear interval.
constexpr double kFirstRung = 0.5;
constexpr double kLonger = 1.6;  // factor by which each step is longer than the one before
// Tolerance of a refit, as a share of the threshold; an end of the interval shifts by half of this
// share. Far out, where only the shape of the profile matters, it is a share of the growth of S.
constexpr double kProfileTolerance = 0.02;
// Largest number of evaluations of a refit, to which two for each variable are added.
constexpr int kEvaluationsOfARung = 30;
// Difference of S between two steps of a profile, in thresholds, above which the root of S does not
// count as linear between them.
constexpr double kLeap = 4.0;
constexpr int kHalvings = 3;
constexpr int kStepsToTheEdge = 5;  // number of halvings toward a value at which the model fails
// Number of steps after which all derivatives have been recomputed.
constexpr size_t kRungsToRefresh = 4;
// Largest number of steps of a branch that are repeated from the outer side.
constexpr int kMostReturns = 12;
// Distance, in ranges, of the point outside of the region whose nearest point of the region is used
// as its furthest point; the error of that point is at most 1 / kFarOut.
constexpr double kFarOut = 1e3;
// Fall of S along the profile that proves another minimum, as a share of the height of S above its
// minimum. Refits that ended early cause smaller falls.
constexpr double kFall = 0.1;

/// Returns the indices of all variables except one: of the n variables, or of `some` if it is not
/// empty.
std::vector<int> all_but(int variable, Eigen::Index n, const std::vector<int>& some) {
  std::vector<int> free = some;
  for (int i = 0; some.empty() && i < n; ++i) free.push_back(i);
  std::erase(free, variable);
  return free;
}

/// Returns the furthest value of a variable inside a region: a bound, or the value at which
/// constraints leave no room for the others. It is found as the point of the region that is nearest
/// to a point far outside in this direction.
double last_value(const FeasibleRegion& region,
                  const Eigen::VectorXd& u,
                  int variable,
                  int direction) {
  if (region.is_cube()) return direction > 0 ? 1.0 : 0.0;
  Eigen::VectorXd far = u;
  far[variable] += direction * kFarOut;
  const double last = region.nearest(far)[variable];
  return direction > 0 ? std::max(last, u[variable]) : std::min(last, u[variable]);
}

/// Returns the variable's value where S first exceeds the threshold, outward from `start`, by
/// linear interpolation of the root of S.
double crossing(const TargetProfile& p, int start, int direction) {
  const auto rise = [&](int k) { return std::max(0.0, p.points[k].S - p.least); };
  const auto at = [&](int k) { return p.points[k].u[p.variable]; };
  const int end = direction > 0 ? static_cast<int>(p.points.size()) : -1;
  for (int k = start + direction; k != end; k += direction) {
    if (!(rise(k) > p.threshold)) continue;
    const double a = std::sqrt(rise(k - direction)), b = std::sqrt(rise(k));
    const double share = (std::sqrt(p.threshold) - a) / (b - a);
    return at(k - direction) + share * (at(k) - at(k - direction));
  }
  return direction * kInfinity;
}

/// Finds further minima of S on one side of the start: values at which S falls again after it has
/// risen.
void find_minima(TargetProfile& p, int start, int direction) {
  const int end = direction > 0 ? static_cast<int>(p.points.size()) : -1;
  double barrier = p.points[start].S;
  int lowest = -1;  // index of the lowest point beyond the rise
  for (int k = start + direction; k != end; k += direction) {
    const double S = p.points[k].S;
    if (lowest < 0 && S >= barrier) {
      if (p.points[k].converged) barrier = S;
      continue;
    }
    if (lowest < 0 || S < p.points[lowest].S) lowest = k;
    const double fall = barrier - p.points[lowest].S;
    const bool deep = fall > std::max(p.threshold, kFall * (barrier - p.least));
    const bool rising = S > p.points[lowest].S;
    const bool last = k + direction == end;
    if (deep && (last || S - p.points[lowest].S > kFall * fall)) {
      p.other_minima.push_back(lowest);
      barrier = S;
      lowest = -1;
    } else if (!deep && rising && S >= barrier) {
      barrier = S;
      lowest = -1;
    }
  }
}

}  // namespace

ProfileBranch::ProfileBranch(const Linearization& best,
                             int variable,
                             int direction,
                             double half,
                             double threshold,
                             const ProfileSettings& settings)
    : variable_(variable),
      direction_(direction),
      length_(std::clamp(kFirstRung * half, kShortestRung, kLongestRung)),
      threshold_(threshold),
      least_(best.sum_of_squares()),
      settings_(settings),
      end_(last_value(settings.region, best.u, variable, direction)),
      free_(all_but(variable, best.u.size(), settings.free)),
      last_(best) {
  next_rung(best);
}

std::optional<Eigen::VectorXd> ProfileBranch::wanted() const {
  return refit_ ? refit_->wanted() : std::nullopt;
}

void ProfileBranch::observe(const std::optional<Evaluated>& evaluated) {
  assert(refit_ && refit_->wanted());
  refit_->observe(evaluated);
  if (refit_->wanted()) return;
  const bool fitted = refit_->fitted(), converged = refit_->converged();
  const Linearization reached = refit_->best();
  refit_.reset();
  if (return_) {
    return_observed(fitted && converged ? std::optional(reached) : std::nullopt);
    return;
  }
  if (verifying_) {
    verifying_ = false;
  } else if (fitted && verifies(reached)) {
    return;
  }
  int place = -1;
  if (fitted) place = insert(reached, converged);
  if (bracket_) {
    if (fitted && within(reached)) {
      bracket_->inner = reached;
    } else if (fitted) {
      bracket_->upper = reached.u[variable_];
    }
    halve();
  } else if (!fitted) {
    rung_failed(to_);
  } else if (!returns_from(reached, place - 1)) {
    rung_reached(reached);
  }
}

void ProfileBranch::rung_reached(const Linearization& reached) {
  if (leaps(last_, reached)) {
    bracket_ = {last_, reached, reached.u[variable_]};
    last_ = reached;
    halve();
    return;
  }
  last_ = reached;
  next_rung(reached);
}

/// Begins to refit the first point above the threshold with derivatives computed anew at this
/// point. Returns false for all other points of the profile.
bool ProfileBranch::verifies(const Linearization& reached) {
  if (bracket_ || !within(last_) || within(reached) || free_.empty()) return false;
  const BroydenFitOptions options = rung_options(reached.sum_of_squares(), free_);
  refit_.emplace(reached, free_, options);
  verifying_ = refit_->wanted().has_value();
  if (!verifying_) refit_.reset();
  return verifying_;
}

void ProfileBranch::rung_failed(double at) {
  failed_at_ = at;
  if (within(last_)) next_rung(last_);
}

/// Begins to refit the point at index `place` from the outer side, if S there is higher than at
/// `reached`, the next point outward. Returns false if it is not.
bool ProfileBranch::returns_from(const Linearization& reached, int place) {
  const double S = reached.sum_of_squares();
  if (place < 0 || returns_ >= kMostReturns || points_[place].S <= S + tolerance(S)) return false;
  ++returns_;
  climb(reached, points_[place].u[variable_]);
  if (!refit_->wanted()) {
    refit_.reset();
    return false;
  }
  if (!return_) return_ = {reached, place};
  return_->place = place;
  return true;
}

void ProfileBranch::return_observed(const std::optional<Linearization>& reached) {
  const Linearization outer = return_->outer;
  ProfilePoint& rung = points_[return_->place];
  if (reached && reached->sum_of_squares() < rung.S) {
    rung = {reached->u, reached->sum_of_squares(), true};
    if (returns_from(*reached, return_->place - 1)) return;
  }
  return_.reset();
  rung_reached(outer);
}

bool ProfileBranch::leaps(const Linearization& from, const Linearization& to) const {
  return within(from) && to.sum_of_squares() - least_ > kLeap * threshold_;
}

/// Inserts a point into the profile and returns its index.
int ProfileBranch::insert(const Linearization& reached, bool converged) {
  const auto further = [&](const ProfilePoint& point) {
    return direction_ * (point.u[variable_] - reached.u[variable_]) > 0.0;
  };
  const auto at = points_.insert(std::find_if(points_.begin(), points_.end(), further),
                                 {reached.u, reached.sum_of_squares(), converged});
  return static_cast<int>(at - points_.begin());
}

/// Adds another point halfway inside the bracket, or continues outward if the bracket is narrow
/// enough.
void ProfileBranch::halve() {
  const double inner = bracket_->inner.u[variable_];
  if (bracket_->halvings++ < kHalvings && std::abs(bracket_->upper - inner) > kShortestRung) {
    climb(bracket_->inner, 0.5 * (inner + bracket_->upper));
    return;
  }
  const Linearization outer = bracket_->outer;
  bracket_.reset();
  next_rung(outer);
}

void ProfileBranch::next_rung(const Linearization& from) {
  const double at = from.u[variable_];
  // The model begins to fail at a value between `at` and failed_at_.
  if (failed_at_) {
    if (!within(from) || steps_to_the_edge_++ >= kStepsToTheEdge) return;
    if (std::abs(*failed_at_ - at) > kShortestRung) climb(from, 0.5 * (at + *failed_at_));
    return;
  }
  if (direction_ * (end_ - at) <= 0.0) return;
  if (!points_.empty()) length_ = std::min(kLonger * length_, kLongestRung);
  climb(from, rung_after(at, length_));
}

/// Returns the next value of the variable. If less than half a step would remain to the end, the
/// step is extended to the end.
double ProfileBranch::rung_after(double at, double length) const {
  const bool last = std::abs(end_ - at) < 1.5 * length;
  return last ? end_ : at + direction_ * length;
}

int ProfileBranch::rungs_left() const {
  if (!refit_) return 0;
  if (failed_at_) return 1;
  int rungs = 1;  // begins at 1 for the step being refitted
  double at = bracket_ || return_ ? last_.u[variable_] : to_, length = length_;
  while (direction_ * (end_ - at) > 0.0) {
    length = std::min(kLonger * length, kLongestRung);
    at = rung_after(at, length);
    ++rungs;
  }
  return rungs;
}

double ProfileBranch::tolerance(double S) const {
  return kProfileTolerance * std::max(threshold_, S - least_);
}

/// Returns the free variables whose derivatives are recomputed at this step, different ones at each
/// step.
std::vector<int> ProfileBranch::next_columns() {
  std::vector<int> columns;
  const size_t count = (free_.size() + kRungsToRefresh - 1) / kRungsToRefresh;
  for (size_t k = 0; k < count; ++k) columns.push_back(free_[next_column_++ % free_.size()]);
  return columns;
}

BroydenFitOptions ProfileBranch::rung_options(double S, const std::vector<int>& refresh) const {
  return {.tolerance = tolerance(S),
          .most_evaluations = kEvaluationsOfARung + 2 * static_cast<int>(free_.size()),
          .refresh = refresh,
          .differences = settings_.differences,
          .region = settings_.region};
}

void ProfileBranch::climb(const Linearization& from, double to) {
  to_ = to;
  const BroydenFitOptions options = rung_options(from.sum_of_squares(), next_columns());
  refit_.emplace(from, free_, options, variable_, to);
}

TargetProfile judge(const Linearization& best,
                    int variable,
                    const ProfileBranch& down,
                    const ProfileBranch& up,
                    double threshold) {
  TargetProfile p;
  p.variable = variable;
  p.threshold = threshold;
  p.points.assign(down.points().rbegin(), down.points().rend());
  p.points.push_back({best.u, best.sum_of_squares()});
  p.points.insert(p.points.end(), up.points().begin(), up.points().end());
  const auto less = [](const ProfilePoint& a, const ProfilePoint& b) { return a.S < b.S; };
  const auto start = std::min_element(p.points.begin(), p.points.end(), less) - p.points.begin();
  p.least = p.points[start].S;
  p.interval = {crossing(p, start, -1), crossing(p, start, +1)};
  find_minima(p, start, -1);
  find_minima(p, start, +1);
  if (down.failed_at() && !std::isfinite(p.interval.lower)) {
    p.lower_end = p.points.front().u[variable];
  }
  if (up.failed_at() && !std::isfinite(p.interval.upper)) p.upper_end = p.points.back().u[variable];
  const int sides = std::isfinite(p.interval.lower) + std::isfinite(p.interval.upper);
  p.verdict = !p.other_minima.empty()      ? Verdict::several_minima
              : p.lower_end || p.upper_end ? Verdict::not_evaluable
              : sides == 2                 ? Verdict::identifiable
              : sides == 1                 ? Verdict::one_sided
                                           : Verdict::flat;
  return p;
}

int TargetProfile::unconverged() const {
  return static_cast<int>(
      std::count_if(points.begin(), points.end(), [](const auto& at) { return !at.converged; }));
}

std::string name(Verdict verdict) {
  switch (verdict) {
    case Verdict::identifiable:
      return "identifiable";
    case Verdict::one_sided:
      return "one-sided";
    case Verdict::flat:
      return "flat";
    case Verdict::several_minima:
      return "several minima";
    case Verdict::not_evaluable:
      return "not evaluable beyond";
  }
  assert(false);
  return "";
}

std::string in_words(const TargetProfile& profile) {
  std::string words = name(profile.verdict);
  if (profile.verdict == Verdict::flat)
    words += ": any value between the bounds fits as well, within the noise";
  if (profile.verdict == Verdict::several_minima) words += ": a search can end in the wrong one";
  if (profile.verdict == Verdict::one_sided) {
    words += std::isfinite(profile.interval.upper) ? ": the data give only an upper limit"
                                                   : ": the data give only a lower limit";
  }
  if (profile.verdict == Verdict::not_evaluable) {
    words += profile.lower_end && profile.upper_end ? " both ends: the model fails there"
             : profile.lower_end                    ? " the lower end: the model fails there"
                                                    : " the upper end: the model fails there";
  }
  if (const int count = profile.unconverged()) {
    words += fmt::format("; {} of {} refits did not converge", count, profile.points.size());
  }
  return words;
}

}  // namespace latsch
