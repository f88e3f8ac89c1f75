// SPDX-License-Identifier: Apache-2.0
// Reads road files: OpenCRG (.crg), Adams road data (.rdf), and roads described by hand (.toml, see
// models/road/road_reader.h).
//
// Supported .rdf files: METHOD '2D' with ROAD_TYPE flat, plank, pothole, ramp, roof, sine, sweep,
// poly_line and drum; METHOD '3D' with [NODES] and [ELEMENTS]; '3D_SPLINE' (rdf_spline.h). Meanings
// follow the manuals [Adams Tire, 2D Road Model; Altair, TeimOrbit 2D road types]: lengths in
// [UNITS]; DIAMETER < 0 is an outer drum; a bevel is measured along the road; DIRECTION and
// CLEAT_DIRECTION turn a bar counterclockwise from the axle; ROTATION_ANGLE_XY_PLANE turns the road
// about z; OFFSET lifts it. CLEAT_STARTING_ANGLE is counted from the tire against the rotation of
// the drum, DEPTH downward.
//
// A file that states no LENGTH is refused, and one that uses angles or times without stating ANGLE
// or TIME. If a triangle has two coefficients of friction, the first, along the road, is used for
// both directions. The type stochastic_uneven is not read, because its random numbers are those of
// the program that made it.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "formats/text/teim_orbit.h"
#include "measurement/ledger.h"
#include "models/road/crg_road.h"
#include "models/road/road.h"
#include "models/road/triangle_road.h"

namespace latsch::formats {

struct RoadFile {
  /// kind of road for the user: "OpenCRG", "Adams drum", "Adams triangles", "drum"
  std::string kind;
  std::vector<std::string> facts;     // description of the content, for a person
  std::vector<TeimOrbitPart> unused;  // parts of a .rdf that have no meaning here
  std::vector<std::string> kept;      // statements of a .crg that do not concern its surface
  std::vector<std::string> warnings;  // with file and line
  std::vector<LedgerDoubt> doubts;    // unused parts of a .rdf that would change the surface
  std::unique_ptr<const road::Road> road;
  const road::CrgRoad* crg = nullptr;             // `road` as OpenCRG; nullptr: another kind
  const road::TriangleRoad* triangles = nullptr;  // `road` as triangles; nullptr: another kind
};

/// Returns the file, which read_road_file() has read before, and the files to which it refers.
std::vector<std::filesystem::path> files_of_road(const std::filesystem::path& file);

/// A file that a road opens, and the file and line that refer to it; the first file has no such
/// place.
struct RoadReference {
  std::filesystem::path file;
  Place named_in;
};
/// Returns the files to which a road file refers, in their order, with the places that refer to
/// them.
std::vector<RoadReference> references_of_road(const std::filesystem::path& file);

/// Reads a road file; the extension of its name determines the kind. Throws InputError that names
/// file, line, what was found and what was expected.
RoadFile read_road_file(const std::filesystem::path& file);

RoadFile read_rdf(const TeimOrbit& file);  // defined in rdf_file.cpp

/// Returns a mesh as text of a .rdf in meters with [NODES] and [ELEMENTS]; reading it gives the
/// same bits.
std::string rdf_text(const road::TriangleMesh& mesh, std::string_view comment);

}  // namespace latsch::formats
