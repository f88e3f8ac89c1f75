// SPDX-License-Identifier: Apache-2.0
// Description of a tire as its manufacturer states it: size, contour, thicknesses, cord layers,
// rubber regions.
//
// The section is built around a reference line, a contour within the wall. Thicknesses are measured
// from this line along its normal: inside is toward the inflation gas, outside away from it. The
// `position` of a point along the wall is the arc length from the crown (0) to the bead (1), equal
// on both sides.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "models/fe_tire/description/contour.h"
#include "models/fe_tire/description/rolling_friction.h"
#include "models/fe_tire/element/hex8.h"
#include "models/fe_tire/history/loss_materials.h"
#include "models/fe_tire/mesh/materials.h"
#include "models/fe_tire/mesh/mesh.h"

namespace latsch::fe_tire {

/// A length as a function of the position along the wall. It is linear between its points and
/// constant beyond them.
struct WallProfile {
  std::vector<double> position;  // positions of the points, ascending, from 0 to 1
  std::vector<double> length;    // m
  /// Returns the length, m, at the position q, 0 to 1.
  double at(double q) const;
  bool operator==(const WallProfile&) const = default;
};

/// A part of the wall, equal on both sides of the tire: from <= position < to. If `to` is 1, the
/// bead is included.
struct Extent {
  double from = 0.0, to = 1.0;  // position, 0 at the crown, 1 at the bead
  /// Returns true if the position q lies in this part of the wall.
  bool contains(double q) const { return from <= q && (q < to || to >= 1.0); }
  bool operator==(const Extent&) const = default;
};

/// Side of the reference line of the wall.
enum class LineSide { inside, outside, both };  // side of the reference line

/// A rubber compound of the tire.
struct Rubber {
  std::string name;       // name in the tire file
  Hyperelastic law;       // elastic law; relaxed if the rubber has Prony terms
  double density = 0.0;   // kg/m^3
  PronyTerms prony = {};  // history of the isochoric stress; empty: elastic
};

/// The part of the section that consists of one rubber. Every element belongs to exactly one
/// region.
struct RubberRegion {
  std::string name;                // name in the tire file
  Extent extent;                   // part of the wall that it occupies
  LineSide side = LineSide::both;  // side of the reference line
  int rubber = 0;                  // index into TireDescription::rubbers
};

/// A ply of cords. `cords` holds the values at the crown.
struct CordPly {
  std::string name;                     // name in the tire file
  Extent extent;                        // part of the wall that it covers
  WallProfile offset = {{0.0}, {0.0}};  // m, distance from the reference line, positive outward
  CordLayer cords;                      // material, spacing, area and angle at the crown
  /// True if the ply was built flat on a drum and lifted: cos(angle) / r and the number of cords
  /// around the tire are then the same at all radii. False: angle and thickness are the same
  /// everywhere.
  bool lifted = false;
  PronyTerms prony = {};  // history of the cords' stress; empty: elastic
};

/// Representation of the cords in the elements.
enum class CordModel {
  rebar,    // cord layers at their true depth inside the elements
  smeared,  // anisotropic St. Venant-Kirchhoff material inside the reference line, for comparison
};

/// Relative meridional length of the elements as a function of the position along the wall, linear
/// between its points. Without points all elements have equal lengths. Short elements belong where
/// the wall bends over a short distance: at the bead and on both sides of a belt's edge.
struct SpacingProfile {
  std::vector<double> position;  // positions of the points, ascending, from 0 to 1
  std::vector<double> length;    // > 0
  bool operator==(const SpacingProfile&) const = default;
};

/// A group of adjacent, equally wide sectors. Groups are counted from the contact upward and are
/// the same on both sides.
struct SectorZone {
  int sectors = 1;     // number of sectors in the zone
  double width = 0.0;  // rad, width of each sector of the zone
  bool operator==(const SectorZone&) const = default;
};

/// Part of the bead's end face that the rim holds: the whole face, or only the part inside or
/// outside the reference line.
enum class BeadClamp { whole, inside, outside };

/// The part of a tire's description that determines the mesh.
struct Section {
  std::vector<MeridianPoint> contour;  // m, +y half of the reference line, from crown to bead
  WallProfile inside, outside;         // thicknesses, > 0
  /// Position up to which the outer face is tread, which may touch the ground.
  double tread_to = 0.5;
  BeadClamp clamp = BeadClamp::whole;  // part of the bead that the rim holds
  int meridional = 29, rows_inside = 1, rows_outside = 1, sectors = 60;  // elements
  SpacingProfile spacing;  // lengths of the elements along the wall
  /// Positions at which the meridional / 2 columns end, from 0 (crown) to 1 (bead). If empty,
  /// `spacing` determines them.
  std::vector<double> columns;
  /// Offsets of the plies on which rows of elements meet, from inside to outside: `rows_inside`
  /// rows lie below the first ply, one row between two neighboring plies, and `rows_outside` above
  /// the last. If empty, rows meet on the reference line. `faces_to` is the position at which the
  /// last of those plies ends that do not reach the bead. Beyond it the faces between rows merge
  /// into equal parts of the wall outside the first face, and then end, so that the sidewall has
  /// one row outside the first face. There the first face is the reference line, or its ply if that
  /// ply reaches the bead.
  std::vector<WallProfile> faces;
  bool first_face_to_bead = false;  // true: the first of these plies reaches the bead
  /// position, 0 to 1, as described above; 0 if all these plies reach the bead
  double faces_to = 0.0;
  /// Number of columns between the crown and the position at which all rows of elements end except
  /// those of the sidewall. Not set if no row ends, because all plies on which rows meet reach the
  /// bead.
  std::optional<double> crown_columns() const;
  /// Positions, ascending, at which plies and rubbers end. The nearest column ends are moved
  /// exactly to these positions. Empty if all columns have the same length.
  std::vector<double> ends;
  /// Share of half the wall's length, beyond `faces_to`, over which the faces between rows merge.
  static constexpr double kFaceTransition = 0.08;
  /// Number of rows of elements through the wall.
  int rows() const { return rows_inside + rows_between() + rows_outside; }
  /// Number of rows between the innermost and the outermost of these plies.
  int rows_between() const { return faces.empty() ? 0 : static_cast<int>(faces.size()) - 1; }
  /// Returns the offset from the reference line, m, at position q, of the lower face of row k (0 to
  /// rows(), fractions allowed).
  double face(double q, double k) const;
  /// Zones of narrow sectors, which are useful at the ends of the contact. Sectors not listed here
  /// share the rest of the ring; if the list is empty, all sectors are equally wide.
  std::vector<SectorZone> sector_zones;
  /// Returns the angles theta of the section planes (mesh.h), with every sector split into
  /// `refinement` parts.
  std::vector<double> sector_planes(int refinement) const;
  /// Returns s in [-1, 1] of the end of column number `column` (0 to meridional, fractions
  /// allowed); |s| is the position.
  double station(double column) const;
  bool operator==(const Section&) const = default;
};

/// The rim as a rigid body without the tire, and the springs that hold its center. Springs are
/// equal along x and z, and about x and z, because the wheel spins.
struct RimBody {
  double mass = 0.0;               // kg, > 0
  double spin_inertia = 0.0;       // kg m^2, about the spin axis, > 0
  double diametral_inertia = 0.0;  // kg m^2, about a diameter through the wheel center, > 0
  double radial_spring = 0.0;      // N/m, along x and z; 0: no spring
  double lateral_spring = 0.0;     // N/m, along y
  double spin_spring = 0.0;        // N m/rad, about y
  double tilt_spring = 0.0;        // N m/rad, about x and z
};

/// A finite-element tire as described in its file. Lengths are in m.
struct TireDescription {
  std::string name;                                // title shown to the user
  std::string size;                                // designation, "225/50R16"
  double pressure = 0.0;                           // Pa, nominal inflation pressure
  Section section;                                 // contour, wall and elements of the section
  std::vector<Rubber> rubbers;                     // every rubber of the tire
  std::vector<RubberRegion> regions;               // regions that together fill the wall
  std::vector<CordPly> plies;                      // plies from the inside to the outside
  CordModel cord_model = CordModel::rebar;         // representation of the cords in the elements
  ElementKind element = ElementKind::solid_shell;  // kind of finite element
  std::optional<RimBody> rim;                      // needed only for tests in which the rim moves
  /// Friction with the ground on which it rolls, for tests that state none.
  std::optional<RollingFriction> friction;
  /// Hz, highest frequency of a tire that is reduced in time (passage/reduced_tire.h); none: it
  /// moves in all its unknowns.
  std::optional<double> reduced_to;
  Place place;  // file and line of the description, for error messages
};

/// Reads the description of a tire (tire_reader.cpp). Throws InputError naming file, line, what was
/// found and what was expected.
TireDescription read_tire(const Node& root);

/// Number of parts into which every element is split around the circumference, along the wall and
/// through it.
struct MeshRefinement {
  int around = 1, along = 1, through = 1;  // numbers of parts, each >= 1
  /// Sets the numbers of parts for the three directions.
  MeshRefinement(int around, int along, int through)
      : around(around), along(along), through(through) {}
  MeshRefinement(int all = 1)
      : MeshRefinement(all, all, all) {}  // NOLINT: a number is a refinement
};

/// Builds the HEX8 mesh of the description. The nodes of a refined mesh lie on the true contour,
/// too; the boundaries of materials, clamped bead and tread remain those of the unrefined elements.
/// Throws InputError naming the element at which the section folds over. See mesh_builder.cpp.
Mesh build_mesh(const TireDescription& tire, MeshRefinement refinement = 1);

/// Builds the materials in the numbering of build_mesh with the same refinement. This is cheap
/// enough to do in every trial. See material_builder.cpp.
Materials build_materials(const TireDescription& tire, MeshRefinement refinement = 1);

/// Returns the Prony terms of these materials, in the same numbering.
LossMaterials build_losses(const TireDescription& tire, MeshRefinement refinement = 1);

/// Returns true if both descriptions give the same mesh, so that results prepared for one can be
/// used for the other.
bool same_mesh(const TireDescription& a, const TireDescription& b);

}  // namespace latsch::fe_tire
