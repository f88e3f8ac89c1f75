// SPDX-License-Identifier: Apache-2.0
// What a page shows of a finite-element tire: the tire in the states its tests put it in, and how
// far its mesh is from the converged tire, an error the found values absorb without a word.
#pragma once

#include <vector>

#include "experiment/language/test.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/tire_description.h"
#include "report/report.h"

namespace latsch::experiment {

/// Adds the tire's name and its pictures: inflated, pressed as deep as the first test on the ground
/// goes, modes as the first modal test sees them. What does not converge is left out.
void add_pictures(const fe_tire::TireDescription& tire,
                  const std::vector<const Test*>& tests,
                  report::StudyReport& page);

/// The same of any mesh, its layers already in `pictures`; `own_pressure`, Pa: of tests that state
/// none.
void add_pictures(fe_tire::FeTire& tire,
                  double own_pressure,
                  const std::vector<const Test*>& tests,
                  report::TirePictures pictures,
                  report::StudyReport& page);

/// Adds growth and frequencies of the unloaded tire; where minutes are given, also force and
/// frequencies on the ground, as deep as the page's pictures go. Pressure and ground are those of
/// the first test. What does not converge is left out.
void add_mesh_error(const fe_tire::TireDescription& tire,
                    const std::vector<const Test*>& tests,
                    Thoroughness thoroughness,
                    report::StudyReport& page);

}  // namespace latsch::experiment
