// SPDX-License-Identifier: Apache-2.0
// Shares of the variance that each variable causes over the whole space (variance_shares.h), from
// the points of a scattered design of experiments: for the target, and for each fitted experiment.
// Of an experiment that measures one value, the response is the simulated value; of any other, it
// is the experiment's target.
#pragma once

#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "evaluation/journal/journal.h"
#include "optimization/surrogate/variance_shares.h"

namespace latsch::correlation {

struct ResponseShares {
  std::string response;   // "target", "value of NAME" or "target of NAME"
  VarianceShares shares;  // one share for each variable, in their order
};

struct DoeShares {
  std::vector<ResponseShares> responses;
  int points = 0;       // points that succeeded
  int missing = 0;      // points of the design that did not
  std::string refusal;  // why there are no shares; empty if there are
};

/// Returns the shares for the points of the design that the journal knows. Refuses if more than a
/// fifth of the points failed, because the rest does not cover the space, and if too few succeeded.
DoeShares doe_shares(const Study& study, const StudyDesign& design, const Journal& journal);

}  // namespace latsch::correlation
