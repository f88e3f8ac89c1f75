// SPDX-License-Identifier: Apache-2.0
// Tests effective height and slope against an independent program that applies the definition
// literally: NumPy slides the outline over points of the road 0.02 mm apart, including corners.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "models/rigid_ring/tandem_cams.h"
#include "models/road/drum_road.h"
#include "models/road/kerb.h"
#include "models/road/profile_road.h"

namespace latsch::rigid_ring {
namespace {

constexpr const char* kPython = "/usr/bin/python3";
constexpr const char* kScript = R"py(
import numpy as np
a, b, c, l_s, R = np.loadtxt("cam")
x0s = np.loadtxt("places")

def line(points, step=2e-5):            # a polyline, points on all of its edges
    xs, zs = [], []
    for (x1, z1), (x2, z2) in zip(points, points[1:]):
        n = max(2, int(np.hypot(x2 - x1, z2 - z1) / step) + 2)
        xs.append(np.linspace(x1, x2, n)); zs.append(np.linspace(z1, z2, n))
    return np.concatenate(xs), np.concatenate(zs)

def level(points):                      # between level road far away on both sides
    return line([(-0.9, 0)] + points + [(0.9, 0)])

def drum(corners):
    x = np.arange(-0.9, 0.9, 2e-5)
    theta = np.array([s for s, z in corners]) / R
    r = R + np.array([z for s, z in corners])
    edges = line(list(zip(r * np.sin(theta), r * np.cos(theta) - R)))
    return np.concatenate([x, edges[0]]), np.concatenate([np.sqrt(R * R - x * x) - R, edges[1]])

def bar(h, l, bevel):
    return [(-l/2, 0), (-l/2, h - bevel), (-l/2 + bevel, h), (l/2 - bevel, h), (l/2, h - bevel), (l/2, 0)]

saw = [(0, 0)]
for i in range(4): saw += [(0.8 * (i + 1), 0.025), (0.8 * (i + 1), 0)]
roof = [(0, 0)]
for i in range(3): roof += [(0.1 * i + 0.05, 0.02), (0.1 * i + 0.1, 0)]
roads = [line([(-0.9, 0), (0, 0), (0, 0.02), (0.9, 0.02)]), level(bar(0.01, 0.05, 0)),
         level(bar(0.015, 0.03, 0.005)), level(bar(-0.02, 0.1, 0.01)), line([(-0.9, 0)] + saw + [(4, 0)]),
         level(roof), drum(bar(0.01, 0.02, 0.003)), drum([(0, 0), (0, 0)])]

def Z(x, z, middle):
    near = np.abs(x - middle) <= a
    depth = b * (1 - (np.abs(x[near] - middle) / a) ** c) ** (1 / c)
    return np.max(z[near] + depth)

with open("answers", "w") as out:
    for x, z in roads:
        for x0 in x0s:
            front, rear = Z(x, z, x0 + l_s / 2), Z(x, z, x0 - l_s / 2)
            out.write("%.17g %.17g\n" % ((front + rear) / 2 - b, (rear - front) / l_s))
)py";

constexpr double kDrum = 1.25;  // m, radius

/// Returns the roads of the script.
std::vector<std::unique_ptr<road::Road>> roads() {
  using road::ProfileRoad;
  std::vector<std::unique_ptr<road::Road>> all;
  const auto take = [&](const auto& road) {
    all.push_back(std::make_unique<std::decay_t<decltype(road)>>(road));
  };
  take(ProfileRoad({.along = road::Profile({{0.0, 0.0}, {0.0, 0.02}})}));
  take(road::cleat_road(0.0, 0.01, 0.05, 0.0));
  take(road::cleat_road(0.0, 0.015, 0.03, 0.005));
  take(road::cleat_road(0.0, -0.02, 0.1, 0.01));
  road::Kerb saw{.height = 0.025, .count = 4, .start = {0.0, -0.4}};
  take(road::kerb_road(saw));
  take(road::kerb_road({.shape = road::Kerb::Shape::triangle,
                        .pitch = 0.1,
                        .height = 0.02,
                        .count = 3,
                        .start = {0.0, -0.4}}));
  take(road::DrumRoad(
      {.diameter = 2.0 * kDrum, .cleats = {{.profile = road::cleat_profile(0.01, 0.02, 0.003)}}}));
  take(road::DrumRoad({.diameter = 2.0 * kDrum}));
  return all;
}

class Definition : public testing::Test {
 protected:
  void SetUp() override {
    const std::string ask = fmt::format("{} -c 'import numpy' 2>/dev/null", kPython);
    if (std::system(ask.c_str()) != 0)
      GTEST_SKIP() << "NumPy is not installed (Debian: python3-numpy)";
    folder_ = std::filesystem::temp_directory_path() / fmt::format("latsch_cams_{}", getpid());
    std::filesystem::create_directory(folder_);
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }
  std::filesystem::path folder_;
};

TEST_F(Definition, OfHeightAndSlopeIsMetOnEveryRoad) {
  magic_formula::Parameters p;
  p.UNLOADED_RADIUS = 0.31;
  p.ELLIPS_LENGTH = 1.05;
  p.ELLIPS_HEIGHT = 0.95;
  p.ELLIPS_SHIFT = 0.8;
  p.ELLIPS_NWIDTH = 1.0;
  constexpr double a = 0.055;
  std::vector<double> places;
  for (double x = -0.4; x < 0.4; x += 0.0377) places.push_back(x);
  std::ofstream(folder_ / "cam") << fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n",
                                                p.ELLIPS_LENGTH * p.UNLOADED_RADIUS,
                                                p.ELLIPS_HEIGHT * p.UNLOADED_RADIUS,
                                                p.ELLIPS_ORDER,
                                                p.ELLIPS_SHIFT * 2.0 * a,
                                                kDrum);
  std::ofstream at(folder_ / "places");
  for (const double x : places) at << fmt::format("{:.17g}\n", x);
  at.close();
  std::ofstream(folder_ / "oracle.py") << kScript;
  ASSERT_EQ(std::system(fmt::format("cd '{}' && {} oracle.py", folder_.string(), kPython).c_str()),
            0);
  std::ifstream answers(folder_ / "answers");
  const TandemCams cams(p);
  double farthest = 0.0, steepest = 0.0;
  int number = 0;
  for (const auto& road : roads()) {
    for (const double x : places) {
      double w = 0.0, tan_beta = 0.0;
      ASSERT_TRUE(answers >> w >> tan_beta);
      const auto plane = cams.plane({x, 0.0, 0.3}, Eigen::Vector3d::UnitX(), a, 0.08, *road, 0.0);
      const double slope = -plane.normal.x() / plane.normal.z();
      farthest = std::max(farthest, std::abs(plane.point.z() - w));
      steepest = std::max(steepest, std::abs(-slope - tan_beta));
      EXPECT_NEAR(plane.point.z(), w, 1e-6) << "road " << number << " at " << x;
      EXPECT_NEAR(-slope, tan_beta, 2e-5) << "road " << number << " at " << x;
    }
    ++number;
  }
  fmt::print("at most {:.1e} m and a slope of {:.1e} apart\n", farthest, steepest);
}

}  // namespace
}  // namespace latsch::rigid_ring
