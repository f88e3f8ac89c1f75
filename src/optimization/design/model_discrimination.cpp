// SPDX-License-Identifier: Apache-2.0
#include "optimization/design/model_discrimination.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/dense/cholesky.h"
#include "optimization/design/continuous_design.h"
#include "optimization/design/sobol.h"
#include "optimization/problem/point_vector.h"

namespace latsch {
namespace {

using RivalPlaces = std::vector<Eigen::VectorXd>;

constexpr int kMostRivalSteps = 60;
// Further starts of the fit of the rival, beside those that are given.
constexpr int kRivalStarts = 4;
constexpr double kRivalDifference = 1e-5;  // length of differences in the unit cube of v
constexpr double kRivalTolerance = 1e-10;  // relative gain of a step that ends a fit
constexpr double kFirstRivalReach = 0.05;  // first length of the steps of a search
constexpr std::size_t kRefinedRivals = 3;  // places that are refined
constexpr int kMostRivalExchanges = 30;
constexpr double kLeastRivalExchange = 1e-3;  // gain of a round of exchanges that ends them

/// Returns the slopes of the rival's predictions by its variables, by differences inside the cube.
Eigen::MatrixXd rival_slopes(const RivalProblem& problem,
                             const Eigen::VectorXd& s,
                             const Eigen::VectorXd& v,
                             const Eigen::VectorXd& z) {
  Eigen::MatrixXd F(z.size(), v.size());
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    Eigen::VectorXd moved = v;
    const double step = v[i] + kRivalDifference <= 1.0 ? kRivalDifference : -kRivalDifference;
    moved[i] += step;
    F.col(i) = (problem.rival(s, moved) - z) / step;
  }
  return F;
}

/// The sum of squares (1) at one v with its normal equations.
struct RivalSums {
  double T = 0.0;
  Eigen::MatrixXd M;
  Eigen::VectorXd slope;  // half the gradient of T
};

class RivalSearch {
 public:
  RivalSearch(const RivalProblem& problem, const RivalPlaces& tests, double weight)
      : problem_(problem), tests_(tests), weight_(weight) {
    for (const Eigen::VectorXd& s : tests) truth_.push_back(problem.truth(s));
  }

  /// Takes damped steps of Gauss and Newton inside the cube.
  RivalFit from(Eigen::VectorXd v) const {
    RivalSums sums = sums_at(v);
    double damping = 1e-3;
    for (int step = 0; step < kMostRivalSteps; ++step) {
      const Eigen::VectorXd to = moved(v, sums, damping);
      const double T = value_at(to);
      if (!(T < sums.T)) {
        damping *= 8.0;
        if (damping > 1e12) break;
        continue;
      }
      const double gain = sums.T - T;
      v = to;
      sums = sums_at(v);
      damping *= 0.2;
      if (gain <= kRivalTolerance * sums.T) break;
    }
    return {v, sums.T, sums.M};
  }

 private:
  /// Returns the end of a damped step; a variable that a bound holds stays there.
  Eigen::VectorXd moved(const Eigen::VectorXd& v, const RivalSums& sums, double damping) const {
    std::vector<Eigen::Index> free;
    for (Eigen::Index i = 0; i < v.size(); ++i) {
      const bool is_held =
          (v[i] <= 0.0 && sums.slope[i] > 0.0) || (v[i] >= 1.0 && sums.slope[i] < 0.0);
      if (!is_held) free.push_back(i);
    }
    Eigen::VectorXd to = v;
    if (free.empty()) return to;
    Eigen::MatrixXd A = sums.M(free, free);
    A.diagonal() *= 1.0 + damping;
    const Eigen::VectorXd p = numerics::PivotedCholesky(A).solve(Eigen::VectorXd(sums.slope(free)));
    for (std::size_t k = 0; k < free.size(); ++k)
      to[free[k]] = std::clamp(v[free[k]] - p[static_cast<Eigen::Index>(k)], 0.0, 1.0);
    return to;
  }
  RivalSums sums_at(const Eigen::VectorXd& v) const {
    const Eigen::VectorXd off = v - problem_.start;
    RivalSums sums{off.dot(problem_.present * off), problem_.present, problem_.present * off};
    for (std::size_t k = 0; k < tests_.size(); ++k) {
      const Eigen::VectorXd z = problem_.rival(tests_[k], v);
      const Eigen::MatrixXd F = rival_slopes(problem_, tests_[k], v, z);
      const Eigen::VectorXd d = truth_[k] - z;
      sums.T += weight_ * d.squaredNorm();
      sums.M += weight_ * F.transpose() * F;
      sums.slope -= weight_ * F.transpose() * d;
    }
    return sums;
  }
  double value_at(const Eigen::VectorXd& v) const {
    const Eigen::VectorXd off = v - problem_.start;
    double T = off.dot(problem_.present * off);
    for (std::size_t k = 0; k < tests_.size(); ++k)
      T += weight_ * (truth_[k] - problem_.rival(tests_[k], v)).squaredNorm();
    return T;
  }

  const RivalProblem& problem_;
  const RivalPlaces& tests_;
  double weight_;
  std::vector<Eigen::VectorXd> truth_;
};

RivalFit fit_from(const RivalProblem& problem,
                  const RivalPlaces& tests,
                  double weight,
                  const std::vector<Eigen::VectorXd>& starts) {
  const RivalSearch search(problem, tests, weight);
  RivalFit best;
  for (const Eigen::VectorXd& start : starts) {
    RivalFit fit = search.from(start);
    if (best.v.size() == 0 || fit.T < best.T) best = std::move(fit);
  }
  return best;
}

/// Chooses tests while it keeps the fit of the rival at those chosen.
class RivalTests {
 public:
  explicit RivalTests(const RivalProblem& problem) : problem_(problem) {
    const DesignProblem places{problem.settings, {}, problem.admits, {}, {}};
    points_ = first_places(places);
  }
  bool is_possible() const { return !points_.empty(); }

  /// Returns the place that raises T most by (2), given other tests.
  Eigen::VectorXd best_beside(const RivalPlaces& others, const RivalPlaces& near) const {
    const RivalFit fit = others.empty() ? known() : fit_rival(problem_, others);
    std::vector<std::pair<double, Eigen::VectorXd>> rated;
    for (const RivalPlaces* places : {&points_, &near})
      for (const Eigen::VectorXd& s : *places) rated.emplace_back(gain(fit, s), s);
    std::stable_sort(
        rated.begin(), rated.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    rated.resize(std::min(rated.size(), kRefinedRivals));
    for (auto& [value, s] : rated) refine(fit, value, s);
    return std::max_element(rated.begin(),
                            rated.end(),
                            [](const auto& a, const auto& b) { return a.first < b.first; })
        ->second;
  }

 private:
  RivalFit known() const { return {problem_.start, 0.0, problem_.present}; }

  double gain(const RivalFit& fit, const Eigen::VectorXd& s) const {
    const Eigen::VectorXd z = problem_.rival(s, fit.v);
    const Eigen::VectorXd d = problem_.truth(s) - z;
    const Eigen::MatrixXd F = rival_slopes(problem_, s, fit.v, z);
    const Eigen::MatrixXd spread =
        Eigen::MatrixXd::Identity(d.size(), d.size()) +
        F * numerics::PivotedCholesky(fit.M).solve(Eigen::MatrixXd(F.transpose()));
    return d.dot(numerics::PivotedCholesky(spread).solve(d));
  }

  void refine(const RivalFit& fit, double& value, Eigen::VectorXd& s) const {
    for (double reach = kFirstRivalReach; reach > problem_.finest;) {
      bool moved = false;
      for (Eigen::Index i = 0; i < s.size(); ++i)
        for (const double sign : {1.0, -1.0}) {
          Eigen::VectorXd to = s;
          to[i] = std::clamp(s[i] + sign * reach, 0.0, 1.0);
          if (to == s || (problem_.admits && !problem_.admits(to))) continue;
          const double reached = gain(fit, to);
          if (!(reached > value)) continue;
          value = reached;
          s = to;
          moved = true;
        }
      if (!moved) reach *= 0.5;
    }
  }

  const RivalProblem& problem_;
  RivalPlaces points_;
};

}  // namespace

RivalFit fit_rival(const RivalProblem& problem,
                   const std::vector<Eigen::VectorXd>& tests,
                   double weight) {
  std::vector<Eigen::VectorXd> starts{problem.start};
  std::vector<DesignVariable> variables;
  for (Eigen::Index i = 0; i < problem.start.size(); ++i)
    variables.push_back({.name = std::to_string(i)});
  if (problem.start.size() <= kMostSobolVariables)
    for (const DesignPoint& point : sobol(DesignSpace(variables), kRivalStarts).points)
      starts.push_back(to_vector(point.values));
  return fit_from(problem, tests, weight, starts);
}

std::vector<Eigen::VectorXd> best_tests_against(const RivalProblem& problem, int count) {
  const RivalTests search(problem);
  RivalPlaces tests;
  if (!search.is_possible()) return tests;
  for (int k = 0; k < count; ++k) tests.push_back(search.best_beside(tests, tests));
  double T = fit_rival(problem, tests).T;
  for (int round = 0; round < kMostRivalExchanges; ++round) {
    const double before = T;
    for (std::size_t k = 0; k < tests.size(); ++k) {
      RivalPlaces others = tests;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
      RivalPlaces changed = tests;
      changed[k] = search.best_beside(others, tests);
      const double reached = fit_rival(problem, changed).T;
      if (!(reached > T)) continue;
      T = reached;
      tests = std::move(changed);
    }
    if (!(T > (1.0 + kLeastRivalExchange) * before)) break;
  }
  return tests;
}

}  // namespace latsch
