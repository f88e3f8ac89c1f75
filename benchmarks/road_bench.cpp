// SPDX-License-Identifier: Apache-2.0
// What one question costs on every kind of road, and that it does not grow with the size of the
// file
//
// A tire's questions: a footprint of 0.2 m x 0.2 m that moves along the road, heights alone. Times
// are those of the process, the best of five. The indices keep their promise where a road of a
// hundred times the data costs at most twice as much a question: a search through all of it would
// cost a hundred times, a tree's one level for every doubling.
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <memory>
#include <numbers>

#include "models/road/crg_road.h"
#include "models/road/drum_road.h"
#include "models/road/kerb.h"
#include "models/road/plane_road.h"
#include "models/road/triangle_road.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace road;

constexpr int kSteps = 200;
constexpr int kPoints = 30;  // along and across the footprint
constexpr double kFootprint = 0.2;

/// s a question, along the circle or line `place` draws over 0 ... 1.
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

/// A closed track: a circle of rows every 0.1 m.
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

int road_bench() {
  Table table("road");
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
    table.row(what + ", a hundred times the data",
              fmt::format("{} = {:.2f} times", nanoseconds(large), large / small),
              "<= 2 times",
              large <= 2.0 * small);
  };
  const TriangleRoad few = triangles(500), many = triangles(50000);
  compare("10,000 triangles", cost(few, ahead(40.0)), cost(many, ahead(4000.0)));
  const auto round = [](int rows) {
    return [=](double part) {
      const double radius = 0.1 * rows / (2.0 * std::numbers::pi), angle = 6.0 * part;
      return Eigen::Vector2d(radius * std::cos(angle), radius * std::sin(angle));
    };
  };
  const CrgRoad lap = track(1000), circuit = track(100000);
  compare("OpenCRG of 1,000 rows", cost(lap, round(1000)), cost(circuit, round(100000)));
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main() { return latsch::benchmarks::guarded(latsch::benchmarks::road_bench); }
