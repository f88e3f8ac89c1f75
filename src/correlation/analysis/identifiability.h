// SPDX-License-Identifier: Apache-2.0
// What the measurements of a study determine: identification.h and cross_validation.h over the
// executor and the journal of a study. Trials the journal knows are not run again, and a report
// finds all of it in the journal.
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
  at_the_point,  // intervals of the point as it is: a search that was not let to its end would be
                 // gone on with here, by far more trials than it had
  intervals,     // and of a better point where one is found on the way
  profiles
};

struct Identifiability {
  DesignPoint point;  // what it belongs to: where it began, or a better one found since
  Identification identification;
  std::optional<CrossValidation> cross_validation;  // with two experiments or more
  DesignPoint best = {};  // of the journal, by the target: what every reader shows
  /// In the unit cube, of the refined model's numbers from those at `point`: refined_shift.h.
  std::optional<Eigen::VectorXd> refined_shift = {};
};

/// The interval around the center, as wide as to hold that of the refined model too, where its
/// shift is known, and the best trial: that can be another point where the target is no sum of
/// squares.
Interval reported_interval(const Study& study, const Identifiability& what, int variable);

/// The same where it is known and belongs to that point.
std::optional<Interval> interval_of(const Study& study,
                                    const std::optional<Identifiability>& what,
                                    const DesignPoint& point,
                                    int variable);

/// What to mind, a sentence each: residuals larger than their stated noise, noise that neighbors
/// share, derivatives that are rough, a search that ended early, refits that did not converge.
std::vector<std::string> remarks(const Study& study, const Identifiability& what);

/// Runs what is missing. nullopt where a stop was requested; a Failure where the model fails beside
/// the point.
std::optional<Result<Identifiability>> identify(const Study& study,
                                                const DesignPoint& point,
                                                Depth depth,
                                                Executor& executor,
                                                Journal& journal,
                                                const RunOptions& options);

/// As far as the journal goes, without evaluating: around the best trial whose neighbors are known.
/// nullopt where there is none.
std::optional<Identifiability> recorded_identifiability(const Study& study, const Journal& journal);

/// The value's number in the variable's unit, as far as the interval's half width leaves it known:
/// format_known(), the one rule of every value that stands beside an uncertainty.
std::string known_digits(const DesignSpace& space,
                         int variable,
                         double value,
                         const Interval& interval);

/// With its unit: "73 N/mm^2".
std::string value_text(const DesignSpace& space,
                       int variable,
                       double value,
                       const Interval& interval);

/// "9.8 .. 10.3 N/mm^2" in the variable's unit; "at least 9.8 N/mm^2" where the other end lies
/// beyond the bounds, "anywhere" where both do. Digits as those of the value.
std::string interval_text(const DesignSpace& space, int variable, const Interval& interval);

/// The same of the reported interval; "not known" where there are no more residuals than variables
/// and no noise is stated. With the bound that holds the variable, by its value: ", held at its
/// bound 0.2 m". The best trial by the target may lie off the least squares: then ", its least
/// squares at its bound 0.2 m".
std::string interval_text(const Study& study, const Identifiability& what, int variable);

/// "+0.012 MN/m^2": how far from the value found the refined model has it, with the digits of a
/// value of that interval; "" where that is not known.
std::string shift_text(const Study& study, const Identifiability& what, int variable);

/// "matrix up, carcass down": the variables that make up most of a direction of the unit cube.
std::string direction_text(const DesignSpace& space, const Eigen::VectorXd& direction);

/// The interval of a profile, and beyond which values the model fails.
std::string profile_text(const DesignSpace& space, const Profile& profile);

}  // namespace latsch::correlation
