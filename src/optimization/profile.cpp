// SPDX-License-Identifier: Apache-2.0
#include "optimization/profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "optimization/infinity.h"

namespace latsch {
namespace {

constexpr double kShortestRung = 0.005;  // of the range
constexpr double kLongestRung = 0.1;
constexpr double kFirstRung = 0.5;  // of the linear interval's half width
constexpr double kLonger = 1.6;     // from rung to rung
// A refit need not be better than this share of the threshold, which shifts the end of an interval
// by half of it; nor of the rise of S, far out where only the shape matters.
constexpr double kProfileTolerance = 0.02;
constexpr int kEvaluationsOfARung = 30;
constexpr double kLeap = 4.0;  // thresholds: between two rungs the root of S is no straight line
constexpr int kHalvings = 3;
constexpr double kFarOut = 1e3;  // ranges; the furthest point is met to its inverse
// What the profile has to fall again to count as another minimum, of its height there: refits that
// ended early leave ripples.
constexpr double kFall = 0.1;

std::vector<int> all_but(int variable, Eigen::Index n) {
  std::vector<int> free;
  for (int i = 0; i < n; ++i) {
    if (i != variable) free.push_back(i);
  }
  return free;
}

/// The furthest value of a variable inside a region: a bound, or where constraints leave none of
/// the others room. Of the points inside the nearest to one far out is the furthest that way.
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

/// The variable's value where S first exceeds the threshold, outward from `start`; the root of S is
/// nearly linear there.
double crossing(const Profile& p, int start, int direction) {
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

/// Places where S falls again behind a rise, on one side of the start.
void find_minima(Profile& p, int start, int direction) {
  const int end = direction > 0 ? static_cast<int>(p.points.size()) : -1;
  double barrier = p.points[start].S;
  int lowest = -1;  // behind the barrier
  for (int k = start + direction; k != end; k += direction) {
    const double S = p.points[k].S;
    if (lowest < 0 && S >= barrier) {
      barrier = S;
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
                             const FeasibleRegion& region)
    : variable_(variable),
      direction_(direction),
      length_(std::clamp(kFirstRung * half, kShortestRung, kLongestRung)),
      threshold_(threshold),
      least_(best.sum_of_squares()),
      region_(region),
      end_(last_value(region, best.u, variable, direction)),
      free_(all_but(variable, best.u.size())),
      last_(best) {
  next_rung(best);
}

std::optional<Eigen::VectorXd> ProfileBranch::wanted() const {
  return refit_ ? refit_->wanted() : std::nullopt;
}

void ProfileBranch::observe(const std::optional<Eigen::VectorXd>& residuals) {
  assert(refit_ && refit_->wanted());
  refit_->observe(residuals);
  if (refit_->wanted()) return;
  const bool fitted = refit_->fitted();
  const Linearization reached = refit_->best();
  refit_.reset();
  if (fitted) insert(reached);
  if (bracket_) {
    if (fitted && within(reached)) {
      bracket_->inner = reached;
    } else if (fitted) {
      bracket_->upper = reached.u[variable_];
    }
    halve();
    return;
  }
  if (!fitted) return;  // the model does not go further out
  if (leaps(last_, reached)) {
    bracket_ = {last_, reached, reached.u[variable_]};
    last_ = reached;
    halve();
    return;
  }
  last_ = reached;
  next_rung(reached);
}

bool ProfileBranch::leaps(const Linearization& from, const Linearization& to) const {
  return within(from) && to.sum_of_squares() - least_ > kLeap * threshold_;
}

void ProfileBranch::insert(const Linearization& reached) {
  const auto further = [&](const ProfilePoint& point) {
    return direction_ * (point.u[variable_] - reached.u[variable_]) > 0.0;
  };
  points_.insert(std::find_if(points_.begin(), points_.end(), further),
                 {reached.u, reached.sum_of_squares()});
}

/// Another rung inside the bracket, or on with the ladder.
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
  if (direction_ * (end_ - at) <= 0.0) return;
  if (!points_.empty()) length_ = std::min(kLonger * length_, kLongestRung);
  // A last rung of less than half a step joins the one before it.
  const bool last = std::abs(end_ - at) < 1.5 * length_;
  climb(from, last ? end_ : at + direction_ * length_);
}

void ProfileBranch::climb(const Linearization& from, double to) {
  const double rise = from.sum_of_squares() - least_;
  refit_.emplace(from,
                 free_,
                 RefitOptions{.tolerance = kProfileTolerance * std::max(threshold_, rise),
                              .most_evaluations = kEvaluationsOfARung,
                              .region = region_},
                 variable_,
                 to);
}

Profile judge(const Linearization& best,
              int variable,
              const ProfileBranch& down,
              const ProfileBranch& up,
              double threshold) {
  Profile p;
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
  const int sides = std::isfinite(p.interval.lower) + std::isfinite(p.interval.upper);
  p.verdict = !p.other_minima.empty() ? Verdict::several_minima
              : sides == 2            ? Verdict::identifiable
              : sides == 1            ? Verdict::one_sided
                                      : Verdict::flat;
  return p;
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
  }
  assert(false);
  return "";
}

std::string in_words(const Profile& profile) {
  std::string words = name(profile.verdict);
  if (profile.verdict == Verdict::flat) words += ": any value between the bounds fits as well";
  if (profile.verdict == Verdict::several_minima) words += ": a search can end in the wrong one";
  if (profile.verdict == Verdict::one_sided) {
    words += std::isfinite(profile.interval.upper) ? ": the data give only an upper limit"
                                                   : ": the data give only a lower limit";
  }
  return words;
}

}  // namespace latsch
