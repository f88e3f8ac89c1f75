// SPDX-License-Identifier: Apache-2.0
// Bushing property files of Adams (.bus), in TeimOrbit form:
//
//   [MDI_HEADER]  FILE_TYPE = 'bus'
//   [UNITS]       LENGTH, ANGLE, FORCE, MASS, TIME
//   [DAMPING]     FX_DAMPING ... TZ_DAMPING       force over velocity, torque over angular velocity
//   [FX_CURVE]    rows of deflection and force; likewise FY_CURVE, FZ_CURVE
//   [TX_CURVE]    rows of angle and torque; likewise TY_CURVE, TZ_CURVE
//
// Torques are in FORCE times LENGTH. A curve rises: its force is the resisting one. A straight
// curve through the origin becomes a stiffness, any other a ForceCurve as an elastic part of its
// axis, which differs from Adams' curve between the points (multibody/force_curve.h against Akima).
// The first column of a curve is the deflection. Other sections of such a file are left out and
// named. A file without LENGTH, FORCE or, if its dampings are not 0, TIME is refused; ANGLE is
// needed for the torques.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "formats/text/teim_orbit.h"
#include "measurement/ledger.h"
#include "models/multibody/bushing.h"

namespace latsch::formats {

struct BusFile {
  multibody::BushingParameters bushing;
  std::vector<TeimOrbitPart> unused;  // parts of the file that have no meaning here
  /// Rows for each curve, damping and unit, and for each unused part. Doubts for each unused part
  /// that other programs use, and for curves that have a force at rest, fall in between, or extend
  /// farther than the deflection of any bushing.
  Ledger ledger;
};

/// Throws InputError naming file and line: a missing section, a missing or unknown unit, fewer than
/// two points, a deflection that does not rise, a force that falls on the whole, negative damping.
BusFile read_bus_file(const std::filesystem::path& file);
BusFile bus_file_from(const TeimOrbit& file);

/// Returns the text of a .bus file in SI units; reading it gives the same bushing to the last bit.
/// Throws InputError, whose message begins with `name`, if the bushing has parts that are no curves
/// and therefore cannot be expressed.
std::string bus_text(const multibody::BushingParameters& bushing, const std::string& name);

}  // namespace latsch::formats
