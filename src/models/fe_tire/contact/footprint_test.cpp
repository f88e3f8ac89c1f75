// SPDX-License-Identifier: Apache-2.0
// Tests the edges of a footprint, and the contact of a circular arc with the ground, against closed
// forms.
#include "models/fe_tire/contact/footprint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "base/document.h"
#include "models/fe_tire/description/tire_description.h"
#include "models/fe_tire/ring/ring.h"

namespace latsch::fe_tire {
namespace {

struct Tread {
  TireDescription tire;
  Mesh mesh;
  Ring ring;
  RingUnknowns unknowns;
  TreadSurface surface;

  explicit Tread(const char* name)
      : tire(read_tire(
            Document::read(std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/tires" / name)
                .root())),
        mesh(build_mesh(tire)),
        ring(mesh, tire.element),
        unknowns(ring, RingSymmetry::even, *find_mirror(mesh, build_materials(tire))),
        surface(unknowns, TreadShape::smooth, 0.4) {}

  Eigen::Matrix3Xd undeformed() const {
    return surface.positions(Eigen::Matrix3Xd::Zero(3, surface.nodes()));
  }
};

constexpr double kRadius = 0.31;  // m

/// Samples of a tread above the ground. `gap` gives their distance from it as a function of their
/// position along it.
struct Above {
  Eigen::Matrix3Xd at;
  Eigen::VectorXd area;

  Above(const Tread& tread, const std::function<double(double x)>& gap)
      : at(3, tread.surface.samples().size()), area(at.cols()) {
    const Eigen::Matrix3Xd positions = tread.undeformed();
    for (Eigen::Index k = 0; k < at.cols(); ++k) {
      const auto& sample = tread.surface.samples()[k];
      at.col(k) = tread.surface.at(sample, positions);
      at(2, k) = gap(at(0, k));
      area[k] = sample.dA;
    }
  }
};

/// Returns the gap (F.1) a^2 / (2 R) beside the contact of a cylinder of radius R with a half-space
/// [Johnson 1985, section 4.2].
std::function<double(double)> line_contact(double a) {
  return [a](double x) {
    const double t = std::max(std::abs(x) / a, 1.0);
    return a * a / (2.0 * kRadius) * (t * std::sqrt(t * t - 1.0) - std::acosh(t));
  };
}

// Between samples 1.3 mm apart the square root of the gap is interpolated linearly, which shifts an
// edge by some hundredths of this distance.
TEST(FootprintSize, FindsTheEdgesOfALineContact) {
  const Tread tread("passenger_205_55R16.toml");
  for (const double a : {0.008, 0.02, 0.045, 0.07}) {
    const Above above(tread, line_contact(a));
    const FootprintSize size = footprint_size(tread.surface, above.at, above.area, 0.0);
    EXPECT_NEAR(size.length, 2.0 * a, 2e-4) << a;
  }
}

// The surface has a wave from column to column, which does not load the ground. It counts by half:
// the patch is as long as with a uniform dip of half the wave's depth. At the ends of the tread the
// hat function is cut, which leaves a mean of 0.054 of the wave, 6 % of that dip.
TEST(FootprintSize, FeelsHalfOfAWaveAcross) {
  const Tread tread("race_16x7.5-10.toml");
  const auto length = [&](const std::function<double(double share)>& more) {
    Above above(tread, line_contact(0.02));
    for (const std::vector<int>& line : tread.surface.lines_across()) {
      for (std::size_t k = 0; k < line.size(); ++k) {
        above.at(2, line[k]) += more((k % TreadSurface::kSamples + 0.5) / TreadSurface::kSamples);
      }
    }
    return footprint_size(tread.surface, above.at, above.area, 0.0).length;
  };
  const double even = length([](double) { return 0.0; });
  for (const double height : {1e-4, 2e-4}) {
    const auto wave = [&](double share) {
      return height * std::cos(2.0 * std::numbers::pi * share);
    };
    const double lowest = wave(0.5 + 0.5 / TreadSurface::kSamples);
    const double dipped = length([&](double) { return 0.5 * lowest; });
    EXPECT_GT(dipped, even + 1e-3);
    EXPECT_NEAR(length(wave), dipped, 0.06 * (dipped - even)) << height;
  }
}

TEST(FootprintSize, IsNothingOfATreadThatComesNearTheGroundAndDoesNotTouch) {
  const Tread tread("passenger_205_55R16.toml");
  const Above above(tread, [](double x) { return 1e-4 + x * x / (2.0 * kRadius); });
  const FootprintSize size = footprint_size(tread.surface, above.at, above.area, 0.0);
  EXPECT_EQ(size.length, 0.0);
  EXPECT_EQ(size.width, 0.0);
  EXPECT_EQ(size.area, 0.0);
}

// Away from the patch the tread may be vertical, so that samples lie above each other.
TEST(FootprintSize, DoesNotMindSamplesInOnePlace) {
  const Tread tread("passenger_205_55R16.toml");
  Above above(tread, line_contact(0.045));
  const double area = footprint_size(tread.surface, above.at, above.area, 0.0).area;
  for (const std::vector<int>& line : tread.surface.lines_around())
    above.at(0, line.back()) = above.at(0, line[line.size() - 2]);
  EXPECT_EQ(footprint_size(tread.surface, above.at, above.area, 0.0).area, area);
}

// The crown of the race tire is flat across to 1 %. A sector of h = 3 deg of it has the sag R h^2 /
// 12: the mean of a parabola weighted by hat functions over two sectors, around nodes and around
// any other point. Contact points must lie inside the arc by 0.47 of this sag.
TEST(TreadSurface, PointsOfAnArcLieAShareOfItsSagBehindIt) {
  const Tread tread("race_16x7.5-10.toml");
  const Eigen::Matrix3Xd positions = tread.undeformed();
  const double h = tread.mesh.angle(1) - tread.mesh.angle(0);
  int found = 0;
  for (const TreadSurface::Point& point : tread.surface.points()) {
    const Eigen::Vector3d x = tread.surface.at(point, positions);
    if (std::abs(x.y()) > 1e-3 || std::abs(std::atan2(x.x(), -x.z())) > 5.0 * h) continue;
    double radius = 0.0;  // m, radius of the crown
    for (int k = 0; k < point.weights; ++k) {
      const auto& place = tread.surface.places()[tread.surface.weights(point)[k].place];
      if (std::abs(place.X.y()) < 1e-3) radius = std::hypot(place.X.x(), place.X.z());
    }
    const double behind = radius - std::hypot(x.x(), x.z());
    EXPECT_NEAR(behind, 0.47 * radius * h * h / 12.0, 0.1 * radius * h * h / 12.0);
    ++found;
  }
  EXPECT_GE(found, 16);
}

}  // namespace
}  // namespace latsch::fe_tire
