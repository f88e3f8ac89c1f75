// SPDX-License-Identifier: Apache-2.0
// Fills the report's chapters on what the data determine and what a design of experiments showed.
#pragma once

#include <optional>

#include "correlation/analysis/identifiability.h"
#include "correlation/analysis/prediction_bands.h"
#include "correlation/study/study.h"
#include "correlation/target/best_trial.h"
#include "report/report.h"

namespace latsch::correlation {

/// The chapter on what the data determine. Bands: one for every experiment, or none.
report::Identifiability identifiability_page(const Study& study,
                                             const Identifiability& what,
                                             const std::vector<ExperimentBand>& bands);

/// The minima of the design that was evaluated; nullopt where there is none.
std::optional<report::Basins> basins_of(const Study& study, const std::vector<RatedTrial>& trials);

/// Where the study's design is Morris'; empty otherwise.
std::vector<report::EffectRow> effects_of(const Study& study,
                                          const std::vector<RatedTrial>& trials);

}  // namespace latsch::correlation
