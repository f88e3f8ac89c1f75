// SPDX-License-Identifier: Apache-2.0
// Fills the report's chapters on what the data determine and what a design of experiments showed.
#pragma once

#include <optional>

#include "correlation/analysis/identifiability.h"
#include "correlation/study/study.h"
#include "correlation/target/best_trial.h"
#include "report/report.h"

namespace latsch::correlation {

/// The chapter on what the data determine.
report::Identifiability identifiability_page(const Study& study, const Identifiability& what);

/// The minima of the design that was evaluated; nullopt where there is none.
std::optional<report::Basins> basins_of(const Study& study, const std::vector<RatedTrial>& trials);

/// Where the study's design is Morris'; empty otherwise.
std::vector<report::EffectRow> effects_of(const Study& study,
                                          const std::vector<RatedTrial>& trials);

/// "matrix up, carcass down": the variables that make up most of a direction of the unit cube.
std::string direction_text(const DesignSpace& space, const Eigen::VectorXd& direction);

}  // namespace latsch::correlation
