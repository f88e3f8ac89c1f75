// SPDX-License-Identifier: Apache-2.0
// How far the mesh of the found tire is from the converged tire: an error the found values absorb
// without a word.
#pragma once

#include "correlation/study/study.h"
#include "report/report.h"

namespace latsch::correlation {

/// Which meshes are computed. One sector's meshes take seconds, those on the ground minutes.
enum class MeshError { of_one_sector, also_on_the_ground };

/// Adds growth and frequencies of the unloaded tire, if asked for also force and frequencies on the
/// ground, as deep as the page's pictures go. What does not converge is left out.
void add_mesh_error(const Study& study,
                    const DesignPoint& point,
                    MeshError extent,
                    report::StudyReport& page);

}  // namespace latsch::correlation
