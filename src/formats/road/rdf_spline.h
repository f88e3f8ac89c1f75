// SPDX-License-Identifier: Apache-2.0
// The 3-D spline road of .rdf: METHOD = '3D_SPLINE', or '3D' with [DATA_POINTS].
//
//   [GLOBAL_PARAMETERS]                CLOSED_ROAD, WIDTH, MU_LEFT, MU_RIGHT
//   [DATA_POINTS]
//   { X Y Z WIDTH BANK MU_LEFT MU_RIGHT OBSTACLES }
//
// A center line through the points, level across; left and right of it friction of their own. A
// width or friction of 0 in a row stands for the global one [Altair, 3D Spline Road and its sample
// file; Adams Tire, 3D Spline Road]. The line between two points is a cubic with the slopes of the
// parabolas through three points each, at stations every half a meter (200 of an interval at most);
// the surface is that of triangles between them (models/road/triangle_road.h).
//
// Not read, and said: a bank angle, of which the descriptions do not tell the sign; obstacles. Not
// used: SEARCH_ALGORITHM, FORWARD_DIR, a ROAD_VERTICAL other than z is refused.
#pragma once

#include "formats/text/teim_orbit.h"
#include "models/road/triangle_road.h"

namespace latsch::formats {

bool is_rdf_spline(const TeimOrbit& file);

/// Throws InputError naming file, line, what was found and expected.
road::TriangleMesh read_rdf_spline(const TeimOrbit& file);

}  // namespace latsch::formats
