// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/car/four_post_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiment/rigs/car/car_record.h"
#include "models/road/posts_road.h"

namespace latsch::experiment {

std::array<double, 4> signs_of(PostMode mode) {
  switch (mode) {
    case PostMode::heave:
      return {1.0, 1.0, 1.0, 1.0};
    case PostMode::pitch:
      return {1.0, 1.0, -1.0, -1.0};
    case PostMode::roll:
      return {1.0, -1.0, 1.0, -1.0};
    case PostMode::warp:
      return {1.0, -1.0, -1.0, 1.0};
  }
  return {};
}

namespace {

constexpr double kStart = 0.1, kStop = 0.05;  // shares of a sweep's duration

/// Returns the growth of the logarithm of the sweep's frequency, 1/s.
double growth_of(const PostSweep& sweep) {
  return std::log(sweep.to / sweep.from) / ((1.0 - kStart - kStop) * sweep.duration);
}

}  // namespace

double frequency_at(const PostSweep& sweep, double time) {
  return sweep.from * std::exp(growth_of(sweep) * (time - kStart * sweep.duration));
}

FourPostTest sweep_test(const PostSweep& sweep, double sample_step) {
  FourPostTest test;
  test.sample_step = sample_step;
  const double grows = growth_of(sweep);
  const double first = frequency_at(sweep, 0.0);
  const long count = std::lround(sweep.duration / sample_step) + 1;
  const std::array<double, 4> sign = signs_of(sweep.mode);
  for (long i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) * sample_step;
    const double f = frequency_at(sweep, t);
    const double phase = 2.0 * std::numbers::pi * (f - first) / grows;
    const double fade =
        std::clamp(std::min(t / kStart, (sweep.duration - t) / kStop) / sweep.duration, 0.0, 1.0);
    const double amplitude =
        std::min(sweep.amplitude, sweep.velocity / (2.0 * std::numbers::pi * f));
    const double h = fade * fade * (3.0 - 2.0 * fade) * amplitude * std::sin(phase);
    test.times.push_back(t);
    for (std::size_t post = 0; post < 4; ++post) test.heights[post].push_back(sign[post] * h);
  }
  return test;
}

Result<Channels> run(car::Car& car, const FourPostTest& test, const CarWatcher& watch) {
  road::PostsRoad::Settings settings;
  const auto& corners = car.parts().corners;
  settings.x = 0.5 * (corners[car::kFL].wheel_center.x() + corners[car::kRL].wheel_center.x());
  settings.times = test.times;
  settings.heights = test.heights;
  const road::PostsRoad road(settings);
  const car::CarInputs inputs;
  auto state = car.settle(road, 0.0, inputs);
  if (!state) return Failure{"on the four posts: " + state.failure().reason};
  CarRecord record(car, *state, false);
  const long every = std::lround(test.sample_step / test.step),
             steps = std::lround((test.times.back() - test.times.front() + test.still) / test.step);
  std::array<std::vector<double>, 4> posts;
  const auto sample = [&] {
    const double time = state->time();
    record.sample(*state, inputs, time);
    if (watch) watch(car, *state, road, time);
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector3d& place = corners[i].wheel_center;
      posts[i].push_back(road.height(place.x(), place.y(), time));
    }
  };
  sample();
  for (long i = 1; i <= steps; ++i) {
    if (const auto done = car.advance(*state, test.step, road, inputs); !done)
      return Failure{"on the four posts: " + done.failure().reason};
    if (i % every == 0) sample();
  }
  Channels channels = record.channels();
  const auto names = of_corners("post");
  for (std::size_t i = 0; i < 4; ++i) channels.add({names[i], "m", posts[i]});
  return channels;
}

Result<BothWays> run_both_ways(car::Car& car, const FourPostTest& test) {
  FourPostTest way = test;
  way.still = kStill;
  const auto up = run(car, way);
  if (!up) return up.failure();
  for (std::vector<double>& heights : way.heights) {
    const double start = heights.front();
    for (double& height : heights) height = 2.0 * start - height;
  }
  const auto down = run(car, way);
  if (!down) return Failure{"upside down " + down.failure().reason};
  return BothWays{*up, *down};
}

}  // namespace latsch::experiment
