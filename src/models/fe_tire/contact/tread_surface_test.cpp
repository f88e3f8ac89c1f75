// SPDX-License-Identifier: Apache-2.0
// Tests the contact surface of the tread on the shipped meshes, in which rows of elements meet on
// plies and end at tied edges.
#include "models/fe_tire/contact/tread_surface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/document.h"
#include "models/fe_tire/description/tire_description.h"
#include "models/fe_tire/ring/ring.h"

namespace latsch::fe_tire {
namespace {

constexpr double kWindow = 0.4;  // rad, half angle of the surface about the lowest point

/// Returns the area of the tread's flat faces that have an edge in this range, m^2.
double area_of_facets(const Mesh& mesh) {
  const auto is_near = [&](int plane) {
    const double angle = mesh.angle(plane);
    return std::min(angle, 2.0 * std::numbers::pi - angle) < kWindow;
  };
  double area = 0.0;
  for (int s = 0; s < mesh.sectors; ++s) {
    for (const Element& element : mesh.elements) {
      if (!element.tread || (!is_near(s) && !is_near(s + 1))) continue;
      const auto X = mesh.coordinates(element, s);
      const Eigen::Vector3d one = X.col(6) - X.col(4), other = X.col(7) - X.col(5);
      area += 0.5 * one.cross(other).norm();
    }
  }
  return area;
}

// A smooth surface through the nodes lies outside the flat facets and is larger. With sectors of 3
// deg the arc is longer than its chords by (0.052 rad)^2 / 24 = 0.011 %; across the tread's
// shoulders the difference is a few times as large.
TEST(TreadSurface, OfShippedTiresCoversTheTreadOfHalfTheRing) {
  for (const char* name : {"passenger_205_55R16", "passenger_225_50R16", "passenger_235_45R20"}) {
    const TireDescription tire =
        read_tire(Document::read(std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/tires" /
                                 (std::string(name) + ".toml"))
                      .root());
    const Mesh mesh = build_mesh(tire);
    ASSERT_TRUE(
        std::ranges::any_of(mesh.elements, [](const Element& e) { return e.tie.eta != 0; }));
    const auto mirror = find_mirror(mesh, build_materials(tire));
    ASSERT_TRUE(mirror) << name;
    const Ring ring(mesh, tire.element);
    const RingUnknowns even(ring, RingSymmetry::even, *mirror);
    const TreadSurface tread(even, TreadShape::smooth, kWindow);
    double area = 0.0;
    for (const TreadSurface::Point& sample : tread.samples()) area += sample.dA;
    const double facets = area_of_facets(mesh);
    EXPECT_NEAR(tread.multiplicity() * area, facets, 2e-3 * facets) << name;
    EXPECT_GE(tread.multiplicity() * area, facets) << name;
  }
}

// A uniform pressure must load every plane in proportion to the halves of its sectors, as the
// elements require, also at the border between narrow and wide sectors. Without (T.3) the last
// plane between narrow sectors, beside a sector of twice the width, got 17 % less. (T.3) is exact
// to first order; a third of the 17 % is allowed.
TEST(TreadSurface, AUniformPressureLoadsPlanesEvenly) {
  TireDescription tire = read_tire(Document::read(std::filesystem::path(LATSCH_SOURCE_DIR) /
                                                  "studies/tires/passenger_205_55R16.toml")
                                       .root());
  constexpr double kDegree = std::numbers::pi / 180.0;
  tire.section.sector_zones = {{4, 1.0 * kDegree}, {6, 2.0 * kDegree}, {4, 3.0 * kDegree}};
  const Ring ring(build_mesh(tire), tire.element);
  const RingUnknowns whole(ring, RingSymmetry::none, {});
  const TreadSurface tread(whole, TreadShape::smooth, kWindow);
  const Mesh& mesh = ring.mesh();
  std::vector<double> force(mesh.sectors, 0.0);
  for (const TreadSurface::Point& point : tread.points()) {
    for (int k = 0; k < point.weights; ++k) {
      const TreadSurface::Weight& weight = tread.weights(point)[k];
      force[tread.places()[weight.place].plane] += weight.w * point.dA;
    }
  }
  double per_angle = 0.0;  // mean load per angle of the planes between narrow sectors
  double largest = 0.0;
  for (int s = 1; mesh.angle(s + 2) < kWindow - 0.1; ++s) {
    const double half = 0.5 * (mesh.angle(s + 1) - mesh.angle(s - 1));
    if (s == 1) per_angle = force[s] / half;
    largest = std::max(largest, std::abs(force[s] / half / per_angle - 1.0));
  }
  EXPECT_LT(largest, 0.17 / 3.0);
}

// Contact points are computed in two steps: averages across the tread, then averages of these
// around it. The result must equal the direct sums over all weights, and must depend only on the
// nodes of the point's cell.
TEST(TreadSurface, PointsAreWhereTheirWeightsSay) {
  const TireDescription tire =
      read_tire(Document::read(LATSCH_SOURCE_DIR "/studies/tires/passenger_225_50R16.toml").root());
  const Mesh mesh = build_mesh(tire);
  const auto mirror = find_mirror(mesh, build_materials(tire));
  ASSERT_TRUE(mirror);
  const Ring ring(mesh, tire.element);
  const RingUnknowns even(ring, RingSymmetry::even, *mirror), odd(ring, RingSymmetry::odd, *mirror);
  for (const RingUnknowns* unknowns : {&even, &odd}) {
    for (const TreadShape shape : {TreadShape::smooth, TreadShape::facets}) {
      const TreadSurface tread(*unknowns, shape, kWindow);
      const Eigen::Matrix3Xd positions =
          tread.positions(1e-2 * Eigen::Matrix3Xd::Random(3, tread.nodes()));
      const Eigen::Matrix3Xd points = tread.points_at(positions);
      ASSERT_EQ(points.cols(), std::ssize(tread.points()));
      for (Eigen::Index k = 0; k < points.cols(); ++k) {
        const TreadSurface::Point& point = tread.points()[k];
        EXPECT_LT((points.col(k) - tread.at(point, positions)).norm(), 1e-14);
        for (const int node : tread.nodes_of(point))
          EXPECT_TRUE(std::ranges::count(tread.cell_nodes()[point.cell], node) == 1);
      }
    }
  }
}

// Under the half turn the image of a tied edge lies on the other side of the wall. If an edge is
// tied elsewhere there, it is not the image.
TEST(TreadSurface, AnEdgeTiedElsewhereIsNoImage) {
  const TireDescription tire =
      read_tire(Document::read(LATSCH_SOURCE_DIR "/studies/tires/passenger_225_50R16.toml").root());
  Mesh mesh = build_mesh(tire);
  const Materials materials = build_materials(tire);
  ASSERT_TRUE(find_mirror(mesh, materials));
  const auto tied =
      std::ranges::find_if(mesh.elements, [](const Element& e) { return e.tie.eta != 0; });
  tied->tie.upper = 0.5 * (tied->tie.lower + tied->tie.upper);
  EXPECT_FALSE(find_mirror(mesh, materials));
}

}  // namespace
}  // namespace latsch::fe_tire
