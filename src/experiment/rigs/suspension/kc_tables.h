// SPDX-License-Identifier: Apache-2.0
// Kinematics and compliance (K&C) of a suspension as tables, for programs that drive a car by such
// tables. The file has one corner; the other wheel of the axle is its mirror image.
//
//   kinematics   both wheels over travel and rack: positions, angles, their derivatives
//   roll         both wheels in opposite travel, rack 0: roll, roll center
//   springs      one wheel over travel, rack 0: length and motion ratio of the spring, rates
//   compliance   12 x 12 over travel, rack 0: motion of both contact points by loads there
//
// Axes, signs and units: ISO 8855 (x forward, y left, z up), SI. Travel is that of the wheel center
// upward in the chassis. Kinematics are those of rigid links. Compliance is that of the bushings
// about the position, in which they are without load, with a rigid bar in place of the spring
// (models/suspension/moved_corner.h). Nothing couples the wheels of a corner's file: the blocks of
// one wheel by the other's loads are zero.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "measurement/channels.h"
#include "models/suspension/suspension_reader.h"

namespace latsch::experiment {

/// Range of the tables: from -travel to travel and from -rack to rack, m, in equal steps. A rack of
/// 0 gives the straight wheel alone. Both numbers of positions are odd, so that one is the middle.
struct KcRange {
  double travel = 0.05, rack = 0.02;  // m
  int travel_positions = 21, rack_positions = 9;
};

struct KcTable {
  Channels columns;                // SI
  std::vector<std::string> words;  // meaning and positive direction of each column
};

struct KcTables {
  std::vector<double> travel, rack;   // m, positions, ascending
  KcTable kinematics;                 // rows: all racks of the first travel, then of the next
  KcTable roll, springs;              // rows: one for each travel
  std::optional<KcTable> compliance;  // not set for a corner without bushings
  /// force in the spring at rest, N, compression positive; not set if the spring is not known
  std::optional<double> spring_force;
};

/// Returns a Failure that names the link or rod that ends the motion.
Result<KcTables> kc_tables(const suspension::SuspensionCorner& corner, const KcRange& range);

}  // namespace latsch::experiment
