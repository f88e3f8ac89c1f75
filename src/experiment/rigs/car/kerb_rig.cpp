// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/car/kerb_rig.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "experiment/rigs/car/car_record.h"
#include "models/road/placed_road.h"
#include "models/road/plane_road.h"

namespace latsch::experiment {
namespace {

/// Returns the index, 0 .. n - 2, of the interval between two times that contains `time`.
std::size_t interval_of(const std::vector<double>& times, double time) {
  const auto above = std::upper_bound(times.begin() + 1, times.end() - 1, time);
  return static_cast<std::size_t>(above - times.begin()) - 1;
}

}  // namespace

double History::at(double time) const {
  if (values.size() == 1) return values[0];
  const std::size_t i = interval_of(times, time);
  const double part = std::clamp((time - times[i]) / (times[i + 1] - times[i]), 0.0, 1.0);
  return values[i] + part * (values[i + 1] - values[i]);
}

double History::slope(double time) const {
  if (values.size() == 1 || time < times.front() || time > times.back()) return 0.0;
  const std::size_t i = interval_of(times, time);
  return (values[i + 1] - values[i]) / (times[i + 1] - times[i]);
}

double History::area(double time) const {
  if (values.size() == 1) return values[0] * time;
  const auto from_first = [&](double t) {
    double sum = 0.0, before = times.front();
    if (t <= before) return values.front() * (t - before);
    for (std::size_t i = 1; i < times.size() && before < t; ++i) {
      const double to = std::min(t, times[i]);
      sum += 0.5 * (at(before) + at(to)) * (to - before);
      before = to;
    }
    return sum + values.back() * std::max(0.0, t - times.back());
  };
  return from_first(time) - from_first(0.0);
}

double History::mean(double from, double to) const {
  return to > from ? (area(to) - area(from)) / (to - from) : at(from);
}

History wandering(
    double asked, double deviation, const Wander& wander, int stream, double before, double after) {
  constexpr double kSample = 0.01;  // s
  constexpr std::array<double, 3> kPeriods = {1.0, 0.6, 0.4};
  RandomStream random(static_cast<std::uint64_t>(wander.seed), static_cast<std::uint64_t>(stream));
  std::array<double, 3> phases{};
  for (double& phase : phases) phase = 2.0 * M_PI * random.uniform();
  History history;
  for (double t = -before; t < after + kSample; t += kSample) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += std::sin(2.0 * M_PI * t / (kPeriods[k] * wander.period) + phases[k]);
    history.times.push_back(t);
    history.values.push_back(asked + deviation * std::sqrt(2.0 / 3.0) * sum);
  }
  return history;
}

std::unique_ptr<const road::Road> road_of(const KerbTest& test, const car::Car& car) {
  if (!test.kerb && !test.filed) return std::make_unique<road::PlaneRoad>();
  const double way = test.speed.area(0.0) - test.speed.area(-test.run_in);
  const double axle = car.parts().corners[car::kFL].wheel_center.x() + way;
  if (test.filed) {
    const FiledRoad& filed = *test.filed;
    const Eigen::Vector2d start = Eigen::Rotation2Dd(-filed.heading) * filed.start;
    const double z = filed.road->height(filed.start.x(), filed.start.y(), 0.0);
    return std::make_unique<road::PlacedRoad>(
        filed.road, -filed.heading, Eigen::Vector3d(axle - start.x(), -start.y(), -z));
  }
  road::Kerb kerb = *test.kerb;
  kerb.start.x() += axle;
  return std::make_unique<road::ProfileRoad>(road::kerb_road(kerb));
}

namespace {

Eigen::Vector4d pushrods_at(const KerbTest& test, double time) {
  Eigen::Vector4d forces;
  for (std::size_t i = 0; i < 4; ++i)
    forces[static_cast<Eigen::Index>(i)] = test.pushrods[i].at(time);
  return forces;
}

class KerbRun {
 public:
  KerbRun(car::Car& car, const KerbTest& test, const CarWatcher& watch)
      : car_(car), test_(test), watch_(watch), road_(road_of(test, car)) {}

  Result<Channels> run() {
    car_.may_leave_road = test_.filed && test_.filed->continues;
    if (const Status done = start(); !done) return done.failure();
    CarRecord record(car_, state_, test_.with_area);
    const long every = std::lround(test_.sample_step / test_.step);
    const long lead = std::lround(test_.run_in / test_.step);
    const long last = lead + std::lround(test_.duration / test_.step);
    for (long i = 0; i <= last; ++i) {
      const double time = static_cast<double>(i - lead) * test_.step;
      if (i > 0) {
        inputs_ = inputs_at(time);
        if (const auto done = car_.advance(state_, test_.step, *road_, inputs_); !done)
          return Failure{(test_.filed ? "on the road: " : "on the kerb: ") + done.failure().reason};
      }
      if ((i - lead) % every != 0) continue;
      record.sample(state_, inputs_, time);
      speed_.push_back(state_.bodies.rates[6 * car_.parts().chassis]);
      if (watch_) watch_(car_, state_, *road_, time);
      for (std::size_t k = 0; k < 3; ++k)
        loaders_[k].push_back(downforce_[static_cast<Eigen::Index>(k)]);
      unreachable_.push_back(left_);
    }
    Channels channels = record.channels();
    channels.add({"speed", "m/s", speed_});
    channels.add({"line", "m", channels["y"]});
    if (test_.with_area) add_areas(channels);
    if (test_.loaders)
      for (std::size_t k = 0; k < 3; ++k)
        channels.add({fmt::format("loader_{}", k + 1), "N", loaders_[k]});
    if (test_.follows_pushrods()) channels.add({"unreachable", "N", unreachable_});
    return channels;
  }

 private:
  /// Adds the mean and the standard deviation of the contact area, from time 0 on, for each tire
  /// and for the sum of all tires.
  static void add_areas(Channels& channels) {
    const std::vector<double> time = channels["time"];
    const auto first =
        static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), -1e-9) - time.begin());
    std::vector<double> sum(time.size(), 0.0);
    const auto add = [&](const std::string& of, const std::vector<double>& area) {
      const auto count = static_cast<double>(area.size() - first);
      double mean = 0.0, square = 0.0;
      for (std::size_t i = first; i < area.size(); ++i) mean += area[i] / count;
      for (std::size_t i = first; i < area.size(); ++i)
        square += (area[i] - mean) * (area[i] - mean) / count;
      channels.add({"area_mean" + of, "m^2", {mean}});
      channels.add({"area_spread" + of, "m^2", {std::sqrt(square)}});
    };
    for (const char* corner : car::kCornerNames) {
      const std::vector<double> area = channels[std::string("area_") + corner];
      for (std::size_t i = 0; i < area.size(); ++i) sum[i] += area[i];
      add(std::string("_") + corner, area);
    }
    add("", sum);
  }

  Status start() {
    inputs_.guide = guide_at(-test_.run_in);
    const double speed = test_.speed.at(-test_.run_in);
    downforce_ = test_.downforce;
    if (test_.follows_pushrods()) {
      auto solved = car::solve_loaders(
          car_, *test_.loaders, pushrods_at(test_, -test_.run_in), *road_, speed, inputs_);
      if (!solved) return Failure{"the aeroloaders: " + solved.failure().reason};
      solution_ = std::move(*solved);
      downforce_ = solution_->downforce;
      left_ = solution_->left.norm();
      state_ = solution_->state;
      inputs_ = inputs_at(-test_.run_in);
      return {};
    }
    inputs_ = inputs_at(-test_.run_in);
    auto settled = car_.settle(*road_, speed, inputs_);
    if (!settled)
      return Failure{(test_.filed ? "at its start on the road: " : "before the kerb: ") +
                     settled.failure().reason};
    state_ = std::move(*settled);
    return {};
  }

  car::GuidePoint guide_at(double time) const {
    return {test_.speed.area(time) - test_.speed.area(-test_.run_in),
            test_.speed.at(time),
            test_.line.at(time)};
  }

  car::CarInputs inputs_at(double time) {
    car::CarInputs inputs;
    inputs.guide = guide_at(time);
    if (solution_) {
      const auto [force, left] = solution_->near(pushrods_at(test_, time));
      downforce_ = force;
      left_ = left.norm();
    }
    if (test_.loaders) inputs.loads = test_.loaders->loads(car_, downforce_);
    return inputs;
  }

  car::Car& car_;
  const KerbTest& test_;
  const CarWatcher& watch_;
  std::unique_ptr<const road::Road> road_;
  std::optional<car::LoaderSolution> solution_;
  car::CarState state_;
  car::CarInputs inputs_;
  Eigen::Vector3d downforce_ = Eigen::Vector3d::Zero();
  double left_ = 0.0;
  std::array<std::vector<double>, 3> loaders_;
  std::vector<double> unreachable_, speed_;
};

}  // namespace

Result<Channels> run(car::Car& car, const KerbTest& test, const CarWatcher& watch) {
  return KerbRun(car, test, watch).run();
}

}  // namespace latsch::experiment
