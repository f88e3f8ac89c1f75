// SPDX-License-Identifier: Apache-2.0
// A tire as its maker describes it: size, contour, thicknesses, cord layers, rubber regions.
//
// The section is built around a reference line, the contour through its wall. Thicknesses are
// measured from this line along its normal, to the inside (toward the inflation gas) and to the
// outside. A point along the wall is given by its `position`: arc length from the crown (0) to the
// bead (1), equal on both sides.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "models/fe_tire/description/contour.h"
#include "models/fe_tire/element/hex8.h"
#include "models/fe_tire/element/materials.h"
#include "models/fe_tire/element/mesh.h"

namespace latsch::fe_tire {

/// A length as a function of the position along the wall: linear between its points, constant
/// beyond them.
struct WallProfile {
  std::vector<double> position;  // ascending, from 0 to 1
  std::vector<double> length;    // m
  /// Returns the length, m, at position q, 0 to 1.
  double at(double q) const;
  bool operator==(const WallProfile&) const = default;
};

/// A stretch of the wall on both sides of the tire: from <= position < to. If `to` is 1, the bead
/// is included.
struct Extent {
  double from = 0.0, to = 1.0;  // position, 0 at the crown, 1 at the bead
  /// True if position q lies in the stretch.
  bool contains(double q) const { return from <= q && (q < to || to >= 1.0); }
  bool operator==(const Extent&) const = default;
};

/// Side of the reference line of the wall.
enum class LineSide { inside, outside, both };  // side of the reference line

/// One rubber of the tire.
struct Rubber {
  std::string name;      // name in the file
  Hyperelastic law;      // its elasticity
  double density = 0.0;  // kg/m^3
};

/// The part of the section that one rubber fills. Every element belongs to exactly one region.
struct RubberRegion {
  std::string name;                // name in the file
  Extent extent;                   // its part of the wall
  LineSide side = LineSide::both;  // side of the reference line
  int rubber = 0;                  // index into TireDescription::rubbers
};

/// One ply. `cords` holds the values at the crown.
struct CordPly {
  std::string name;                     // name in the file
  Extent extent;                        // its part of the wall
  WallProfile offset = {{0.0}, {0.0}};  // distance from the reference line, positive outward
  CordLayer cords;                      // material, spacing, area and angle at the crown
  /// True if the ply is built flat on a drum and lifted: its cords then keep cos(angle) / r and
  /// their number around the tire. Otherwise angle and thickness are the same everywhere.
  bool lifted = false;
};

/// Representation of the cords in the elements.
enum class CordModel {
  rebar,    // cords at their true depth inside the elements
  smeared,  // anisotropic St. Venant-Kirchhoff inside the reference line, for comparison
};

/// Relative meridional length of the elements as a function of the position along the wall, linear
/// between its points. Without points all elements have equal lengths. Short elements belong where
/// the wall bends over a short distance: at the bead and on both sides of a belt's edge.
struct SpacingProfile {
  std::vector<double> position;  // ascending, from 0 to 1
  std::vector<double> length;    // > 0
  bool operator==(const SpacingProfile&) const = default;
};

/// A group of adjacent, equally wide sectors, counted from the contact upward, the same on both
/// sides.
struct SectorZone {
  int sectors = 1;     // number of sectors in the zone
  double width = 0.0;  // rad, width of each sector
  bool operator==(const SectorZone&) const = default;
};

/// Part of the bead's face that the rim holds: the whole, or up to the reference line.
enum class BeadClamp { whole, inside, outside };

/// The part of a tire's description that determines the mesh.
struct Section {
  std::vector<MeridianPoint> contour;  // +y half of the reference line, crown to bead, m
  WallProfile inside, outside;         // thicknesses, > 0
  double tread_to = 0.5;               // position up to which the outer face may touch the ground
  BeadClamp clamp = BeadClamp::whole;  // part of the bead that the rim holds
  int meridional = 29, rows_inside = 1, rows_outside = 1, sectors = 60;  // elements
  SpacingProfile spacing;  // lengths of the elements along the wall
  /// Positions where the meridional / 2 columns end, from 0 (crown) to 1 (bead). Empty: `spacing`
  /// determines them.
  std::vector<double> columns;
  /// Offsets of the plies on which rows of elements meet, from inside to outside: `rows_inside`
  /// rows lie below the first, one between two neighbors, `rows_outside` above the last. Empty:
  /// rows meet on the reference line. `faces_to` is the position where the last of these plies ends
  /// that does not reach the bead. Behind it the faces blend into equal parts of the wall outside
  /// the first face and end, so that the sidewall has one row outside the first face. There the
  /// first face is the reference line, or its ply if that ply reaches the bead.
  std::vector<WallProfile> faces;
  bool first_face_to_bead = false;  // true: the first of these plies reaches the bead
  double faces_to = 0.0;            // position, 0 to 1; 0 if all these plies reach the bead
  /// Number of columns from the crown to where all rows but those of the sidewall end; none if the
  /// plies reach the bead.
  std::optional<double> crown_columns() const;
  /// Positions, ascending, where plies and rubbers end. The nearest ends of columns are moved
  /// exactly there. Empty if all columns are alike.
  std::vector<double> ends;
  /// Share of the wall's half length behind `faces_to` over which the faces blend.
  static constexpr double kFaceTransition = 0.08;
  /// Number of rows of elements through the wall.
  int rows() const { return rows_inside + rows_between() + rows_outside; }
  /// Number of rows between the faces.
  int rows_between() const { return faces.empty() ? 0 : static_cast<int>(faces.size()) - 1; }
  /// Offset at position q of the face below row k (0 to rows(), fractions allowed), m.
  double face(double q, double k) const;
  /// Zones of sectors. Narrow sectors belong where the contact ends. Sectors not named here share
  /// the rest of the ring; if none is named, all are equally wide.
  std::vector<SectorZone> sector_zones;
  /// Returns theta of mesh.h with every sector split into `refinement` parts.
  std::vector<double> sector_planes(int refinement) const;
  /// Returns s in [-1, 1] of the end of column `column` (0 to meridional, fractions allowed). |s|
  /// is the position.
  double station(double column) const;
  bool operator==(const Section&) const = default;
};

/// The rim as a rigid body, without the tire, and the springs that hold its center. They are alike
/// along x and z, and about both, because the wheel spins.
struct RimBody {
  double mass = 0.0;               // kg, > 0
  double spin_inertia = 0.0;       // kg m^2, about the spin axis, > 0
  double diametral_inertia = 0.0;  // kg m^2, about a diameter through the wheel's center, > 0
  double radial_spring = 0.0;      // N/m, along x and z; 0: none
  double lateral_spring = 0.0;     // N/m, along y
  double spin_spring = 0.0;        // N m/rad, about y
  double tilt_spring = 0.0;        // N m/rad, about x and z
};

/// A finite-element tire as its file states it. Lengths are in m.
struct TireDescription {
  std::string name;                                // for people
  std::string size;                                // designation, "225/50R16"
  double pressure = 0.0;                           // Pa, nominal
  Section section;                                 // contour, wall and elements
  std::vector<Rubber> rubbers;                     // every rubber of the tire
  std::vector<RubberRegion> regions;               // they fill the wall
  std::vector<CordPly> plies;                      // listed from the inside to the outside
  CordModel cord_model = CordModel::rebar;         // representation of the cords
  ElementKind element = ElementKind::solid_shell;  // kind of finite element
  std::optional<RimBody> rim;                      // needed only if the rim moves
  Place place;  // place of the description in its file, for complaints
};

/// Reads a tire file (tire_reader.cpp). Throws InputError naming file, line, found and expected.
TireDescription read_tire(const Node& root);

/// Number of parts into which every element is split around the circumference, along and through
/// the wall.
struct MeshRefinement {
  int around = 1, along = 1, through = 1;  // parts of every element, each >= 1
  /// One number for each direction.
  MeshRefinement(int around, int along, int through)
      : around(around), along(along), through(through) {}
  MeshRefinement(int all = 1)
      : MeshRefinement(all, all, all) {}  // NOLINT: a number is a refinement
};

/// Builds the HEX8 mesh of the description. A refinement has its nodes on the true contour;
/// materials, clamped boundary and tread boundary stay those of the unrefined elements. Throws
/// InputError naming the element at which the section folds over. See mesh_builder.cpp.
Mesh build_mesh(const TireDescription& tire, MeshRefinement refinement = 1);

/// Builds the materials in the numbering of build_mesh with the same refinement. Cheap enough for
/// every trial. See material_builder.cpp.
Materials build_materials(const TireDescription& tire, MeshRefinement refinement = 1);

/// True if both descriptions give the same mesh, so that results prepared for one serve the other.
bool same_mesh(const TireDescription& a, const TireDescription& b);

}  // namespace latsch::fe_tire
