// SPDX-License-Identifier: Apache-2.0
// A car drives straight over a kerb. It starts in equilibrium at its speed, a time `run_in` before
// the front axle reaches position 0 of the road. Aerodynamic loads, or actuators that reproduce
// measured push-rod forces, press it down; a guide keeps it on its line (models/car/car.h).
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "base/result.h"
#include "experiment/rigs/car/car_record.h"
#include "measurement/channels.h"
#include "models/car/aero_loaders.h"
#include "models/road/kerb.h"

namespace latsch::experiment {

/// A quantity over time, piecewise linear; a single value: constant.
struct History {
  std::vector<double> times, values;  // s
  double at(double time) const;
  double slope(double time) const;
  /// Returns the integral from time 0 to `time`.
  double area(double time) const;
  /// Returns the mean over an interval of time, which is exact for the piecewise linear history.
  double mean(double from, double to) const;
};

/// Random deviation of a driver from the prescribed speed and line, by standard deviations. Each
/// deviation is a sum of three sines with random phases and periods of 1, 0.6 and 0.4 of `period`.
struct Wander {
  double speed = 0.0, line = 0.0;  // m/s, m
  double period = 1.0;             // s
  long seed = 1;
};
/// Returns the prescribed value with a deviation, for times from -before to after; the mean over
/// this time is unchanged.
History wandering(
    double asked, double deviation, const Wander& wander, int stream, double before, double after);

/// A road from a file: the position of the middle of the front axle at time 0 in that road, and the
/// direction in which the car drives.
struct FiledRoad {
  std::filesystem::path file;
  std::shared_ptr<const road::Road> road;
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  // m, in the file's axes
  double heading = 0.0;                             // rad, counterclockwise from the file's x axis
  /// true: beyond its edge the road continues as its kind defines
  bool continues = false;
};

struct KerbTest {
  std::optional<road::Kerb> kerb;          // position relative to the front axle at time 0
  std::optional<FiledRoad> filed;          // replaces the kerb
  History speed, line;                     // m/s; m to the left, of the car's middle
  double run_in = 0.2, duration = 0.5;     // s; before and after time 0
  double step = 2e-4, sample_step = 1e-3;  // s
  bool with_area = false;
  std::optional<car::AeroLoaders> loaders;
  Eigen::Vector3d downforce = Eigen::Vector3d::Zero();  // N, constant force of the loaders
  /// Push-rod forces, N, low-passed, from time 0 - run_in on, which the loaders reproduce instead
  /// of applying a constant force.
  std::array<History, 4> pushrods;
  bool follows_pushrods() const { return !pushrods[0].values.empty(); }
};

/// Returns the road of a test; its position 0 is that of the front axle at time 0. A kerb stands on
/// z = 0; in a road from a file, position 0 is the start of the test.
std::unique_ptr<const road::Road> road_of(const KerbTest& test, const car::Car& car);

/// Records the channels of car_record.h; "speed", m/s, and "line", m, of the chassis; "loader_1" ..
/// "loader_3", N; and if the loaders follow push-rod forces "unreachable", N, the part of the four
/// forces that they cannot reproduce. At time 0 the front axle is at position 0. With areas also
/// "area_mean_FL" ..., "area_spread_FL" ... and those of the sum, "area_mean", "area_spread": mean
/// and standard deviation from time 0 on, one value each.
Result<Channels> run(car::Car& car, const KerbTest& test, const CarWatcher& watch = {});

}  // namespace latsch::experiment
