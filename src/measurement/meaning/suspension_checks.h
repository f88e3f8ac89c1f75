// SPDX-License-Identifier: Apache-2.0
// Checks the signs of a K&C table: loads on a wheel and its motion, in iso axes.
//
//   caster over Fx at the contact patch   rises: the patch moves forward, the top rearward
//   caster over My                        falls: My turns the top forward
//   steer over Mz                         rises: both are turned about z
//   toe over Mz                           falls on a left wheel, rises on a right one
//   camber over Fy at the contact patch   falls on a left wheel, rises on a right one
//   camber over Mx                        falls on a left wheel, rises on a right one
//   camber over dz or travel              falls on nearly all suspensions
//   caster of the whole axle              positive on nearly all suspensions
//
// The laws of a moment and the rotation about its axis hold for every elastic suspension, because a
// load does work on the motion that it causes. Those of a force hold where the force at the patch
// turns the wheel carrier about its middle, as with two levels of links. The side is known from the
// name ("toe_left"); without it the last three laws of a moment or force have to agree on a side.
//
// Each slope is a partial one: the other loads of the table are held. A slope counts only if the
// load explains most of what the other loads leave of the motion. A table of which all signs are
// those of the other side cannot be told from that other side; a study compares it with the side of
// its model by side_of_wheel().
#pragma once

#include <string>
#include <vector>

#include "measurement/channels.h"
#include "measurement/meaning/channel_checks.h"

namespace latsch {

/// Returns the ends of names that name a wheel of the car: "_left", "_L", "_FL" ...
const std::vector<std::string>& wheel_ends();

/// True if a channel shows that the wheel rolls, in which case the loads affect it differently.
bool wheel_rolls(const Channels& channels);

/// Checks channels in SI and iso, under our names; gaps are NaN. Returns nothing if the table has
/// no toe, camber, caster or steer, or if a speed or a slip says that the wheel rolls. Every doubt
/// is one of sign.
std::vector<ChannelDoubt> suspension_doubts(const Channels& channels);

/// Returns the side of the car that the slopes of toe and camber indicate: +1 left, -1 right, 0 if
/// no slope is clear or if they disagree. Channels whose name states the side are not used.
int side_of_wheel(const Channels& channels);

}  // namespace latsch
