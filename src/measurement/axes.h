// SPDX-License-Identifier: Apache-2.0
// Axis systems and signs of tire data, and the conversions between them.
//
// Frames, all with the origin as named:
//   W  contact point: z normal of the road, x along wheel plane and road, y in the road
//   H  wheel center: z normal of the road, x as in W, y horizontal
//   C  wheel center: y the spin axis, x as in W, z up in the wheel plane; does not spin
// C is H turned about x by the camber γ.
//
// Signs of the same wheel, one column for each convention:
//
//   |        | iso                   | adapted_sae          | sae (J670e)              |
//   | x y z  | forward, left, up     | forward, right, down | forward, right, down     |
//   | Fx, Mx | along, about x        | as iso               | as iso                   |
//   | Fy     | to the left           | -iso                 | -iso                     |
//   | Fz     | up on the tire        | as iso               | -iso: a load is negative |
//   | My, Mz | about y, z            | -iso                 | -iso                     |
//   | κ      | drives                | as iso               | as iso                   |
//   | α      | tan α = Vy / |Vx|     | tan α = -Vy / |Vx|   | tan α = Vy / |Vx|        |
//   |        | so α > 0 makes Fy < 0 | Fy > 0; as iso       | Fy < 0; -iso             |
//   | γ      | about x: top to the   | as iso               | as iso                   |
//   |        | right, makes Fy < 0   | makes Fy > 0         | makes Fy > 0             |
//   | dx     | along x               | as iso               | as iso                   |
//   | dy, dz | along y, z            | -iso                 | -iso                     |
//   | steer  | about z               | -iso                 | -iso                     |
//   | roll   | about x               | as iso               | as iso                   |
//   | pitch  | about y               | -iso                 | -iso                     |
//   | φt     | as α: with y and its  | as iso               | -iso                     |
//   |        | definition            |                      |                          |
//   | rack   | along y               | -iso                 | -iso                     |
//
// `adams` has the axes in which car models of Adams are built: x rearward, y to the right, z up.
// Quantities along or about x and y are -iso, those along or about z as iso, a load is positive.
// These axes define no slip angle and no turn slip, so only tables without both may be in them.
//
// toe, camber and caster of a suspension, wheel travel, heights of road and posts, the speed of
// rotation (positive rolling forward) and κ are defined without axes: they are the same in all
// conventions. A slope such as dy_by_Fy has the product of both signs. meaning/channel_sense.h has
// every name and derives the signs.
//
// `iso` is ISO 8855, TYDEX and the convention that Magic Formula tools call ISO; inside the program
// everything is iso. Vy is the lateral velocity of the wheel in the axes of its column: with y to
// the right it changes its sign, and if the definition of α does too, α does not [Pacejka 2012,
// appendix 1; SAE J670e]. A file or its user states the convention: signs cannot be guessed.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "measurement/channels.h"

namespace latsch {

enum class AxisConvention { iso, adapted_sae, sae, adams };
enum class AxisFrame { W, H, C };

/// Returns the names by which users choose a convention: "iso", "adapted_sae", "sae", "adams".
const std::vector<std::string>& axis_convention_names();
/// Throws InputError for any other name.
AxisConvention axis_convention_of(std::string_view name);

/// Returns the names by which users choose a frame: "W", "H", "C".
const std::vector<std::string>& axis_frame_names();
std::string name_of(AxisFrame frame);
/// Returns the axis frame with the given name.
AxisFrame axis_frame_of(std::string_view name);

struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // N
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // N m

  bool operator==(const Wrench&) const = default;
};

/// Angles and slip of a rolling wheel.
struct WheelSlip {
  double alpha = 0.0;  // rad
  double gamma = 0.0;  // rad
  double kappa = 0.0;  // (ω Re - Vx) / Vx, -1 locked

  bool operator==(const WheelSlip&) const = default;
};

/// Converts from a convention to iso. Each conversion is its own inverse, so it also converts from
/// iso.
Wrench to_iso(const Wrench& wrench, AxisConvention from);
WheelSlip to_iso(const WheelSlip& slip, AxisConvention from);

/// Converts between frames, in iso: `gamma` is the camber, `loaded_radius` the distance from the
/// wheel center to the contact point along the wheel plane. With A the rotation about x by γ and r
/// the vector from the center to the contact point, in H,
///   F_H = F_W            M_H = M_W + r x F_W        r = R_l (0, sin γ, -cos γ)
///   F_H = A F_C          M_H = A M_C
/// according to the definition of the frames [TYDEX 1.3, axis systems; ISO 8855].
Wrench in_frame(
    const Wrench& wrench, AxisFrame from, AxisFrame to, double gamma, double loaded_radius);

/// Returns the channels of a test in iso, with their slopes. Every channel with a sign in the
/// convention is converted, under any spelling (meaning/channel_words.h); a channel with an unknown
/// name is unchanged.
Channels to_iso(const Channels& channels, AxisConvention from);

}  // namespace latsch
