// SPDX-License-Identifier: Apache-2.0
// The footprint of a tire that stands on flat ground.
//
// Channels, one value for each state in their order: "load" (N), "deflection", "length", "width"
// (m, the largest ones), "area" (m^2, including grooves), "mean_pressure" (Pa, load over area),
// "peak_pressure" (Pa, the highest reading of a sensor at any position) and "grip_level" (1, the
// used share of the friction: the shear forces over the largest possible ones). For `sensors`, all
// of one state and then those of the next: "pressure" (Pa), "sensor_x", "sensor_y" (m). The keys
// are in experiment/tests/keys/footprint_keys.cpp.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/document.h"
#include "base/result.h"
#include "experiment/rigs/inflation.h"
#include "experiment/rigs/measured_conditions.h"
#include "measurement/channels.h"
#include "models/tire/tire.h"

namespace latsch::experiment {

struct FootprintTest {
  std::vector<double> loads;        // N; either loads or deflections are given
  std::vector<double> deflections;  // m
  double camber = 0.0;              // rad
  Inflation pressure = {};
  std::optional<double> friction = {};        // none: the tire's own
  double sensor = 15e-3;                      // m, side of the square
  std::vector<Eigen::Vector2d> sensors = {};  // m
  struct Elements {
    double around, across;  // m
  };
  std::optional<Elements> elements = {};  // largest ones; none: the tire's default
};

/// Reads a footprint test. Throws InputError, which names file, line and key, also for unknown
/// keys.
FootprintTest read_footprint_test(const Node& root, const MeasuredConditions& measured = {});

struct StandingFootprint {
  double deflection = 0.0;  // m
  Footprint footprint;
};

/// Returns a Failure if this kind of tire does not compute its footprint.
Result<std::vector<StandingFootprint>> footprints(Tire& tire, const FootprintTest& test);

/// Returns the recorded channels of the states of a test.
Channels to_channels(const FootprintTest& test, const std::vector<StandingFootprint>& states);

}  // namespace latsch::experiment
