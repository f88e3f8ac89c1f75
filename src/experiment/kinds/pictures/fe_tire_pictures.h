// SPDX-License-Identifier: Apache-2.0
// Pictures of a finite-element tire on a page: the tire in the states of its tests, and the error
// of its mesh, which a fit would compensate by wrong values without showing it.
#pragma once

#include <optional>
#include <vector>

#include "experiment/language/test.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/tire_description.h"
#include "report/report.h"

namespace latsch::experiment {

/// Adds the tire's name and its pictures: inflated, pressed to the depth of the first test on the
/// ground, and its modes under the conditions of the first modal test. States that do not converge
/// are left out.
void add_pictures(const fe_tire::TireDescription& tire,
                  const std::vector<const Test*>& tests,
                  report::StudyReport& page);

/// Adds the pictures of a tire on any mesh, whose layers are already in `pictures`; `own_pressure`,
/// Pa, applies to tests that state none, and `rim` to tests in which the rim moves.
void add_pictures(fe_tire::FeTire& tire,
                  double own_pressure,
                  const std::vector<const Test*>& tests,
                  const std::optional<fe_tire::RimBody>& rim,
                  report::TirePictures pictures,
                  report::StudyReport& page);

/// Adds the mesh error of growth and frequencies of the unloaded tire and, if the thoroughness is
/// `minutes`, of force and frequencies on the ground at the deflection of the page's pictures.
/// Pressure and ground are those of the first test. States that do not converge are left out.
void add_mesh_error(const fe_tire::TireDescription& tire,
                    const std::vector<const Test*>& tests,
                    Thoroughness thoroughness,
                    report::StudyReport& page);

}  // namespace latsch::experiment
