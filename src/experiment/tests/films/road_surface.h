// SPDX-License-Identifier: Apache-2.0
// A road that stands still as a mesh: a grid of lines along x and across, of which only those are
// kept that the straight ones between their neighbors would miss (Douglas and Peucker's rule,
// 1973). A level stretch has two, a kerb as many as its waves take.
#pragma once

#include "models/road/road.h"
#include "report/scene.h"

namespace latsch::experiment {

struct RoadArea {
  double x0, x1, y0, y1;  // m
};

/// No more than kMostPoints: where the rule leaves more, coarser ones do. `tolerance`: m.
report::Scene::Mesh road_surface(const road::Road& road,
                                 const RoadArea& area,
                                 double tolerance = 3e-4);

}  // namespace latsch::experiment
