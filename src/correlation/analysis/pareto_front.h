// SPDX-License-Identifier: Apache-2.0
// What two experiments ask of a model against each other, from the trials there are: none is run.
//
// Of every trial in the journal the parts T_a and T_b of the target (objective.h) are computed from
// its channels. A trial belongs to the front where no other is as good in both and better in one:
// on it one experiment is met better only at the cost of the other. Whatever the weights, the best
// trial lies on it. The front is that of the trials, an upper bound of what the model can do: a
// search goes where its weights send it.
#pragma once

#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "evaluation/journal/journal.h"

namespace latsch::correlation {

struct ParetoTrial {
  DesignPoint point;
  double a = 0.0, b = 0.0;  // T_a, T_b
  double target = 0.0;      // by the weights of the study
};

struct ParetoFront {
  std::string a, b;                     // names of the experiments
  std::vector<ParetoTrial> front = {};  // from the best in a to the best in b
  std::vector<ParetoTrial> others = {};
  ParetoTrial best = {};                      // by the weights of the study
  std::vector<std::string> best_values = {};  // "73 N/mm^2", a variable each
};

/// Throws InputError where an experiment of that name is not fitted, so that its channels are not
/// in the journal, and where no trial succeeded that fulfills all constraints.
ParetoFront pareto_front(const Study& study,
                         const Journal& journal,
                         const std::string& a,
                         const std::string& b);

/// A page that shows it, and the values of the variables along it.
std::string pareto_page(const Study& study, const ParetoFront& front);

}  // namespace latsch::correlation
