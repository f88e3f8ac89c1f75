// SPDX-License-Identifier: Apache-2.0
// Slopes of the shipped 205/55R16 beside those that are published of one, and what each part of its
// description does to them. The published tire's construction is not known, and the shipped one is
// assumed as usual for its size, so these rows are for orientation and not judged.
//
// Published of a 205/55R16 91V at 2.4 bar [example data of a commercial tire model]: slip stiffness
// 697.9 N/%, cornering stiffness 960.5 N/deg, pneumatic trail 16.28 mm, camber stiffness 63.84
// N/deg, rolling circumference 1916.91 mm, deflections of 18.2 and 32.4 mm under 3015.5 and 6031.1
// N. The load of the slopes is stated for the camber stiffness alone, as a deflection of 18.16 mm;
// they are computed under 3015.5 N and under 5 kN.
//   The judged rows are the ply steer of the same tire: a mirror image of its belt angles changes
// the signs of the side force and of the aligning moment at no slip, and nothing else.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "cpu_time.h"
#include "free_wheel.h"
#include "shipped_tires.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

constexpr double kDegree = std::numbers::pi / 180.0, kSpeed = 60.0 / 3.6,
                 kPublishedPressure = 2.4e5;
constexpr double kFirstLoad = 3015.5, kSecondLoad = 6031.1, kHighLoad = 5000.0;  // N
/// Steps of the differences that are slopes, those of the test `rolling_stiffness`.
constexpr double kAlpha = 0.25 * kDegree, kKappa = 2e-3, kGamma = 1.0 * kDegree;

struct Slopes {
  double C_alpha, C_kappa, C_gamma;  // N/rad, N, N/rad
  double trail, R_e, deflection;     // m
  RollingForces free;                // those on the free wheel
};

Slopes slopes(const TireDescription& of, double load) {
  FreeWheel wheel(of, {1, 1, 1}, load, kSpeed, 1.0);
  const auto forces = [&](double kappa, double alpha, double camber) {
    return value_of(wheel.rolling.roll(wheel.state, wheel.at(kappa, alpha, camber))).forces;
  };
  const RollingForces left = forces(0.0, kAlpha, 0.0), right = forces(0.0, -kAlpha, 0.0),
                      driven = forces(kKappa, 0.0, 0.0), braked = forces(-kKappa, 0.0, 0.0),
                      leaning = forces(0.0, 0.0, kGamma), other = forces(0.0, 0.0, -kGamma);
  return {(right.force.y() - left.force.y()) / (2.0 * kAlpha),
          (driven.force.x() - braked.force.x()) / (2.0 * kKappa),
          (other.force.y() - leaning.force.y()) / (2.0 * kGamma),
          (left.moment.z() - right.moment.z()) / (right.force.y() - left.force.y()),
          kSpeed / wheel.state.of.spin,
          wheel.inflated.radius - wheel.state.of.height,
          wheel.state.forces};
}

/// A quantity of the published set.
struct Quantity {
  const char* name;
  double published;  // in the unit of its name
  double (*of)(const Slopes&);
};

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> all = {
      {"cornering stiffness, N/deg", 960.5, [](const Slopes& s) { return s.C_alpha * kDegree; }},
      {"slip stiffness, N/%", 697.9, [](const Slopes& s) { return 1e-2 * s.C_kappa; }},
      {"trail, mm", 16.28, [](const Slopes& s) { return 1e3 * s.trail; }},
      {"camber stiffness, N/deg", 63.84, [](const Slopes& s) { return s.C_gamma * kDegree; }},
      {"circumference, mm", 1916.91, [](const Slopes& s) {
         return 2e3 * std::numbers::pi * s.R_e;
       }}};
  return all;
}

void compare(const TireDescription& tire, Table& table) {
  for (const double load : {kFirstLoad, kHighLoad}) {
    const Slopes found = slopes(tire, load);
    for (const Quantity& one : quantities())
      table.note(
          fmt::format("{:.1f} N: {}, published {:g}", load, one.name, one.published),
          fmt::format(
              "{:.5g}, {:+.1f} %", one.of(found), 1e2 * (one.of(found) / one.published - 1.0)));
    if (load == kFirstLoad)
      table.note("3015.5 N: deflection, mm, published 18.2",
                 fmt::format("{:.4g}", 1e3 * found.deflection));
  }
}

/// Prints by how much each quantity changes at 5 kN with a part of the description.
void vary(const TireDescription& tire, Table& table) {
  using Change = std::function<void(TireDescription&)>;
  const auto scale_rubber = [](const char* name, double by) -> Change {
    return [=](TireDescription& of) {
      for (Rubber& rubber : of.rubbers)
        if (rubber.name.find(name) != std::string::npos) {
          auto& law = rubber.law;
          law.C10 *= by;
          law.C01 *= by;
          law.K *= by;
        }
    };
  };
  const std::vector<std::pair<const char*, Change>> changes = {
      {"tread modulus x 1.2", scale_rubber("tread", 1.2)},
      {"belt rubber x 1.2", scale_rubber("belt", 1.2)},
      {"sidewall rubbers x 1.2", scale_rubber("sidewall", 1.2)},
      {"tread 2 mm thinner",
       [](TireDescription& of) {
         for (std::size_t k = 0; k < of.section.outside.length.size(); ++k)
           if (of.section.outside.position[k] <= of.section.tread_to)
             of.section.outside.length[k] -= 2e-3;
       }},
      {"belt angles 3 deg less",
       [](TireDescription& of) {
         for (CordPly& ply : of.plies)
           if (ply.name.starts_with("belt"))
             ply.cords.angle -= std::copysign(3.0 * kDegree, ply.cords.angle);
       }},
      {"cords of belts and cap x 1.2", [](TireDescription& of) {
         for (CordPly& ply : of.plies)
           if (ply.name != "carcass") {
             ply.cords.E_tension *= 1.2;
             ply.cords.E_compression *= 1.2;
           }
       }}};
  const Slopes own = slopes(tire, kHighLoad);
  for (const auto& [name, change] : changes) {
    TireDescription varied = tire;
    change(varied);
    const Slopes found = slopes(varied, kHighLoad);
    std::string text;
    for (const Quantity& one : quantities())
      text += fmt::format(
          "{}{:+.1f}", text.empty() ? "" : ", ", 1e2 * (one.of(found) / one.of(own) - 1.0));
    table.note(fmt::format("5 kN, {}: change of these five, %", name), text);
  }
}

/// Judges the ply steer of the tire and of its mirror image.
void mirror(const TireDescription& tire, Table& table) {
  TireDescription mirrored = tire;
  for (CordPly& ply : mirrored.plies) ply.cords.angle = -ply.cords.angle;
  const double load = kFirstLoad;
  const RollingForces own = FreeWheel(tire, {1, 1, 1}, load, kSpeed, 1.0).state.forces;
  const RollingForces image = FreeWheel(mirrored, {1, 1, 1}, load, kSpeed, 1.0).state.forces;
  table.note("ply steer at 3015.5 N: Fy, Mz of the tire",
             fmt::format("{:.3f} N, {:.4f} N m", own.force.y(), own.moment.z()));
  const double side = std::abs(own.force.y() + image.force.y()) / load;
  const double moment = std::abs(own.moment.z() + image.moment.z()) / load;
  table.row("ply steer: Fy + Fy of the mirror image over the load",
            fmt::format("{:.1e}", side),
            "<= 1e-10",
            side <= 1e-10);
  table.row("ply steer: Mz + Mz of the mirror image over the load, m",
            fmt::format("{:.1e}", moment),
            "<= 1e-10",
            moment <= 1e-10);
}

}  // namespace

int run(const Options& options) {
  Table table("rolling_published", options);
  TireDescription tire = tire_for(options, "passenger_205_55R16");
  tire.pressure = kPublishedPressure;
  mirror(tire, table);
  if (options.is_smoke()) return table.exit_code();
  compare(tire, table);
  vary(tire, table);
  return table.exit_code();
}

}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::run);
}
