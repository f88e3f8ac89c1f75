// SPDX-License-Identifier: Apache-2.0
// Draws a road that does not move as a mesh: a grid of lines along x and across. Only those lines
// are kept without which straight lines between the others would deviate from the road (rule of
// Douglas and Peucker, 1973). A level stretch has two lines, a kerb as many as its waves need.
#pragma once

#include "models/road/road.h"
#include "report/scene.h"

namespace latsch::experiment {

struct RoadArea {
  double x0, x1, y0, y1;  // m
};

/// The mesh has at most kMostPoints points: if the rule keeps more, a coarser tolerance than
/// `tolerance`, m, is used.
report::Scene::Mesh road_surface(const road::Road& road,
                                 const RoadArea& area,
                                 double tolerance = 3e-4);

}  // namespace latsch::experiment
