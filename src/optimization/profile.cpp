// SPDX-License-Identifier: Apache-2.0
#include "optimization/profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace latsch {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kShortestRung = 0.005;  // of the range
constexpr double kLongestRung = 0.1;
constexpr double kFirstRung = 0.5;  // of the linear interval's half width
constexpr double kLonger = 1.6;     // from rung to rung
// A refit need not be better than this share of the threshold, which shifts the end of an interval
// by half of it; nor of the rise of S, far out where only the shape matters.
constexpr double kTolerance = 0.02;
constexpr int kEvaluationsOfARung = 30;
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

ProfileBranch::ProfileBranch(
    const Linearization& best, int variable, int direction, double half, double threshold)
    : variable_(variable),
      direction_(direction),
      length_(std::clamp(kFirstRung * half, kShortestRung, kLongestRung)),
      threshold_(threshold),
      least_(best.sum_of_squares()),
      free_(all_but(variable, best.u.size())) {
  next_rung(best);
}

std::optional<Eigen::VectorXd> ProfileBranch::wanted() const {
  return refit_ ? refit_->wanted() : std::nullopt;
}

void ProfileBranch::observe(const std::optional<Eigen::VectorXd>& residuals) {
  assert(refit_ && refit_->wanted());
  refit_->observe(residuals);
  if (refit_->wanted()) return;
  if (!refit_->fitted()) {  // the model does not go further out
    refit_.reset();
    return;
  }
  const Linearization reached = refit_->best();
  points_.push_back({reached.u, reached.sum_of_squares()});
  length_ = std::min(kLonger * length_, kLongestRung);
  next_rung(reached);
}

void ProfileBranch::next_rung(const Linearization& from) {
  const double at = from.u[variable_];
  const double bound = direction_ > 0 ? 1.0 : 0.0;
  if (at == bound) {
    refit_.reset();
    return;
  }
  // A last rung of less than half a step joins the one before it.
  const bool last = std::abs(bound - at) < 1.5 * length_;
  refit_.emplace(
      from,
      free_,
      RefitOptions{.tolerance = kTolerance * threshold_, .most_evaluations = kEvaluationsOfARung},
      variable_,
      last ? bound : at + direction_ * length_);
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
