// SPDX-License-Identifier: Apache-2.0
// Streamlines of a tire with one value a sector, interpolated between the sectors.
//
// Between the middles of sectors a value follows a closed cubic spline, and histories are taken on
// places that divide the way from each middle to the next into four. On the sectors' values alone
// (H.2) errs four to five times as much as the elements do: a wave of eight has only seven steps on
// sectors of 6 degrees.
#pragma once

#include <Eigen/Core>

#include "models/fe_tire/history/streamlines.h"
#include "models/fe_tire/mesh/mesh.h"

namespace latsch::fe_tire {

/// Places of the spline for each sector; the first is the sector's middle.
constexpr int kPlacesPerSector = 4;

/// The middles of the sectors, in the order of the sectors.
Streamline sector_line(const Mesh& mesh);
/// The places of the spline, from the middle of the first sector on.
Streamline spline_line(const Mesh& mesh);
/// Returns the matrix [sectors x places] that gives values at the places from those of the sectors:
/// at places = of sectors times matrix.
Eigen::MatrixXd sector_spline(const Mesh& mesh);

}  // namespace latsch::fe_tire
