// SPDX-License-Identifier: Apache-2.0
// Derives the positive direction of a channel from its name, and with it the channel's sign in a
// convention of axes.
//
// A convention is three axes. Forces, displacements and velocities are vectors along them, moments
// and rotations vectors about them. With the rotation matrix R, whose rows are the axes of the
// convention in those of iso, the signs are
//
//   along axis i    R_ii          about axis i    det(R) R_ii          R = diag(1, -1, -1)
//
// for both adapted_sae and sae, which reverse y and z, and R = diag(-1, -1, 1) for adams. Three
// quantities do not follow from the axes alone; the convention defines them in addition (axes.h):
// the load, which adapted_sae keeps positive; slip angle and turn slip, whose definition
// adapted_sae reverses together with y and adams lacks.
//
// Quantities that are defined without axes are the same in every convention: kappa, pressure,
// radii, temperatures, the speed of rotation (positive rolling forward), toe (front inboard),
// camber of a suspension (top outboard), caster (top rearward), travel, heights of road and posts
// (upward). A slope "dy_by_Fy" has the product of both signs, and so has a force over the load,
// such as NFX. A channel with an unknown name keeps its sign, and the ledger says so.
#pragma once

#include <string_view>

#include "measurement/axes.h"

namespace latsch {

enum class ChannelSense {
  unknown,
  same,
  along_x,
  along_y,
  along_z,
  about_x,
  about_y,
  about_z,
  load,  // along z, a load on the tire
  slip,  // slip angle, turn slip
};

/// Sense of a channel, or of its slope by another channel.
struct ChannelSenses {
  ChannelSense of = ChannelSense::unknown, by = ChannelSense::same;
  bool is_known() const { return of != ChannelSense::unknown && by != ChannelSense::unknown; }
};

/// Accepts any spelling (channel_words.h); "dz_L_by_Fz_R" is a slope.
ChannelSenses channel_senses(std::string_view name);

/// Returns +1 or -1; +1 for an unknown sense.
double sign_to_iso(ChannelSense sense, AxisConvention from);
double sign_to_iso(const ChannelSenses& senses, AxisConvention from);

/// Returns the axes of a convention in those of iso, one in each row.
Eigen::Matrix3d axes_of(AxisConvention convention);

}  // namespace latsch
