// SPDX-License-Identifier: Apache-2.0
// Times of one suspension corner with ten bushings: static equilibria and compliance matrices per
// second, and the kinematic curve of the same corner with rigid links.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "models/multibody/equilibrium.h"
#include "models/suspension/corner_testing.h"
#include "models/suspension/geometry_testing.h"
#include "models/suspension/kinematic_outputs.h"
#include "table.h"
#include "yardstick.h"

namespace {

using namespace latsch::multibody;
using latsch::benchmarks::beside;
using latsch::benchmarks::Yardstick;
using latsch::suspension::DoubleWishbone;
using latsch::suspension::race_corner;

constexpr int kRounds = 15;

/// Returns random loads: forces up to 5 kN and moments up to 200 N m in any direction.
std::vector<Load> random_loads(const DoubleWishbone& corner, int count) {
  latsch::RandomStream random(15, 1);
  std::vector<Load> loads;
  const auto any = [&](double most) { return most * (2.0 * random.uniform() - 1.0); };
  for (int i = 0; i < count; ++i)
    loads.push_back({DoubleWishbone::kUpright,
                     corner.contact,
                     {any(5e3), any(5e3), any(5e3)},
                     {any(200.0), any(200.0), any(200.0)}});
  return loads;
}

/// Times a kinematic curve: 100 points from -30 to 30 mm of wheel travel, with their rates.
void kinematics(latsch::benchmarks::Table& table, int rounds) {
  using namespace latsch::suspension;
  constexpr int kPoints = 100, kCurves = 20;
  const CornerGeometry corner = race_geometry();
  double sum = 0.0;
  const auto curves = beside(Yardstick::atan, rounds, [&] {
    for (int k = 0; k < kCurves; ++k) {
      KinematicCorner moving(corner, TravelOf::contact);
      for (int i = 0; i < kPoints; ++i) {
        const auto wheel = moving.move_to(-0.03 + 0.06 * i / (kPoints - 1), 0.0);
        sum += wheel ? wheel->toe + wheel->ride_frequency : NAN;
      }
    }
  });
  const double curve = curves.time / kCurves;
  table.full_row("rigid links: a travel curve of 100 points, all outputs",
                 fmt::format("{:.3f} ms", 1e3 * curve),
                 "< 1.5 ms",
                 curve < 1.5e-3 && std::isfinite(sum));
  table.note("points a second", fmt::format("{:.0f}", kPoints / curve));
}

int kc(const latsch::benchmarks::Options& options) {
  latsch::benchmarks::Table table("kc", options);
  const int rounds = options.size(kRounds, 1);
  const DoubleWishbone corner = race_corner();
  const Mechanism mechanism(corner.bodies(), corner.joints());
  Equilibrium statics(mechanism);
  const std::vector<Load> loads = random_loads(corner, 500);
  double left = 0.0, iterations = 0.0;
  int failed = 0;
  const auto nonlinear = beside(Yardstick::atan, rounds, [&] {
    for (const Load& load : loads) {
      failed += statics.solve({&load, 1}) ? 0 : 1;
      left = std::max(left, statics.left());
      iterations += statics.iterations();
    }
  });
  const double rate = static_cast<double>(loads.size()) / nonlinear.time;
  table.full_row("nonlinear statics of a corner from rest, load cases a second",
                 fmt::format("{:.0f}", rate),
                 ">= 50000",
                 rate >= 50000.0 && failed == 0);
  table.row("what is left of forces and moments",
            fmt::format("{:.1e} N, N m, none failed", left),
            "<= 1e-6",
            left <= 1e-6 && failed == 0);
  table.note("Newton's corrections each",
             fmt::format("{:.2f}", iterations / static_cast<double>(loads.size()) / (rounds + 1)));
  const Poses rest = mechanism.at_rest();
  const Eigen::Vector3d arm = corner.contact - corner.wheel_center;
  double sum = 0.0;
  constexpr int kMatrices = 2000;
  const auto linear = beside(Yardstick::atan, rounds, [&] {
    for (int i = 0; i < kMatrices; ++i) {
      if (!statics.linearize(rest, {})) sum = NAN;
      sum += statics.compliance(DoubleWishbone::kUpright, DoubleWishbone::kUpright, arm)(2, 2);
    }
  });
  const double matrices = kMatrices / linear.time;
  table.full_row("6 x 6 compliance matrices a second",
                 fmt::format("{:.0f}", matrices),
                 ">= 200000",
                 matrices >= 200000.0 && std::isfinite(sum));
  kinematics(table, rounds);
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) { return latsch::benchmarks::run_benchmark(argc, argv, {}, kc); }
