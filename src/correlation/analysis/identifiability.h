// SPDX-License-Identifier: Apache-2.0
// Identifiability of a study: applies identification.h and cross_validation.h to the executor and
// the journal of a study. Trials in the journal are not run again, so a report finds the complete
// result in the journal.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "evaluation/executors/executor.h"
#include "evaluation/journal/journal.h"
#include "evaluation/schedule/scheduler.h"
#include "optimization/identifiability/cross_validation.h"
#include "optimization/identifiability/identification.h"

namespace latsch::correlation {

enum class Depth {
  /// Computes the intervals at the given point. A search that did not reach its end is not
  /// continued, because that could cost far more trials than the search itself.
  at_the_point,
  /// Determines the intervals. If the analysis finds a better point, it is continued there.
  intervals,
  profiles
};

struct Identifiability {
  /// point of the analysis: the initial one, or a better one found during the analysis
  DesignPoint point;
  Identification identification;
  std::optional<CrossValidation> cross_validation;  // known for two experiments or more
  /// trial with the least target in the journal; every display shows this point
  DesignPoint best = {};
  /// Shift of the refined model's values from those at `point`, in the unit cube (refined_shift.h).
  std::optional<Eigen::VectorXd> refined_shift = {};
};

/// Returns the interval around the center. It is widened to hold the refined model's interval too,
/// if that shift is known, and the best trial, which can be another point if the target is no sum
/// of squares.
Interval reported_interval(const Study& study, const Identifiability& what, int variable);

/// Returns reported_interval() if `what` is known and belongs to the given point; else nullopt.
std::optional<Interval> interval_of(const Study& study,
                                    const std::optional<Identifiability>& what,
                                    const DesignPoint& point,
                                    int variable);

/// Returns what sets the ends of the reported interval: "data"; "data and a bound" if one end is
/// limited only by a bound; "bounds" if the data limit neither end, or if the interval is as narrow
/// as the spacing of representable numbers between the bounds; "not known" without an estimate of
/// the noise.
std::string interval_source(const Study& study, const Identifiability& what, int variable);

/// True if the interval of a variable comes from its bounds alone: the data determine it so exactly
/// that the interval is as narrow as the spacing of representable numbers between these bounds.
bool is_set_by_bounds(const Identifiability& what, int variable);

/// Returns warnings, one sentence each: values beyond the scale of their robust loss, residuals
/// larger than their stated noise, noise that neighboring values share, a systematic misfit, bounds
/// that keep the fit off, constraints, values off the least squares, inaccurate derivatives, a
/// search that ended early, refits that did not converge.
std::vector<std::string> remarks(const Study& study, const Identifiability& what);

/// Runs the missing trials. Returns nullopt if a stop was requested, a Failure if the model fails
/// beside the point.
std::optional<Result<Identifiability>> identify(const Study& study,
                                                const DesignPoint& point,
                                                Depth depth,
                                                Executor& executor,
                                                Journal& journal,
                                                const RunOptions& options);

/// Returns the part of the analysis that the journal determines without further trials, around the
/// best trial at which derivatives are known. Returns nullopt if there is no such trial.
std::optional<Identifiability> recorded_identifiability(const Study& study, const Journal& journal);

/// Returns the value in the variable's unit, with as many digits as the half width of the interval
/// supports. format_known() formats every value shown beside an uncertainty in this way.
std::string known_digits(const DesignSpace& space,
                         int variable,
                         double value,
                         const Interval& interval);

/// Returns the value with its unit: "73 N/mm^2".
std::string value_text(const DesignSpace& space,
                       int variable,
                       double value,
                       const Interval& interval);

/// Returns "9.8 .. 10.3 N/mm^2" in the variable's unit, "at least 9.8 N/mm^2" if the other end lies
/// beyond the bounds, "anywhere" if both do. The digits are those of the value.
std::string interval_text(const DesignSpace& space, int variable, const Interval& interval);

/// Returns the reported interval in words; "not known" if there are no more residuals than
/// variables and no noise is stated. If a bound holds the variable, ", held at its bound 0.2 m" is
/// added. If the best trial by the target lies off the least squares, the addition is ", its least
/// squares at its bound 0.2 m".
std::string interval_text(const Study& study, const Identifiability& what, int variable);

/// Returns the shift from the value found to that of the refined model, such as "+0.012 MN/m^2",
/// with the digits of a value of that interval; "" if the shift is not known.
std::string shift_text(const Study& study, const Identifiability& what, int variable);

/// Returns the variables that make up most of a direction of the unit cube: "matrix up, carcass
/// down".
std::string direction_text(const DesignSpace& space, const Eigen::VectorXd& direction);

/// Returns a text that states the interval of a profile and the values of the variable beyond which
/// the model fails.
std::string profile_text(const DesignSpace& space, const TargetProfile& profile);

}  // namespace latsch::correlation
