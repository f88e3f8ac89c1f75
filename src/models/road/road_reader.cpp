// SPDX-License-Identifier: Apache-2.0
#include "models/road/road_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "models/road/drum_road.h"
#include "models/road/kerb.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"
#include "models/road/wave_road.h"

namespace latsch::road {
namespace {

constexpr std::array kKinds = {"flat", "cleat", "drum", "kerb", "wave"};
constexpr double kSteepest = 10.0;
constexpr double kLargest = 1e4;                        // m
constexpr double kShortestRoad = 1e-6;                  // m
constexpr double kThinnest = 1e-3;                      // m, smallest pitch and width of a kerb
constexpr double kHighest = 2.0;                        // m, largest height of cleats and kerbs
constexpr double kFastest = 1e3;                        // m/s
constexpr double kRightAngle = std::numbers::pi / 2.0;  // rad
// Largest angle of a cleat to the axle, rad.
constexpr double kMostOblique = 80.0 / 90.0 * kRightAngle;

Range friction_range() { return Range::between(0.0, 10.0); }
Range size_range() { return {0.0, kLargest, true}; }
Range height_range() { return Range::between(-kHighest, kHighest); }
Range kerb_range() { return Range::between(kThinnest, kLargest); }
Range signed_range() { return Range::between(-kLargest, kLargest); }

double friction(const Node& table) {
  return table.quantity("friction", "1", friction_range(), 1.0);
}
double obstacle_friction(const Node& table) {
  return table.quantity("obstacle_friction", "1", friction_range(), friction(table));
}
double belt_speed(const Node& table) {
  return table.quantity("belt_speed", "m/s", Range::between(-kFastest, kFastest), 0.0);
}

Profile read_cleat(const Node& table) {
  const double height = table.quantity("height", "m", height_range());
  const double length = table.quantity("length", "m", size_range());
  const double most = std::min(std::abs(height), length / 2.0);
  return cleat_profile(
      height, length, table.quantity("bevel", "m", Range::between(0.0, most), 0.0));
}

double read_angle(const Node& table) {
  return table.quantity("angle", "rad", Range::between(-kMostOblique, kMostOblique), 0.0);
}

std::unique_ptr<Road> read_plane(const Node& table) {
  PlaneRoad::Settings settings;
  settings.height = table.quantity("height", "m", signed_range(), 0.0);
  settings.grade = table.quantity("grade", "1", Range::between(-kSteepest, kSteepest), 0.0);
  settings.bank = table.quantity("bank", "1", Range::between(-kSteepest, kSteepest), 0.0);
  settings.friction = friction(table);
  settings.belt = Travel(belt_speed(table));
  return std::make_unique<PlaneRoad>(settings);
}

std::unique_ptr<Road> read_cleat_road(const Node& table) {
  ProfileRoad::Settings settings;
  settings.along = read_cleat(table);
  settings.angle = read_angle(table);
  settings.origin.x() = table.quantity("place", "m", signed_range(), 0.0);
  settings.friction = friction(table);
  settings.obstacle_friction = obstacle_friction(table);
  settings.belt = Travel(belt_speed(table));
  return std::make_unique<ProfileRoad>(settings);
}

Travel read_speed(const Node& table) {
  const Range range = Range::between(-kFastest, kFastest);
  if (!table.has("times")) return Travel(table.quantity("speed", "m/s", range, 0.0));
  const auto times = table.quantities("times", "s");
  const auto speeds = table.quantities("speeds", "m/s", range);
  if (times.empty() || times.size() != speeds.size()) {
    table.reject("speeds",
                 "are " + std::to_string(speeds.size()) + ", expected one for each of " +
                     std::to_string(times.size()) + " times");
  }
  std::vector<Travel::Point> points;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (i > 0 && times[i] <= times[i - 1])
      table.reject("times", "do not ascend; expected each time to be later than the one before");
    points.push_back({times[i], speeds[i]});
  }
  return Travel(std::move(points));
}

std::unique_ptr<Road> read_drum(const Node& table) {
  DrumRoad::Settings settings;
  settings.diameter = table.quantity("diameter", "m", size_range());
  settings.inner = table.flag("inner", false);
  settings.surface = read_speed(table);
  settings.friction = friction(table);
  const int cleats = static_cast<int>(table.integer("cleats", 0, 1000, 0));
  if (cleats > 0) {
    DrumRoad::Cleat cleat;
    cleat.profile = read_cleat(table);
    if (table.quantity("height", "m", Range::positive()) >= settings.diameter / 4.0) {
      table.reject("height", "is more than half of the drum's radius");
    }
    cleat.starting_angle = table.quantity("starting_angle", "rad", {}, std::numbers::pi);
    cleat.angle = read_angle(table);
    cleat.friction = obstacle_friction(table);
    settings.cleats = equally_spaced(cleats, cleat);
    if (const std::string fault = DrumRoad::fault(settings); !fault.empty())
      table.reject(cleats > 1 ? "cleats" : "length", "does not fit the drum: " + fault);
  }
  return std::make_unique<DrumRoad>(settings);
}

/// Throws InputError for waves that are steeper than on any real road.
void refuse_steep_waves(const Node& table, const WaveRoad::Settings& settings) {
  const auto refuse = [&](const char* key, double amplitude, double length) {
    const double slope = 2.0 * std::numbers::pi * std::abs(amplitude) / length;
    if (slope <= kSteepest) return;
    table.reject(key,
                 fmt::format("makes a slope of {:.3g} on waves of {:.4g} m, expected at most {:g}: "
                             "a lower amplitude or longer waves",
                             slope,
                             length,
                             kSteepest));
  };
  refuse("amplitude", settings.amplitude_begin, settings.wave_length_begin);
  refuse(table.has("amplitude_end") ? "amplitude_end" : "amplitude",
         settings.amplitude_end,
         settings.wave_length_end);
}

std::unique_ptr<Road> read_wave(const Node& table) {
  WaveRoad::Settings settings;
  settings.start = table.quantity("start", "m", signed_range(), 0.0);
  settings.amplitude_begin = table.quantity("amplitude", "m", signed_range());
  settings.wave_length_begin = table.quantity("wave_length", "m", size_range());
  settings.amplitude_end = settings.amplitude_begin;
  settings.wave_length_end = settings.wave_length_begin;
  if (table.has("end")) {
    settings.end =
        table.quantity("end", "m", Range::between(settings.start + kShortestRoad, kLargest));
    settings.amplitude_end =
        table.quantity("amplitude_end", "m", signed_range(), settings.amplitude_end);
    settings.wave_length_end =
        table.quantity("wave_length_end", "m", size_range(), settings.wave_length_end);
    settings.exponential = table.flag("exponential", false);
  }
  settings.friction = friction(table);
  refuse_steep_waves(table, settings);
  return std::make_unique<WaveRoad>(settings);
}

}  // namespace

Kerb read_kerb(const Node& table) {
  table.choice("kind", {"kerb"});
  Kerb kerb;
  const std::string shape = table.choice("shape", {"saw_tooth", "triangle", "sine", "block"});
  kerb.shape = shape == "saw_tooth"  ? Kerb::Shape::saw_tooth
               : shape == "triangle" ? Kerb::Shape::triangle
               : shape == "sine"     ? Kerb::Shape::sine
                                     : Kerb::Shape::block;
  kerb.pitch = table.quantity("pitch", "m", kerb_range());
  kerb.width = table.quantity("width", "m", kerb_range());
  kerb.height = table.quantity("height", "m", height_range());
  kerb.count = static_cast<int>(table.integer("count", 1, 100000));
  if (kerb.shape == Kerb::Shape::block) {
    kerb.length = table.quantity("length", "m", {0.0, kerb.pitch, true});
    const double most = std::min(std::abs(kerb.height), kerb.length / 2.0);
    kerb.bevel = table.quantity("bevel", "m", Range::between(0.0, most), 0.0);
  }
  kerb.ramp = table.quantity("ramp", "m", Range::between(0.0, kerb.width / 2.0), 0.0);
  if (table.has("start")) {
    const auto start = table.quantities("start", "m", signed_range());
    if (start.size() != 2) table.reject("start", "expected x and y");
    kerb.start = {start[0], start[1]};
  }
  kerb.angle = table.quantity("angle", "rad", {}, 0.0);
  kerb.road_friction = friction(table);
  kerb.friction = obstacle_friction(table);
  return kerb;
}

bool is_road(const Node& table) {
  return std::find(kKinds.begin(), kKinds.end(), table.text("kind")) != kKinds.end();
}

std::unique_ptr<Road> read_road(const Node& table) {
  const std::string kind = table.choice("kind", {kKinds.begin(), kKinds.end()});
  std::unique_ptr<Road> road = kind == "flat"    ? read_plane(table)
                               : kind == "cleat" ? read_cleat_road(table)
                               : kind == "drum"  ? read_drum(table)
                               : kind == "kerb"
                                   ? std::make_unique<ProfileRoad>(kerb_road(read_kerb(table)))
                                   : read_wave(table);
  table.close();
  return road;
}

}  // namespace latsch::road
