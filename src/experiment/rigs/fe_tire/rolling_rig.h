// SPDX-License-Identifier: Apache-2.0
// Virtual flat track for the finite-element tire: steady states of rolling
// (rolling/rolling_tire.h).
//
// Every state has its load, speed, slip angle, camber and turn slip. Without a slip kappa the wheel
// rolls freely: no moment about its spin axis. A slip kappa is that against the free wheel at the
// same load, speed, camber and pressure, upright in heading: kappa = Omega R_e/V_x - 1, where R_e =
// V_x/Omega of that free wheel. On ground without friction a wheel spins with V_x over its loaded
// radius plus two thirds of its deflection.
//
// A steady state does not depend on the path to it. The rig begins with free rolling and goes on to
// the state nearest to one that is known, so that no step is longer than the table demands.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "experiment/rigs/fe_rolling/ground_friction.h"
#include "experiment/rigs/fe_tire/channel_slopes.h"
#include "experiment/rigs/fe_tire/tire_rig.h"
#include "experiment/rigs/inflation.h"
#include "models/fe_tire/rolling/rolling_case.h"
#include "models/fe_tire/rolling/rolling_losses.h"
#include "models/fe_tire/rolling/rolling_tire.h"

namespace latsch::experiment {

/// A state of the wheel, in W (ISO).
struct RollingRow {
  double load = 0.0;                    // N
  double speed = 0.0;                   // m/s along the heading, V_x
  std::optional<double> kappa = {};     // none: free rolling
  double alpha = 0.0, camber = 0.0;     // rad
  double turn_slip = 0.0;               // 1/m
  std::optional<double> pressure = {};  // Pa; none: that of the test
};

struct RollingTest {
  Inflation pressure = {};
  /// Friction with the ground; none: that of the tire's file, else kAssumedFriction.
  std::optional<double> friction = {};
  double drum_radius = 0.0;  // m, of the drum on which the wheel stands; 0: flat ground
  std::vector<RollingRow> rows;
};

/// A state of the tire on the flat track.
struct RolledState {
  fe_tire::RollingState state;
  double kappa = 0.0;             // against the free wheel
  double effective_radius = 0.0;  // m, V_x/Omega of the free wheel
  fe_tire::RollingLosses losses;  // powers that rubber and cords lose
  /// Derivatives by every parameter, if they were asked for.
  std::vector<fe_tire::RollingRates> rates = {};
  std::vector<double> effective_radius_rates = {};  // m per unit
};

/// Returns the highest speed of the states, m/s.
double fastest(const std::vector<RollingRow>& rows);
/// Returns the highest pressure of the states, Pa; `own` is that of the tire.
double highest_pressure(const RollingTest& test, double own);

/// Extents of the patch, and the share of the load on points that stick.
struct RollingPatch {
  double length = 0.0, width = 0.0;  // m
  double sticking = 0.0;
};
RollingPatch patch_of(const std::vector<fe_tire::RollingPatchPoint>& points);
RollingPatch patch_of(const fe_tire::RollingState& state);

/// Channels of the test, one value for each state: the states "alpha" (rad), "kappa" (against the
/// free wheel), "gamma" (rad), "phit" (1/m), "Vx" (m/s), then forces and moments in W, "omega"
/// (rad/s), "R_e" (V_x/omega, m), "R_l" (m), "drive" (N m, moment of the drive about the spin
/// axis), "loss_rubber", "loss_cords", "loss_friction" (W, powers that the rubbers' and the cords'
/// histories and sliding lose), "rolling_resistance" (N, their sum over the speed), "sticking"
/// (share of the load on points that stick), "length" and "width" (m) of the patch, and "balance"
/// (W, power of drive and hub minus these losses, an error of the discretization). A channel
/// "loss.rubber.NAME" or "loss.layer.NAME" (W) follows for every owner.
Channels channels_of(const std::vector<RolledState>& states,
                     const std::vector<fe_tire::LossMaterials::Owner>& owners);

/// Receives all states of a test and the index of the one that was found last.
using RollingProgress = std::function<void(const std::vector<RolledState>&, std::size_t)>;

/// Rolls the tire through the states, and returns them in the order of the test. A Failure names
/// the state that was not found. States are found in another order than that of the test;
/// `found` is called after each. With `slopes`, states have their rates (known_rates()).
Result<std::vector<RolledState>> roll_states(TireRig& rig,
                                             const RollingTest& test,
                                             const RollingProgress& found = {},
                                             fe_tire::TireSlopes* slopes = nullptr);
/// Returns the slopes if those of a rolling tire are known, else nullptr: rubber and cords have to
/// be elastic, the ground needs friction, and no parameter may change the shape.
fe_tire::TireSlopes* known_rates(const TireRig& rig,
                                 const RollingTest& test,
                                 fe_tire::TireSlopes* slopes);
/// Returns the slopes of channels that follow from the rates of the states: "Fx" .. "Mz", "omega"
/// and "R_l"; those of Fy, Mx and Mz times `side`. Without rates there are none.
ChannelSlopes slopes_of(const std::vector<RolledState>& states, double side = 1.0);
/// True for the channels of states that have slopes where rates are known.
bool has_rolling_slopes(const std::string& channel);
/// Returns the slopes of one channel, of which `slope(state, parameter)` is a value.
Eigen::MatrixXd slopes_by(const std::vector<RolledState>& states,
                          const std::function<double(const RolledState&, std::size_t)>& slope);
/// Rolls the tire through the states. If the tire has no Prony terms, rolling resistance is that of
/// friction alone.
Result<Channels> roll(TireRig& rig, const RollingTest& test, fe_tire::TireSlopes* slopes = nullptr);

}  // namespace latsch::experiment
