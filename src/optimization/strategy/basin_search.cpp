// SPDX-License-Identifier: Apache-2.0
#include "optimization/strategy/basin_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/random.h"
#include "optimization/design/sobol.h"
#include "optimization/problem/infinity.h"
#include "optimization/problem/pending_points.h"
#include "optimization/problem/point_vector.h"

namespace latsch {
namespace {

constexpr int kFirst = 3, kLater = 2, kProbe = 3, kDescent = 10,
              kTold = 8;                         // in units of n + 1 trials
constexpr int kPatience = 3, kMostRounds = 200;  // rounds
constexpr int kMostCrossings = 2;  // trials on the way to a minimum, for each candidate
constexpr double kWorthIt = 1.5;   // factor of the best sum of squares of a probe
constexpr double kBest = 0.25;     // share of the points that may start a search
constexpr double kFewUnseen = 0.5;
// Errors with which a minimum explains a point that is spread over the space, and the best point of
// a search: a search that comes near another minimum must not be ended by a rough model.
constexpr double kErrorOfPoint = 0.5, kErrorOfSearch = 0.2;

/// Returns the first points of a low-discrepancy sequence, or random ones if there are more
/// variables than it has.
SamplingPlan spread_over(const DesignSpace& space, int count, std::uint64_t seed) {
  if (space.size() <= kMostSobolVariables) return sobol(space, count, seed);
  SamplingPlan plan;
  for (int k = 0; k < count; ++k) {
    RandomStream random(seed, static_cast<std::uint64_t>(k));
    std::vector<double> u(static_cast<std::size_t>(space.size()));
    for (double& one : u) one = random.uniform();
    plan.points.push_back(space.from_unit(u));
  }
  return plan;
}

double square(const Score& score) { return to_vector(score.residuals).squaredNorm(); }

}  // namespace

double BasinSearch::Descent::sum_of_squares() const {
  return best_score ? square(*best_score) : kInfinity;
}

BasinSearch::BasinSearch(const DesignSpace& space,
                         const BasinSearchOptions& options,
                         MakeOptimizer make_optimizer)
    : space_(space),
      options_(options),
      make_optimizer_(std::move(make_optimizer)),
      best_probe_(kInfinity) {
  if (options_.budget < 1) throw InputError("basins: the budget is below 1");
  spread_points();
}

/// Adds the points of the next round that fulfill the constraints.
void BasinSearch::spread_points() {
  const int of_sequence = (kFirst + rounds_ * kLater) * (space_.size() + 1);
  const int known = rounds_ == 0 ? 0 : of_sequence - kLater * (space_.size() + 1);
  ++rounds_;
  has_resumed_ = false;
  const auto add = [&](const DesignPoint& point) {
    points_.push_back({point, to_vector(space_.to_unit(point))});
  };
  if (points_.empty()) add(space_.initial());
  const SamplingPlan plan = spread_over(space_, of_sequence, options_.seed);
  for (std::size_t i = static_cast<std::size_t>(known); i < plan.points.size(); ++i)
    if (std::ssize(points_) < of_sequence && space_.contains(plan.points[i])) add(plan.points[i]);
}

std::vector<DesignPoint> BasinSearch::propose(int count) const {
  Plan plan(count);
  if (converged()) return {};
  if (descent_) return descent_->optimizer->propose(count);
  if (crossing_) {
    plan.add(crossing_->point);
    return plan.points();
  }
  for (std::size_t i = evaluated_; i < points_.size(); ++i)
    if (!outcomes_.contains(points_[i].point.bits())) plan.add(points_[i].point);
  return plan.points();
}

void BasinSearch::observe(const DesignPoint& point, const Result<Score>& outcome) {
  if (outcome && outcome->residuals.empty())
    throw InputError("basins: the score has no residuals, expected a sum over residuals");
  if (point == awaited()) ++trials_;
  const bool is_new = outcomes_.insert_or_assign(point.bits(), outcome).second;
  if (is_new && outcome && space_.contains(point)) {
    known_points_.push_back(point);
    known_.push_back({to_vector(space_.to_unit(point)), to_vector(outcome->residuals)});
  }
  while (!converged() && use_known_outcome()) continue;
}

/// Returns the point that the method asks for next.
std::optional<DesignPoint> BasinSearch::awaited() const {
  if (converged()) return std::nullopt;
  if (descent_) return descent_->optimizer->propose(1).front();
  if (crossing_) return crossing_->point;
  return points_[evaluated_].point;
}

/// Goes on by one step. Returns false if the step needs an outcome that is not known.
bool BasinSearch::use_known_outcome() {
  if (is_spent()) {
    if (descent_ && descent_->best_score && !descent_->is_probe) end_descent(add_basin(*descent_));
    end(fmt::format("because its budget of {} trials is spent", trials_), "out of budget");
    return true;
  }
  if (descent_) {
    if (!outcomes_.contains(descent_->optimizer->propose(1).front().bits())) return false;
    descend();
  } else if (crossing_) {
    if (!outcomes_.contains(crossing_->point.bits())) return false;
    cross();
  } else if (evaluated_ < points_.size()) {
    if (!take_outcome(points_[evaluated_])) return false;
    if (++evaluated_ == points_.size()) choose_candidates();
  } else if (!begin_next()) {
    end_round();
  }
  return true;
}

bool BasinSearch::take_outcome(Spread& point) const {
  const auto found = outcomes_.find(point.point.bits());
  if (found == outcomes_.end()) return false;
  if (found->second) point.score = *found->second;
  return true;
}

/// Returns the distance within which a better point keeps another from starting a search.
double BasinSearch::radius() const {
  const double N = static_cast<double>(std::count_if(
      points_.begin(), points_.end(), [](const Spread& point) { return point.score.has_value(); }));
  return N > 1.0 ? 0.5 * std::pow(std::log(N) / N, 1.0 / space_.size()) : 1.0;
}

void BasinSearch::choose_candidates() {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (points_[i].score) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return square(*points_[a].score) < square(*points_[b].score);
  });
  order.resize(static_cast<std::size_t>(std::ceil(kBest * static_cast<double>(order.size()))));
  candidates_.clear();
  const double near = radius();
  for (const std::size_t i : order) {
    Spread& point = points_[i];
    link(point, near);
    if (!point.has_searched && point.basin < 0 && point.linked_to < 0) candidates_.push_back(i);
  }
  std::reverse(candidates_.begin(), candidates_.end());
}

/// Links a point to the nearest better one within the radius, in the largest coordinate.
void BasinSearch::link(Spread& point, double radius) const {
  point.linked_to = -1;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (!points_[k].score || square(*points_[k].score) >= square(*point.score)) continue;
    const double distance = (points_[k].u - point.u).lpNorm<Eigen::Infinity>();
    if (distance >= radius) continue;
    radius = distance;
    point.linked_to = static_cast<int>(k);
  }
}

bool BasinSearch::is_explained(std::size_t basin,
                               const Eigen::VectorXd& u,
                               const Score& score,
                               double largest_error) const {
  return is_explained_by(minima_[basin], {u, to_vector(score.residuals)}, known_, largest_error);
}

int BasinSearch::explaining_basin(const Eigen::VectorXd& u,
                                  const Score& score,
                                  double largest_error) const {
  for (std::size_t k = 0; k < minima_.size(); ++k)
    if (is_explained(k, u, score, largest_error)) return static_cast<int>(k);
  return -1;
}

/// Begins a trial on the way, or the search, of the next candidate that no minimum explains.
/// Returns false if there is none.
bool BasinSearch::begin_next() {
  while (!candidates_.empty()) {
    const std::size_t i = candidates_.back();
    candidates_.pop_back();
    points_[i].basin = explaining_basin(points_[i].u, *points_[i].score, kErrorOfPoint);
    if (points_[i].basin >= 0) continue;
    if (!begin_crossing(i, 1)) begin_descent(i);
    return true;
  }
  return false;
}

bool BasinSearch::begin_crossing(std::size_t i, int tries) {
  if (minima_.empty() || tries > kMostCrossings) return false;
  const Eigen::VectorXd& u = points_[i].u;
  const auto nearest =
      std::min_element(minima_.begin(), minima_.end(), [&](const auto& a, const auto& b) {
        return (a.u - u).norm() < (b.u - u).norm();
      });
  const double share = 1.0 - std::pow(0.5, tries);  // share of the way from the minimum
  const Eigen::VectorXd at = nearest->u + share * (u - nearest->u);
  const DesignPoint point = space_.from_unit({at.begin(), at.end()});
  if (!space_.contains(point)) return false;
  crossing_ = Crossing{i, static_cast<std::size_t>(nearest - minima_.begin()), tries, point};
  return true;
}

/// Uses the trial on the way: the candidate belongs to the minimum if the minimum explains both.
void BasinSearch::cross() {
  const Crossing crossing = *std::exchange(crossing_, std::nullopt);
  const Result<Score>& outcome = outcomes_.at(crossing.point.bits());
  Spread& from = points_[crossing.from];
  if (outcome && square(*outcome) < square(*from.score) &&
      is_explained(
          crossing.basin, to_vector(space_.to_unit(crossing.point)), *outcome, kErrorOfPoint)) {
    if (is_explained(crossing.basin, from.u, *from.score, kErrorOfPoint)) {
      from.basin = static_cast<int>(crossing.basin);
      return;
    }
    if (begin_crossing(crossing.from, crossing.tries + 1)) return;
  }
  begin_descent(crossing.from);
}

void BasinSearch::begin_descent(std::size_t i) {
  Spread& from = points_[i];
  from.has_searched = true;
  descent_ = Descent();
  descent_->from = i;
  descent_->limit = kProbe * (space_.size() + 1);
  descent_->optimizer = make_optimizer_(space_.starting_at(from.point));
  tell_worse(*descent_->optimizer, from);
}

/// Passes to a search the known trials nearest to its start that are worse than the start. If it
/// knew a better one, it would continue from there.
void BasinSearch::tell_worse(Optimizer& optimizer, const Spread& from) const {
  const double S = square(*from.score);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < known_.size(); ++k)
    if (known_[k].r.squaredNorm() > S) order.emplace_back((known_[k].u - from.u).norm(), k);
  std::sort(order.begin(), order.end());
  order.resize(std::min(std::ssize(order), std::ptrdiff_t{kTold} * (space_.size() + 1)));
  std::reverse(order.begin(), order.end());  // the nearest one comes last
  for (const auto& [distance, k] : order)
    optimizer.observe(known_points_[k], outcomes_.at(known_points_[k].bits()));
}

/// Passes one outcome to the search, and ends it or lets it go on.
void BasinSearch::descend() {
  Descent& descent = *descent_;
  const DesignPoint point = descent.optimizer->propose(1).front();
  const Result<Score>& outcome = outcomes_.at(point.bits());
  descent.optimizer->observe(point, outcome);
  ++descent.trials;
  if (outcome && square(*outcome) < descent.sum_of_squares()) {
    descent.best = point;
    descent.best_score = *outcome;
  }
  const bool has_ended = descent.optimizer->converged();
  const bool may_be_explained = has_ended || descent.trials % (space_.size() + 1) == 0;
  if (may_be_explained && end_if_explained()) return;
  if (!has_ended && descent.trials < descent.limit) return;
  if (descent.is_probe) return end_probe(descent);
  const double S = descent.sum_of_squares();
  const bool is_lowest = std::all_of(
      minima_.begin(), minima_.end(), [&](const auto& one) { return S < one.r.squaredNorm(); });
  if (!has_ended && is_lowest)
    descent.limit += kDescent * (space_.size() + 1);
  else
    end_descent(descent.best_score ? add_basin(descent) : -1);
}

/// Lets a search go on after its probe if it is worth it; otherwise lets it wait.
void BasinSearch::end_probe(Descent& descent) {
  const double S = descent.sum_of_squares();
  best_probe_ = std::min(best_probe_, S);
  descent.is_probe = false;
  if (!std::isfinite(S)) return end_descent(-1);
  if (S > kWorthIt * best_probe_) {
    waiting_.push_back(std::move(descent));
    descent_.reset();
  } else if (descent.optimizer->converged()) {
    end_descent(add_basin(descent));
  } else {
    descent.limit += kDescent * (space_.size() + 1);
  }
}

/// Ends the search if a known minimum explains its best point.
bool BasinSearch::end_if_explained() {
  if (!descent_->best_score) return false;
  const int basin = explaining_basin(
      to_vector(space_.to_unit(*descent_->best)), *descent_->best_score, kErrorOfSearch);
  if (basin >= 0) end_descent(basin);
  return basin >= 0;
}

void BasinSearch::end_descent(int basin) {
  points_[descent_->from].basin = basin;
  descent_.reset();
}

int BasinSearch::add_basin(const Descent& descent) {
  basins_.push_back({*descent.best, descent.best_score->value, 0, descent.optimizer->converged()});
  minima_.push_back(
      {to_vector(space_.to_unit(*descent.best)), to_vector(descent.best_score->residuals)});
  return static_cast<int>(basins_.size()) - 1;
}

/// Resumes the best search that waits and that no minimum explains. Returns false if there is none.
bool BasinSearch::resume_best_waiting() {
  while (!waiting_.empty()) {
    const auto best =
        std::min_element(waiting_.begin(), waiting_.end(), [](const Descent& a, const Descent& b) {
          return a.sum_of_squares() < b.sum_of_squares();
        });
    descent_.emplace(std::move(*best));
    waiting_.erase(best);
    descent_->limit = descent_->trials + kDescent * (space_.size() + 1);
    if (end_if_explained()) continue;
    if (!descent_->optimizer->converged()) return true;
    end_descent(add_basin(*descent_));
  }
  return false;
}

/// Ends the method if few basins are expected unseen; otherwise goes on.
void BasinSearch::end_round() {
  count_hits();
  const bool is_enough = expected_unseen() < kFewUnseen;
  if ((is_enough || (rounds_ >= kPatience && !has_resumed_)) && resume_best_waiting()) {
    has_resumed_ = true;
    return;
  }
  count_hits();
  if (expected_unseen() < kFewUnseen)
    end(fmt::format("because {:.2g} further basins are expected, judging by {}",
                    expected_unseen(),
                    evidence()),
        "few further minima are expected");
  else if (rounds_ >= kMostRounds)
    end("after its largest number of rounds", "after its largest number of rounds");
  else
    spread_points();
}

/// Returns what the expectation rests on: "9 points, 2 of which were followed to a minimum".
std::string BasinSearch::evidence() const {
  int hits = 0;
  for (const FoundBasin& basin : basins_) hits += basin.hits;
  return fmt::format("{} points, {} of which {} followed to a minimum",
                     hits,
                     followed(),
                     followed() == 1 ? "was" : "were");
}

/// Returns how many points were followed to a minimum by a search of their own.
int BasinSearch::followed() const {
  return static_cast<int>(std::count_if(points_.begin(), points_.end(), [](const Spread& point) {
    return point.has_searched && point.basin >= 0;
  }));
}

/// Returns for each point the basin that it belongs to, apart from its better neighbors; -1: none.
std::vector<int> BasinSearch::basins_of_points() const {
  std::vector<int> all;
  for (const Spread& point : points_) {
    const bool is_open = point.score && point.basin < 0 && !point.has_searched;
    all.push_back(is_open ? explaining_basin(point.u, *point.score, kErrorOfPoint) : point.basin);
  }
  return all;
}

/// Returns the basins with the points that belong to them, by themselves or by a better neighbor.
std::vector<FoundBasin> BasinSearch::counted(const std::vector<int>& basin_of_point) const {
  std::vector<FoundBasin> all = basins_;
  for (FoundBasin& basin : all) basin.hits = 0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    std::size_t at = k;
    while (basin_of_point[at] < 0 && points_[at].linked_to >= 0)  // linked to a better one
      at = static_cast<std::size_t>(points_[at].linked_to);
    if (basin_of_point[at] >= 0) ++all[static_cast<std::size_t>(basin_of_point[at])].hits;
  }
  return all;
}

void BasinSearch::count_hits() {
  const std::vector<int> basin_of_point = basins_of_points();
  for (std::size_t k = 0; k < points_.size(); ++k) points_[k].basin = basin_of_point[k];
  basins_ = counted(basin_of_point);
}

double BasinSearch::expected_unseen() const {
  const double W = static_cast<double>(basins_.size());
  double H = 0.0;
  for (const FoundBasin& basin : basins_) H += basin.hits;
  return W > 0.0 && H > W + 2.0 ? W * (W + 1.0) / (H - W - 2.0) : kInfinity;
}

std::vector<FoundBasin> BasinSearch::basins() const {
  std::vector<FoundBasin> all = counted(basins_of_points());
  std::stable_sort(all.begin(), all.end(), [](const FoundBasin& a, const FoundBasin& b) {
    return a.value < b.value;
  });
  return all;
}

std::string BasinSearch::basins_in_words() const { return in_words(basins(), space_); }

/// Ends the method for a reason, in words that continue "the search ended".
void BasinSearch::end(const std::string& why, const std::string& statement) {
  count_hits();
  EndingClaim claim{.statement = statement, .test = why};
  const auto count = [&](const char* name, double number) {
    claim.numbers.push_back({.name = name, .value = number});
  };
  count("minima found", static_cast<double>(basins_.size()));
  count("points followed to a minimum", followed());
  count("searches left", static_cast<double>(waiting_.size()));
  if (expected_unseen() < kInfinity) count("further minima expected", expected_unseen());
  if (expected_unseen() < kFewUnseen) claim.numbers.back().at_most = kFewUnseen;
  claims_ = {claim};
  ending_ = fmt::format("{}; {}", why, in_words(basins(), space_));
  if (!waiting_.empty())
    ending_ += fmt::format("; {} search{} of worse targets {} left",
                           waiting_.size(),
                           waiting_.size() == 1 ? "" : "es",
                           waiting_.size() == 1 ? "was" : "were");
}

}  // namespace latsch
