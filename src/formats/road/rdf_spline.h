// SPDX-License-Identifier: Apache-2.0
// Reads the 3-D spline road of .rdf: METHOD = '3D_SPLINE', or '3D' with [DATA_POINTS].
//
//   [GLOBAL_PARAMETERS]                CLOSED_ROAD, WIDTH, MU_LEFT, MU_RIGHT
//   [DATA_POINTS]
//   { X Y Z WIDTH BANK MU_LEFT MU_RIGHT OBSTACLES }
//
// The center line passes through the points, and the road is level across. The friction left and
// right of the line may differ. A width or friction of 0 in a row stands for the global one
// [Altair, 3D Spline Road and its sample file; Adams Tire, 3D Spline Road]. The line between two
// points is a cubic whose slopes at both ends are those of parabolas through three points. It is
// evaluated every half a meter (at most 200 times in an interval); the surface consists of
// triangles between these cross-sections (models/road/triangle_road.h).
//
// Bank angles, whose sign the descriptions do not define, and obstacles are not read, and this is
// reported. SEARCH_ALGORITHM and FORWARD_DIR are not used; a ROAD_VERTICAL other than z is refused.
#pragma once

#include "formats/text/teim_orbit.h"
#include "models/road/triangle_road.h"

namespace latsch::formats {

bool is_rdf_spline(const TeimOrbit& file);

/// Throws InputError that names file, line, what was found and what was expected.
road::TriangleMesh read_rdf_spline(const TeimOrbit& file);

}  // namespace latsch::formats
