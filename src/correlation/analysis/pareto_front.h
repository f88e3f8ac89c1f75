// SPDX-License-Identifier: Apache-2.0
// The trade-off between two experiments, from the trials in the journal. No trial is run.
//
// The parts T_a and T_b of the target (objective.h) are computed for every trial in the journal
// from its channels. A trial belongs to the front if no other trial is as good in both parts and
// better in one. On the front, one experiment improves only at the cost of the other. The best
// trial lies on the front for any weights. The front of the trials is an upper bound of the errors
// that the model can reach, because a search explores only the part that its weights favor.
#pragma once

#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "evaluation/journal/journal.h"

namespace latsch::correlation {

struct ParetoTrial {
  DesignPoint point;
  double a = 0.0, b = 0.0;  // T_a, T_b
  double target = 0.0;      // with the weights of the study
};

struct ParetoFront {
  std::string a, b;                     // names of the two experiments
  std::vector<ParetoTrial> front = {};  // sorted from the best in a to the best in b
  std::vector<ParetoTrial> others = {};
  ParetoTrial best = {};  // trial with the least target by the weights of the study
  std::vector<std::string> best_values = {};  // one text for each variable, such as "73 N/mm^2"
  /// Reason why the trial is not the best point of the study (search/search_standing.h); empty if
  /// it is.
  std::string no_best = {};
};

/// Throws InputError if an experiment of that name is not fitted, because then its channels are not
/// in the journal, and if no trial succeeded that fulfills all constraints.
ParetoFront pareto_front(const Study& study,
                         const Journal& journal,
                         const std::string& a,
                         const std::string& b);

/// Returns an HTML page that shows the front and the values of the variables along it.
std::string pareto_page(const Study& study, const ParetoFront& front);

}  // namespace latsch::correlation
