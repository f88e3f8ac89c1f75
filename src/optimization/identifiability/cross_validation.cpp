// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/cross_validation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <set>

namespace latsch {
namespace {

// Largest number of evaluations of a refit, to which two for each variable are added.
constexpr int kEvaluationsOfARefit = 30;

// Number of evaluations that a fold usually takes. The first holds if the model computes its
// derivatives; the second, plus one for each variable, if it does not.
constexpr double kUsualEvaluations = 6.0, kUsualEvaluationsWithoutSlopes = 10.0;

double root_mean_square(const Eigen::VectorXd& r, double values) {
  return std::sqrt(r.squaredNorm() / values);
}

}  // namespace

CrossValidation::CrossValidation(const DesignSpace& space,
                                 const Linearization& best,
                                 const std::vector<int>& group,
                                 double tolerance,
                                 std::vector<int> free,
                                 const std::map<int, Eigen::Index>& values)
    : space_(space) {
  assert(std::ssize(group) == best.r.size());
  if (free.empty()) {
    free.resize(static_cast<std::size_t>(space.size()));
    std::iota(free.begin(), free.end(), 0);
  }
  for (int left : std::set<int>(group.begin(), group.end())) {
    if (left < 0) continue;
    std::vector<Eigen::Index> rest, out;
    for (size_t row = 0; row < group.size(); ++row)
      (group[row] == left ? out : rest).push_back(row);
    assert(!rest.empty());
    const Linearization without{best.u, best.r(rest), best.J(rest, Eigen::all), best.is_exact};
    const auto known = values.find(left);
    const auto count = static_cast<double>(known == values.end() ? std::ssize(out) : known->second);
    const double now = root_mean_square(best.r(out), count);
    folds_.push_back({rest,
                      out,
                      count,
                      BroydenFit(without,
                                 free,
                                 {.tolerance = tolerance,
                                  .most_evaluations = kEvaluationsOfARefit + 2 * space.size(),
                                  .refresh = free,
                                  .region = FeasibleRegion(space)}),
                      {left, best.u, now, now}});
  }
  ask();
}

void CrossValidation::observe(const std::vector<Result<Evaluated>>& evaluated) {
  assert(evaluated.size() == wanted_.size());
  for (size_t k = 0; k < asked_.size(); ++k) {
    Fold& fold = folds_[asked_[k]];
    const Eigen::VectorXd u = *fold.refit.wanted();
    std::optional<Evaluated> rest;
    if (evaluated[k] && evaluated[k]->r.allFinite()) rest = evaluated[k]->of(fold.rest);
    fold.refit.observe(rest);
    if (!rest || fold.refit.best().u != u) continue;
    fold.result.u = u;
    fold.result.predicted = root_mean_square(evaluated[k]->r(fold.out), fold.values);
  }
  ask();
}

double CrossValidation::share_done() const {
  constexpr double kMostUnderWay = 0.9;  // largest share done of a fold that has not ended
  double sum = 0.0;
  for (const Fold& fold : folds_) {
    const auto variables = static_cast<double>(space_.size());
    const double usual =
        fold.refit.best().is_exact ? kUsualEvaluations : kUsualEvaluationsWithoutSlopes + variables;
    sum += fold.refit.wanted() ? std::min(kMostUnderWay, fold.refit.evaluations() / usual) : 1.0;
  }
  return sum / static_cast<double>(folds_.size());
}

void CrossValidation::ask() {
  wanted_.clear();
  asked_.clear();
  for (size_t f = 0; f < folds_.size(); ++f) {
    const auto& u = folds_[f].refit.wanted();
    if (!u) continue;
    asked_.push_back(static_cast<int>(f));
    wanted_.push_back(space_.from_unit({u->begin(), u->end()}));
  }
  if (!wanted_.empty()) return;
  for (const Fold& fold : folds_) {
    left_out_.push_back(fold.result);
    if (!fold.refit.converged()) left_out_.back().predicted = std::nan("");
  }
}

}  // namespace latsch
