// SPDX-License-Identifier: Apache-2.0
// Fills the report's chapters on identifiability and on the results of a design of experiments.
#pragma once

#include <optional>

#include "correlation/analysis/identifiability.h"
#include "correlation/analysis/prediction_bands.h"
#include "correlation/study/study.h"
#include "correlation/target/best_trial.h"
#include "report/report.h"

namespace latsch::correlation {

/// Returns the chapter on identifiability. `bands` has one entry for every experiment, or none.
report::IdentifiabilityPage identifiability_page(const Study& study,
                                                 const Identifiability& what,
                                                 const std::vector<ExperimentBand>& bands);

/// Returns the minima of a design of experiments that was evaluated; nullopt if there is none.
std::optional<report::Basins> basins_of(const Study& study, const std::vector<RatedTrial>& trials);

/// Returns the elementary effects if the design of the study is that of Morris; otherwise an empty
/// list.
std::vector<report::EffectRow> effects_of(const Study& study,
                                          const std::vector<RatedTrial>& trials);

/// Returns the shares of the variance if the study's design asks for them; otherwise an empty list.
std::vector<report::SharesOfResponse> shares_of(const Study& study, const Journal& journal);

}  // namespace latsch::correlation
