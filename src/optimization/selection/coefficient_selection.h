// SPDX-License-Identifier: Apache-2.0
// Chooses the coefficients that measured values carry, by dropping useless ones from a fit of all
// candidates.
//
//   1. All candidates are fitted, with a weak prior of a range for each (selection_rows.h). The
//      noise that neighbors share is estimated there.
//   2. Rounds. The fit's own covariance predicts how much -2 log L rises if a set is dropped
//      (drop_set.h): the largest set whose rise stays below 2 a coefficient is dropped. If none
//      does, the set that should lower BIC most is dropped, or the single unit with the least rise.
//      All others are refitted. If a set costs more than twice as much as expected, because
//      residuals are not linear, half of it is dropped instead. The models form a path that ends 60
//      BIC above its least.
//   3. A bound that holds a candidate makes its covariance meaningless. Such candidates are tested,
//      before candidates are dropped one by one, by a refit without each; the best is adopted if
//      the criterion falls.
//      A model that a smaller one overtakes was not at its minimum, and is fitted anew from there.
//   4. The best three models are fitted once more, from the start. If that ends lower, the path has
//      followed another minimum, and everything is repeated from the better fit, at most twice.
//   5. With the criterion cross_validation, each recording is left out in turn from every model.
//
// The model with the least criterion is the choice, and models within 2 of it are rivals, which the
// values do not tell apart [Burnham, Anderson, Model Selection and Multimodel Inference, 2002, ch.
// 2.6].
//
// Limits: a dropped candidate is never taken up again. The intervals of the chosen model do not
// know that the same values chose it: they are too narrow for coefficients that were nearly
// dropped, unless other values than those of the choice determine them.
//
// Ask and tell, in rounds, like Identification. If evaluations return slopes, these are used.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/result.h"
#include "optimization/identifiability/broyden_fit.h"
#include "optimization/selection/selection_rows.h"

namespace latsch {

struct SelectionOptions {
  SelectionCriterion criterion = SelectionCriterion::bic;
  int refits = 20;  // most refits of a pass, those of tests and of halved sets included
};

/// One model of the path.
struct SelectedModel {
  std::vector<int> units;      // units that are kept, ascending
  std::vector<int> dropped;    // units that this model lacks and the one before has
  int round = 0;               // 0: all candidates
  int coefficients = 0;        // number of variables that are fitted
  Linearization at;            // whitened, without the rows of the weak prior
  double expected_rise = 0.0;  // rise of -2 log L that the covariance predicted
  double minus_two_log = 0.0;  // -2 log L up to a constant
  double bic = 0.0;
  double aicc = 0.0;
  /// Sum of squares of the residuals of recordings left out; NaN if it is not known.
  double left_out = std::numeric_limits<double>::quiet_NaN();
  bool converged = false;  // false: the evaluations of its fit ran out
  /// True if the slopes promise a gain for long steps that none of the steps tried brought, as in a
  /// curved valley or along variables that the values hardly determine.
  bool is_flat = false;
  bool is_from_start = false;  // true: the fit from the start values was the better one
  /// For each of `units`, the rise that dropping it alone causes, by the covariance; NaN if a bound
  /// holds it.
  std::vector<double> rises = {};
};

/// The fate of a unit.
struct UnitFate {
  int round = 0;      // round of the path that dropped it; 0: no round did
  double rise = 0.0;  // rise that dropping it alone would have caused then; NaN: a bound held it
  /// Kept unit that acts most alike then, and the correlation with it; -1: none.
  int alike = -1;
  double correlation = 0.0;
  bool tested = false;             // true if a refit without it was rated, because a bound held it
  double tested_rise = 0.0;        // rise of -2 log L in this test
  bool cannot_be_dropped = false;  // true: the model fails without it
};

enum class SelectionEnd { least_passed, nothing_left, refits };

class CoefficientSelection {
 public:
  CoefficientSelection(SelectionProblem problem, const SelectionOptions& options);

  /// Returns the points of the unit cube to be evaluated next; empty: ended.
  const std::vector<Eigen::VectorXd>& wanted() const { return wanted_; }
  /// Records the outcomes of the wanted points, in their order. `evaluated` may hold only the first
  /// if is_enough() is true for it.
  void observe(const std::vector<Result<Evaluated>>& evaluated);
  /// True if the outcome of the first wanted point makes the others needless.
  bool is_enough(const Result<Evaluated>& first) const {
    return phase_ == Phase::start && first && first->has_slopes();
  }

  /// Purpose of the wanted points.
  enum class Phase {
    start,
    full_fit,
    dropping,
    testing,
    restart_points,
    restarts,
    leaving_out,
    done
  };
  Phase phase() const { return phase_; }

  /// Returns the reason if no selection is possible.
  const Status& status() const { return status_; }
  const std::vector<SelectedModel>& path() const { return path_; }
  /// Returns the value of the criterion of a model of the path; infinite if it is not known.
  double criterion(const SelectedModel& model) const;
  /// Returns the index in the path of the model with the least criterion.
  std::size_t best() const;
  /// Returns the indices of all models within `distance` of the least criterion, the best first.
  std::vector<std::size_t> rivals(double distance = 2.0) const;
  /// Returns one entry for each unit.
  const std::vector<UnitFate>& fates() const { return fates_; }
  /// Returns the reason for which the path ended.
  SelectionEnd ending() const { return ending_; }
  /// Returns the number of refits of all passes.
  int refits() const { return refits_; }
  /// Returns how often the path was walked: more than once if fits from the start ended lower.
  int passes() const { return passes_; }
  /// The rows of the fits, with the noise that was estimated.
  const SelectionRows& rows() const { return *rows_; }
  /// Returns the variables that a model fits, ascending.
  std::vector<int> free_variables(const SelectedModel& model) const { return free_of(model.units); }
  /// Returns the confidence of a model's variables, as if the model had been known before.
  Confidence confidence_of(const SelectedModel& model) const;

 private:
  struct Running {
    BroydenFit fit;
    std::vector<int> units;
    std::vector<int> dropped;
    double expected_rise = 0.0;
    std::size_t model = 0;  // index in the path, for restarts and recordings left out
    std::vector<Eigen::Index> rest = {}, out = {};  // rows, if a recording is left out
    double left_out = 0.0;
    int most_evaluations = 0;
    bool mends = false;  // true: a larger model that a smaller one has overtaken is fitted anew
  };

  std::vector<int> free_of(const std::vector<int>& units) const;
  Eigen::VectorXd dropped_from(Eigen::VectorXd u, const std::vector<int>& units) const;
  BroydenFitOptions fit_options(const Linearization& at, std::size_t variables) const;
  Running& run(BroydenFit fit, const std::vector<int>& units, const std::vector<int>& dropped);
  void start_observed(const std::vector<Result<Evaluated>>& evaluated);
  void running_observed(const std::vector<Result<Evaluated>>& evaluated);
  void ask();
  void next();
  void begin_full_fit();
  void full_fit_done();
  void plan_round();
  void begin_drop(const std::vector<int>& units, double expected_rise);
  void drop_done();
  void mend(const Linearization& better);
  void begin_tests(const std::vector<int>& units);
  void tests_done();
  void begin_restarts();
  void restart_points_observed(const std::vector<Result<Evaluated>>& evaluated);
  void restarts_done();
  void ask_start();
  void begin_again(const Eigen::VectorXd& start);
  bool has_refits_left() const { return refits_ - earlier_refits_ < options_.refits; }
  void begin_leaving_out();
  void leaving_out_done();
  SelectedModel rated(const Running& running) const;
  void add_to_path(const Running& running);
  void rate_units(SelectedModel& model);
  bool is_held(const Linearization& at, int variable) const;
  double noise_variance(const SelectedModel& model) const;

  SelectionProblem problem_;
  SelectionOptions options_;
  Phase phase_ = Phase::start;
  Status status_;
  std::vector<Eigen::VectorXd> wanted_;
  std::vector<Running> running_;
  std::vector<std::size_t> asked_;      // indices in running_ of the wanted points
  std::vector<std::size_t> restarted_;  // models of the path that are fitted once more
  std::optional<SelectionRows> rows_;
  Linearization raw_start_;  // residuals and slopes at the start
  bool noise_taken_ = false;
  std::vector<SelectedModel> path_;
  Linearization present_;  // the last model of the path, with the rows of the prior
  std::vector<UnitFate> fates_;
  SelectionEnd ending_ = SelectionEnd::nothing_left;
  int refits_ = 0;
  int earlier_refits_ = 0;  // refits of earlier passes
  int passes_ = 1;
};

}  // namespace latsch
