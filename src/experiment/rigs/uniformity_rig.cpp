// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/uniformity_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <numeric>
#include <vector>

#include "experiment/rigs/drum_rig.h"
#include "experiment/rigs/duration_limit.h"
#include "experiment/rigs/steady_rolling.h"
#include "models/road/drum_road.h"
#include "models/road/plane_road.h"
#include "models/tire/free_wheel.h"

namespace latsch::experiment {
namespace {

constexpr double kRunIn = 1.5;          // turns before the first that may be averaged
constexpr double kAxleFollows = 20e-3;  // s, time constant with which the axle follows the load
constexpr double kLeastPressed = 1e-3;  // m
constexpr int kAngles = 720;            // positions in a turn at which its peaks are searched

std::unique_ptr<road::Road> road_of(const UniformityTest& test, double way) {
  if (test.diameter > 0.0)
    return std::make_unique<road::DrumRoad>(
        road::DrumRoad::Settings{.diameter = test.diameter, .surface = way * test.speed});
  return std::make_unique<road::PlaneRoad>(road::PlaneRoad::Settings{.belt = way * test.speed});
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Forces and height over a turn.
struct Turn {
  std::vector<double> Fx, Fy, Fz, height;
};

/// The wheel on the machine, rolling forward (`way` = 1) or backward (-1).
class Machine {
 public:
  Machine(Tire& tire, const UniformityTest& test, double way, double height)
      : tire_(tire), test_(test), road_(road_of(test, way)) {
    deflection_ = std::max(tire.free_radius() - height, kLeastPressed);
    motion_.center.z() = height;
    motion_.spin_rate = way * test.speed / (tire.free_radius() - deflection_ / 3.0);
  }

  /// Starts at rest; with `follow` the axle follows the load.
  Status start(bool follow) {
    const auto hub = tire_.settle(motion_, *road_, 0.0);
    if (!hub) return hub.failure();
    wheel_.spin = {.inertia = test_.wheel_inertia,
                   .place = motion_.spin,
                   .rate = motion_.spin_rate,
                   .acceleration = hub->moment.y() / test_.wheel_inertia};
    if (!follow) return {};
    const double load = test_.load, c = kAxleFollows * load / deflection_;
    wheel_.height = {.place = motion_.center.z(),
                     .rate = (hub->force.z() - load) / c,
                     .push = [c, load](double, double rate) -> Push {
                       return {-load - c * rate, -c};
                     }};
    return {};
  }

  /// Records the first turn in which forces vary as in the turn before: the wheel has found its
  /// speed and swings no more.
  Result<Turn> turn() {
    if (const Status done = roll(kRunIn, nullptr); !done) return done.failure();
    const double most = kFarthestToSteady / (2.0 * std::numbers::pi * tire_.free_radius());
    Turn before;
    for (double turns = 1.0; turns <= most; ++turns) {
      Turn turn;
      if (const Status done = roll(1.0, &turn); !done) return done.failure();
      if (is_repeated(before, turn)) return turn;
      before = std::move(turn);
    }
    return Failure{
        fmt::format("forces still differ from turn to turn after {:g} m", kFarthestToSteady)};
  }

 private:
  /// True if the ranges of the forces are equal to those of the previous turn.
  bool is_repeated(const Turn& before, const Turn& now) const {
    constexpr double kShare = 1e-3, kLeast = 2e-6;  // shares of the range and of the load
    const auto range = [](const std::vector<double>& force) {
      const auto [low, high] = std::ranges::minmax_element(force);
      return *high - *low;
    };
    const auto same = [&](const std::vector<double>& a, const std::vector<double>& b) {
      return !a.empty() && std::abs(range(a) - range(b)) <= kShare * range(b) + kLeast * test_.load;
    };
    return same(before.Fx, now.Fx) && same(before.Fy, now.Fy) && same(before.Fz, now.Fz);
  }

  Status roll(double turns, Turn* seen) {
    const double period = 2.0 * std::numbers::pi / std::abs(motion_.spin_rate);
    const double least = std::max(period / test_.step, 2.0 * test_.harmonics + 1.0);
    const long count = std::lround(std::ceil(turns * least));
    const double h = turns * period / static_cast<double>(count);
    for (long i = 0; i < count; ++i) {
      time_ += h;
      const auto hub = tire_.advance_free(motion_, wheel_, *road_, time_, h);
      if (!hub) return hub.failure();
      if (!seen) continue;
      seen->Fx.push_back(hub->force.x());
      seen->Fy.push_back(hub->force.y());
      seen->Fz.push_back(hub->force.z());
      seen->height.push_back(motion_.center.z());
    }
    return {};
  }

  Tire& tire_;
  const UniformityTest& test_;
  std::unique_ptr<road::Road> road_;
  WheelMotion motion_;
  FreeWheel wheel_;
  double deflection_ = 0.0, time_ = 0.0;
};

/// Returns the height of the wheel center at which the rolling tire carries the load, averaged over
/// a turn.
Result<double> rolling_height(Tire& tire, const UniformityTest& test) {
  const auto standing =
      height_under_load(tire, *road_of(test, 0.0), Eigen::Matrix3d::Identity(), test.load);
  if (!standing) return standing;
  Machine machine(tire, test, 1.0, *standing);
  if (const Status done = machine.start(true); !done) return done.failure();
  const auto turn = machine.turn();
  if (!turn) return turn.failure();
  return mean(turn->height);
}

Result<Turn> held(Tire& tire, const UniformityTest& test, double way, double height) {
  Machine machine(tire, test, way, height);
  if (const Status done = machine.start(false); !done) return done.failure();
  return machine.turn();
}

Result<UniformityRecord> record(Tire& tire, const UniformityTest& test) {
  const auto height = rolling_height(tire, test);
  if (!height) return height.failure();
  const auto forward = held(tire, test, 1.0, *height);
  if (!forward) return forward.failure();
  const auto back = held(tire, test, -1.0, *height);
  if (!back) return back.failure();
  const double F = mean(forward->Fy), B = mean(back->Fy);
  return UniformityRecord{.load = mean(forward->Fz),
                          .radial = variation_of(forward->Fz, test.harmonics),
                          .lateral = variation_of(forward->Fy, test.harmonics),
                          .tangential = variation_of(forward->Fx, test.harmonics),
                          .conicity = 0.5 * (F + B),
                          .ply_steer = 0.5 * (F - B)};
}

}  // namespace

UniformityTest read_uniformity_test(const Node& root, const MeasuredConditions& measured) {
  UniformityTest test;
  const auto load = find_measured(root, "load");
  test.load = load ? measured_mean(*load, {"Fz", "N", true, "W"}, measured)
                   : root.quantity("load", "N", Range::positive());
  test.pressure = read_pressure(root, measured);
  test.diameter = root.quantity("drum_diameter", "m", Range::between(0.2, 100.0), 0.0);
  test.speed = root.quantity("speed", "m/s", Range::between(0.5, 100.0), test.speed);
  test.wheel_inertia =
      root.quantity("wheel_inertia", "kg m^2", Range::positive(), test.wheel_inertia);
  test.harmonics = static_cast<int>(root.integer("harmonics", 1, 50, test.harmonics));
  const double longest = kFarthestStep / test.speed;
  test.step =
      root.quantity("step", "s", Range::between(kShortestStep, 0.01), std::min(test.step, longest));
  check_step(root, test.speed, test.step);
  return test;
}

ForceVariation variation_of(const std::vector<double>& values, int harmonics) {
  using std::numbers::pi;
  const double count = static_cast<double>(values.size()), middle = mean(values);
  std::vector<std::complex<double>> of_order;
  for (int n = 1; n <= harmonics; ++n) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i)
      sum += (values[i] - middle) *
             std::polar(2.0 / count, -2.0 * pi * n * static_cast<double>(i) / count);
    of_order.push_back(sum);
  }
  double low = 0.0, high = 0.0;
  for (int i = 0; i < kAngles; ++i) {
    double sum = 0.0;
    for (int n = 1; n <= harmonics; ++n)
      sum += std::real(of_order[static_cast<std::size_t>(n - 1)] *
                       std::polar(1.0, 2.0 * pi * n * i / kAngles));
    low = i == 0 ? sum : std::min(low, sum);
    high = i == 0 ? sum : std::max(high, sum);
  }
  return {high - low, 2.0 * std::abs(of_order.front())};
}

Result<UniformityRecord> run(Tire& tire, const UniformityTest& test) {
  auto found = record(tire, test);
  if (!found) return Failure{"on the uniformity machine: " + found.failure().reason};
  return found;
}

}  // namespace latsch::experiment
