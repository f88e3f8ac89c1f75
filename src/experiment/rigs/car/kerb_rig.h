// SPDX-License-Identifier: Apache-2.0
// A car drives straight over a kerb. It starts in equilibrium at its speed, `run_in` before the
// front axle meets the road's place 0; aero loads, or loaders that reproduce measured forces of the
// push-rods, press it down; a guide keeps it on its line (models/car/car.h).
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

/// A quantity over time; one value: constant.
struct History {
  std::vector<double> times, values;  // s
  double at(double time) const;
  double slope(double time) const;
  /// From 0 to there.
  double area(double time) const;
  /// Their mean over a stretch of time, by its corners.
  double mean(double from, double to) const;
};

/// How a driver differs from what was asked of him: standard deviations about speed and line, each
/// three sines with random phases and periods of 1, 0.6 and 0.4 of the period.
struct Wander {
  double speed = 0.0, line = 0.0;  // m/s, m
  double period = 1.0;             // s
  long seed = 1;
};
/// What is asked for with that on it, from -before to after; the mean over the time stays.
History wandering(
    double asked, double deviation, const Wander& wander, int stream, double before, double after);

/// A road from a file: where in it the front axle's middle is at time 0, and which way the car
/// drives.
struct FiledRoad {
  std::filesystem::path file;
  std::shared_ptr<const road::Road> road;
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  // m, of the file's axes
  double heading = 0.0;                             // rad, counterclockwise from the file's x
  bool continues = false;                           // beyond its edge, as its kind does
};

struct KerbTest {
  std::optional<road::Kerb> kerb;          // its place counted from where the front axle is at 0
  std::optional<FiledRoad> filed;          // in its place
  History speed, line;                     // m/s; m, of the car's middle, to the left
  double run_in = 0.2, duration = 0.5;     // s; before and from time 0
  double step = 2e-4, sample_step = 1e-3;  // s
  bool with_area = false;
  std::optional<car::AeroLoaders> loaders;
  Eigen::Vector3d downforce = Eigen::Vector3d::Zero();  // N, of the loaders, constant
  /// Or the low-passed push-rod forces they reproduce, N, from time 0 - run_in on.
  std::array<History, 4> pushrods;
  bool follows_pushrods() const { return !pushrods[0].values.empty(); }
};

/// The road of a test, whose place 0 is where the front axle is at time 0. A kerb stands on z = 0,
/// of a file the start of the test is there.
std::unique_ptr<const road::Road> road_of(const KerbTest& test, const car::Car& car);

/// What car_record.h names; "speed", m/s, and "line", m, of the chassis; "loader_1" .. "loader_3",
/// N, and "unreachable", N, what the loaders leave of the four push-rods, where they follow them.
/// Time 0: the front axle at place 0. With areas also "area_mean_FL" ..., "area_spread_FL" ... and
/// those of the sum, "area_mean", "area_spread": mean and standard deviation from time 0 on, one
/// value each.
Result<Channels> run(car::Car& car, const KerbTest& test, const CarWatcher& watch = {});

}  // namespace latsch::experiment
