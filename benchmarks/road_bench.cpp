// SPDX-License-Identifier: Apache-2.0
// Cost of one height query on every kind of road, and its independence of the size of the road's
// file. The queries are those of a tire: heights in a footprint of 0.2 m x 0.2 m that moves along
// the road. Times are those of the process, the best of five. A road's index passes if a query on a
// road with a hundred times the data costs at most twice as much: a full search would cost a
// hundred times as much, a tree one level more for every doubling.
//
// The tandem cams of the rigid ring tire roll over the same roads: effective height and slope are
// compared with their literal definition, the highest of points 0.01 mm apart and of points at the
// edges of the road profile.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <numbers>
#include <string>

#include "models/rigid_ring/tandem_cams.h"
#include "models/road/crg_road.h"
#include "models/road/drum_road.h"
#include "models/road/kerb.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"
#include "models/road/triangle_road.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace road;

constexpr int kSteps = 200;
constexpr int kPoints = 30;  // points in each direction of the footprint
constexpr double kFootprint = 0.2;

/// Returns the time, s, of a query. The queries follow the line or circle that `place` describes
/// for arguments from 0 to 1.
template <class Place>
double cost(const Road& road, const Place& place) {
  double best = 1e300, sum = 0.0;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const std::clock_t begin = std::clock();
    for (int step = 0; step < kSteps; ++step) {
      const Eigen::Vector2d p = place(step / static_cast<double>(kSteps));
      for (int i = 0; i < kPoints; ++i)
        for (int j = 0; j < kPoints; ++j)
          sum += road.height(
              p.x() + kFootprint * i / kPoints, p.y() + kFootprint * j / kPoints, 0.01 * step);
    }
    const double time = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    best = std::min(best, time / (kSteps * kPoints * kPoints));
  }
  return std::isfinite(sum) ? best : 1e300;
}

TriangleRoad triangles(int n) {
  TriangleMesh mesh;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= 10; ++j)
      mesh.nodes.push_back({0.1 * i, 0.1 * j - 0.5, 0.01 * std::sin(0.7 * i + j)});
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < 10; ++j) {
      const int k = 11 * i + j;
      mesh.triangles.push_back({{k, k + 11, k + 1}, 1.0});
      mesh.triangles.push_back({{k + 1, k + 11, k + 12}, 1.0});
    }
  }
  return TriangleRoad(std::move(mesh));
}

/// Returns a closed track: a circle with rows every 0.1 m.
CrgRoad track(int rows) {
  CrgGrid grid;
  grid.u_increment = 0.1;
  const double radius = 0.1 * rows / (2.0 * std::numbers::pi);
  for (int i = 0; i < rows; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / rows;
    grid.line.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  grid.line_height.assign(rows, 0.0);
  for (int i = 0; i <= 20; ++i) grid.v.push_back(0.1 * i - 1.0);
  grid.z.resize(rows * grid.v.size());
  for (std::size_t i = 0; i < grid.z.size(); ++i)
    grid.z[i] = 0.01 * std::sin(0.3 * static_cast<double>(i));
  return CrgRoad(std::move(grid));
}

struct Effective {
  double w, slope;
};

/// Returns the height of an elliptical cam with half axes a and b and exponent c whose center is
/// over x, by the literal definition; `edges` are those of the road profile.
double standing(
    const Road& road, double a, double b, double c, double x, const double (&edges)[2]) {
  constexpr double kApart = 1e-5;
  double highest = -1e300;
  const auto look = [&](double at) {
    const double xi = std::abs(at - x) / a;
    if (xi > 1.0) return;
    const double depth = b * std::pow(1.0 - std::pow(xi, c), 1.0 / c);
    highest = std::max(highest, road.height(at, 0.0, 0.0) + depth);
  };
  for (double at = x - a; at <= x + a; at += kApart) look(at);
  for (const double edge : edges)
    for (const double side : {-1e-9, 0.0, 1e-9}) look(edge + side);
  return highest;
}

/// Adds the largest differences between our cams and the literal definition over many positions of
/// a wheel.
void cams(Table& table, const std::string& what, const Road& road, const double (&edges)[2]) {
  magic_formula::Parameters p;
  p.UNLOADED_RADIUS = 0.31;
  p.ELLIPS_NWIDTH = 1.0;
  constexpr double kHalf = 0.055;  // m, half the length of the contact patch
  const double a = p.ELLIPS_LENGTH * p.UNLOADED_RADIUS, b = p.ELLIPS_HEIGHT * p.UNLOADED_RADIUS;
  const double l_s = p.ELLIPS_SHIFT * 2.0 * kHalf;
  const rigid_ring::TandemCams cams(p);
  Effective worst{0.0, 0.0};
  double spent = 0.0;
  int places = 0;
  for (double x = edges[0] - 0.4; x < edges[0] + 0.4; x += 0.0117, ++places) {
    const double front = standing(road, a, b, p.ELLIPS_ORDER, x + 0.5 * l_s, edges);
    const double rear = standing(road, a, b, p.ELLIPS_ORDER, x - 0.5 * l_s, edges);
    const std::clock_t begin = std::clock();
    const auto plane = cams.plane({x, 0.0, 0.3}, Eigen::Vector3d::UnitX(), kHalf, 0.1, road, 0.0);
    spent += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    const double slope = -plane.normal.x() / plane.normal.z();
    worst.w = std::max(worst.w, std::abs(plane.point.z() - 0.5 * (front + rear) + b));
    worst.slope = std::max(worst.slope, std::abs(slope - (front - rear) / l_s));
  }
  table.row("tandem cams, " + what + ": height",
            fmt::format("{:.1e} mm", 1e3 * worst.w),
            "<= 0.1 mm",
            worst.w <= 1e-4);
  table.row("tandem cams, " + what + ": slope",
            fmt::format("{:.1e}", worst.slope),
            "<= 0.002",
            worst.slope <= 2e-3);
  table.note("a pair of cams there", fmt::format("{:.1f} us", 1e6 * spent / places));
}

int road_bench(const Options& options) {
  Table table("road", options);
  cams(table,
       "step of 20 mm",
       ProfileRoad({.along = Profile({{0.0, 0.0}, {0.0, 0.02}})}),
       {0.0, 0.0});
  cams(table, "cleat 10 x 50 mm", cleat_road(0.025, 0.01, 0.05, 0.0), {0.0, 0.05});
  const Kerb saw{.height = 0.025, .start = {0.0, -0.4}};
  cams(table, "kerb of 800 x 25 mm, triangles", TriangleRoad(kerb_triangles(saw, 3.0)), {0.8, 1.6});
  const auto nanoseconds = [](double time) { return fmt::format("{:.0f} ns", 1e9 * time); };
  const auto ahead = [](double length) {
    return [=](double part) { return Eigen::Vector2d(part * length, -0.1); };
  };
  table.note("flat", nanoseconds(cost(PlaneRoad(), ahead(10.0))));
  DrumRoad::Settings drum;
  drum.surface = Travel(20.0);
  drum.cleats = {{cleat_profile(0.02, 0.025, 0.005), 0.0, 0.5, 1.0}};
  table.note("drum with a cleat",
             nanoseconds(cost(DrumRoad(drum), [](double) { return Eigen::Vector2d(-0.1, -0.1); })));
  Kerb kerb;
  kerb.height = 0.025;
  table.note("kerb", nanoseconds(cost(kerb_road(kerb), ahead(3.0))));
  const auto compare = [&](const std::string& what, double small, double large) {
    table.note(what + ", small", nanoseconds(small));
    table.full_row(what + ", a hundred times the data",
                   fmt::format("{} = {:.2f} times", nanoseconds(large), large / small),
                   "<= 2 times",
                   large <= 2.0 * small);
  };
  const TriangleRoad few = triangles(500), many = triangles(options.size(50000, 5000));
  compare(
      "10,000 triangles", cost(few, ahead(40.0)), cost(many, ahead(options.size(4000.0, 400.0))));
  const auto round = [](int rows) {
    return [=](double part) {
      const double radius = 0.1 * rows / (2.0 * std::numbers::pi), angle = 6.0 * part;
      return Eigen::Vector2d(radius * std::cos(angle), radius * std::sin(angle));
    };
  };
  const CrgRoad lap = track(1000), circuit = track(options.size(100000, 10000));
  compare("OpenCRG of 1,000 rows",
          cost(lap, round(1000)),
          cost(circuit, round(options.size(100000, 10000))));
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::road_bench);
}
