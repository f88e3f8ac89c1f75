// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/car_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "models/car/car_reader.h"

namespace latsch::experiment {
namespace {

constexpr std::array<const char*, 2> kAxleNames = {"front", "rear"};

/// Says if the floor of the car as drawn lies outside of the heights of its map of air forces.
std::vector<std::string> doubts_about_floor(const Document& car) {
  std::vector<std::string> doubts;
  const std::vector<std::string> paths = car.paths();
  for (std::size_t axle = 0; axle < 2; ++axle) {
    const std::string column = fmt::format(".{}", axle), floor = "aero.floor" + column;
    if (std::ranges::find(paths, floor) == paths.end()) continue;
    double least = HUGE_VAL, most = -HUGE_VAL;
    int rows = 0;
    for (const std::string& path : paths) {
      if (!path.starts_with("aero.map.") || !path.ends_with(column)) continue;
      least = std::min(least, car.get(path));
      most = std::max(most, car.get(path));
      ++rows;
    }
    const double height = car.get(floor);
    if (rows < 2 || (height >= least && height <= most)) continue;  // one row is a constant
    doubts.push_back(
        fmt::format("aero.floor is {:.6g} mm at the {} axle of the car as drawn, outside of the "
                    "heights {:.4g} to {:.6g} mm of aero.map: the coefficients are those of the "
                    "map's edge; is the floor measured from the plane of the map?",
                    1e3 * height,
                    kAxleNames[axle],
                    1e3 * least,
                    1e3 * most));
  }
  return doubts;
}

/// Height of the wheel center above the ground, z = 0, in m.
double height_of_wheel(const car::Axle& axle) { return axle.corner.wheel_center.z(); }

/// Adds doubts about the place of the chassis' center of mass.
void doubt_center(const car::CarParameters& car, std::vector<std::string>& doubts) {
  constexpr double kLowest = 0.4, kHighest = 6.0;  // heights over that of the wheel centers
  constexpr double kLeastShare = 0.1;              // share of the mass on one axle
  const Eigen::Vector3d& center = car.chassis.body.center;
  const double wheel = 0.5 * (height_of_wheel(car.front) + height_of_wheel(car.rear));
  if (center.z() < kLowest * wheel || center.z() > kHighest * wheel)
    doubts.push_back(fmt::format(
        "chassis.center is {:.6g} mm above the ground, z = 0, and the wheel centers are "
        "{:.6g} mm above it: is it in another unit, or counted from another height?",
        1e3 * center.z(),
        1e3 * wheel));
  const double rear = car.rear.corner.wheel_center.x(), front = car.front.corner.wheel_center.x();
  const double share = (center.x() - rear) / (front - rear);
  if (!(share >= kLeastShare && share <= 1.0 - kLeastShare))
    doubts.push_back(fmt::format(
        "chassis.center is at x = {:.6g} mm, and the axles at {:.4g} and {:.6g} mm: the "
        "front axle would carry {:.3g} % of the chassis; is it in another unit, or "
        "counted from another point?",
        1e3 * center.x(),
        1e3 * front,
        1e3 * rear,
        100.0 * share));
}

/// Adds a doubt about a wheel whose mass would lie outside of its tire, or all near its axis.
void doubt_inertia(const car::Axle& axle, const char* name, std::vector<std::string>& doubts) {
  constexpr double kLeast = 0.1, kMost = 1.5;  // over mass times radius squared; a ring has 1
  const double radius = height_of_wheel(axle), mass = axle.masses.wheel;
  if (!(mass > 0.0) || !(axle.masses.wheel_spin > 0.0)) return;
  const double share = axle.masses.wheel_spin / (mass * radius * radius);
  if (share >= kLeast && share <= kMost) return;
  doubts.push_back(
      fmt::format("{0}.inertia.wheel_spin is {1:.4g} kg m^2, which is {2:.3g} times "
                  "the mass {3:.4g} kg times the square of the height of the wheel "
                  "center, {4:.6g} mm: wheels have {5:g} to {6:g} times",
                  name,
                  axle.masses.wheel_spin,
                  share,
                  mass,
                  1e3 * radius,
                  kLeast,
                  kMost));
}

/// Adds doubts about dampers that are so stiff, or so soft, at their fastest point that its speed
/// may be in another unit.
void doubt_dampers(const Document& car, std::vector<std::string>& doubts) {
  constexpr double kSoftest = 5.0, kStiffest = 3e5;  // N s/m, force over rate
  const std::vector<std::string> paths = car.paths();
  for (const char* axle : kAxleNames)
    for (const char* unit : {"spring", "third"}) {
      const std::string damper = fmt::format("{}.{}.damper", axle, unit);
      double rate = 0.0, force = 0.0;
      for (const std::string& path : paths) {
        if (!path.starts_with(damper + ".") || !path.ends_with(".0")) continue;
        const std::string other = path.substr(0, path.size() - 1) + "1";
        if (std::abs(car.get(path)) <= std::abs(rate)) continue;
        rate = car.get(path);
        force = std::ranges::find(paths, other) == paths.end() ? 0.0 : car.get(other);
      }
      if (rate == 0.0 || force == 0.0) continue;
      const double constant = std::abs(force / rate);
      if (constant >= kSoftest && constant <= kStiffest) continue;
      doubts.push_back(
          fmt::format("{} has {:.4g} N at its fastest rate, {:.4g} m/s, which are "
                      "{:.3g} N s/m: dampers have {:g} to {:g} N s/m; is one of the "
                      "two in another unit?",
                      damper,
                      force,
                      rate,
                      constant,
                      kSoftest,
                      kStiffest));
    }
}

}  // namespace

std::vector<std::string> doubts_about_car(const Document& written, const Document& whole) {
  std::vector<std::string> doubts = doubts_about_floor(written);
  const car::CarParameters car = car::read_car(whole.root()).parameters;
  doubt_center(car, doubts);
  doubt_inertia(car.front, "front", doubts);
  doubt_inertia(car.rear, "rear", doubts);
  doubt_dampers(written, doubts);
  return doubts;
}

}  // namespace latsch::experiment
