// SPDX-License-Identifier: Apache-2.0
// A road that does not move as a mesh: a grid of lines along x and across, of which only those are
// kept from which straight lines between their neighbors would deviate (rule of Douglas and
// Peucker, 1973). A level stretch has two lines, a kerb as many as its waves need.
#pragma once

#include "models/road/road.h"
#include "report/scene.h"

namespace latsch::experiment {

struct RoadArea {
  double x0, x1, y0, y1;  // m
};

/// Has at most kMostPoints: if the rule keeps more, a coarser tolerance is used. `tolerance`: m.
report::Scene::Mesh road_surface(const road::Road& road,
                                 const RoadArea& area,
                                 double tolerance = 3e-4);

}  // namespace latsch::experiment
