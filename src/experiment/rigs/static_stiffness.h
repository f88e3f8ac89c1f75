// SPDX-License-Identifier: Apache-2.0
// Standing tire: force over deflection, on flat ground or on a cleat below its middle; stiffness
// along, across and about the vertical under a load on flat ground. Of any tire.
//
//   kind = "static_stiffness"
//   deflections = ["10 mm", "20 mm"] # channels "deflection" and "force"; as they were measured:
//                                    # {from = "measurement.pressed"}
//   load = "4 kN"                    # in its place: under the load, a channel of one value for;
//                                    # {from = "measurement.pulled"}: the mean of its Fz
//   directions = ["vertical", "longitudinal", "lateral", "torsional"]  # default: all
//   pressure = "2.6 bar"             # the tire's own unless given (inflation.h)
//   camber = "2 deg"                 # about x, top to the right; default 0
//   friction = 0.8                   # of a finite-element tire with the ground, 0 unless given;
//                                    # others have theirs in their own files
//   travel = "1 mm"                  # over which a stiffness is taken, this unless given
//   twist = "1 mrad"                 # and the torsional one, 0.001 rad unless given
//   [cleat]                          # on which deflections are pressed; none: flat ground
//   height = "20 mm"
//   length = "50 mm"
//   bevel = "5 mm"                   # of its upper edges, default 0
//   angle = "90 deg"                 # against the axle, default 0: across the tread
//
// The axle is moved slowly from where the tire stands and held; the stiffness is the change of the
// hub's force over the way, with the friction of the patch in it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/result.h"
#include "experiment/rigs/cleat.h"
#include "experiment/rigs/inflation.h"
#include "measurement/channels.h"
#include "models/tire/tire.h"

namespace latsch::fe_tire {
class FeTire;
class TireSlopes;
}  // namespace latsch::fe_tire

namespace latsch::experiment {

/// N, vertical force at a deflection, m: how deep the free tire would stand in the ground below its
/// middle, which is the top of the cleat where there is one.
Result<double> load_at(Tire& tire, double deflection, const std::optional<Cleat>& cleat = {});

enum class Direction { vertical, longitudinal, lateral, torsional };
inline constexpr std::array<const char*, 4> kDirections = {
    "vertical", "longitudinal", "lateral", "torsional"};
const char* name_of(Direction direction);
const char* unit_of(Direction direction);

struct StiffnessTest {
  Direction direction = Direction::vertical;
  double load = 4000.0;  // N
  double camber = 0.0;   // rad
  double travel = 1e-3;  // m; of the torsional test rad
  double ramp = 0.3;     // s, slow against every mode of a tire
  double hold = 0.1;     // s, for what moved to come to rest
  double step = 1e-3;    // s
};

/// N/m, of the torsional test N m/rad.
Result<double> stiffness(Tire& tire, const StiffnessTest& test);

/// The whole test.
struct StandingTest {
  std::vector<double> deflections = {};  // m, on the cleat
  std::optional<Cleat> cleat = {};
  double load = 0.0;  // N
  std::vector<Direction> directions = {};
  double camber = 0.0;                 // rad
  double travel = 1e-3, twist = 1e-3;  // m, rad: the patch hardly slides
  std::optional<double> friction = {};
  Inflation pressure = {};
};

/// Its channels: force over deflection, and a stiffness a direction.
Channels standing_channels(const StandingTest& test,
                           const std::vector<double>& forces,
                           const std::vector<double>& stiffnesses);
Result<Channels> stand(Tire& tire, const StandingTest& test);
/// The finite-element tire, from equilibrium to equilibrium. InputError where it would slide away.
/// With `slopes` those of all channels: upright on flat ground without friction.
Result<Channels> stand(fe_tire::FeTire& tire,
                       double own_pressure,
                       const StandingTest& test,
                       fe_tire::TireSlopes* slopes = nullptr);

}  // namespace latsch::experiment
