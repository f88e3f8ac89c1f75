// SPDX-License-Identifier: Apache-2.0
// The tire at the point a study has found, in the states its experiments put it in: for the
// pictures of a report.
#pragma once

#include "correlation/target/tire_trials.h"
#include "report/report.h"

namespace latsch::correlation {

/// Adds the tire's name and its pictures: inflated, pressed as deep as the first experiment on the
/// ground goes, modes as the first modal experiment sees them. What does not converge is left out.
void add_found_tire(const Study& study,
                    const DesignPoint& point,
                    TireTrials& trials,
                    report::StudyReport& page);

}  // namespace latsch::correlation
