// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/fe_tire/description/reference_tires.h"

namespace latsch::fe_tire {
namespace {

// The reference numbers are from the table of both tires in [Hempel & Oertel 2016].
TEST(MeshBuilder, TiresAAndBHaveTheElementsAndFreedomsOfThePaper) {
  const Mesh a = build_mesh(reference_tire_a()), b = build_mesh(reference_tire_b());
  EXPECT_EQ(a.element_count(), 7020);
  EXPECT_EQ(a.free_dofs(), 27000);
  EXPECT_EQ(b.element_count(), 3480);
  EXPECT_EQ(b.free_dofs(), 15480);
}

/// Returns the volume of a trilinear hexahedron. Its Jacobian is of second degree in each
/// coordinate, so the 2 x 2 x 2 Gauss rule is exact.
double volume(const Eigen::Matrix<double, 3, 8>& X) {
  static constexpr int kSign[8][3] = {{-1, -1, -1},
                                      {1, -1, -1},
                                      {1, 1, -1},
                                      {-1, 1, -1},
                                      {-1, -1, 1},
                                      {1, -1, 1},
                                      {1, 1, 1},
                                      {-1, 1, 1}};
  double sum = 0.0;
  for (const auto& g : kSign) {
    const Eigen::Vector3d p = Eigen::Vector3d(g[0], g[1], g[2]) / std::sqrt(3.0);
    Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
    for (int a = 0; a < 8; ++a) {
      const Eigen::Array3d f(
          1 + kSign[a][0] * p[0], 1 + kSign[a][1] * p[1], 1 + kSign[a][2] * p[2]);
      const Eigen::RowVector3d dN(
          kSign[a][0] * f[1] * f[2], kSign[a][1] * f[0] * f[2], kSign[a][2] * f[0] * f[1]);
      J += X.col(a) * dN / 8.0;
    }
    sum += J.determinant();
  }
  return sum;
}

double volume(const Mesh& mesh) {
  double sum = 0.0;
  for (const Element& element : mesh.elements) sum += volume(mesh.coordinates(element));
  return mesh.sectors * sum;
}

/// Returns the volume swept by the section, by Green's and Pappus' theorems along its outline: V =
/// 2 pi int r dA = pi | closed int r^2 dy |.
double swept_volume(const Section& section) {
  constexpr int kSteps = 20000;
  const Contour line(section.contour);
  const auto edge = [&](bool outside) {
    double sum = 0.0;
    MeridianPoint last;
    for (int i = 0; i <= kSteps; ++i) {
      const double s = 2.0 * i / kSteps - 1.0, q = std::abs(s);
      const MeridianPoint p =
          line.offset(s, outside ? section.outside.at(q) : -section.inside.at(q));
      if (i > 0) sum += (last.r * last.r + last.r * p.r + p.r * p.r) / 3.0 * (last.y - p.y);
      last = p;
    }
    return sum;
  };
  const auto bead = [&](double s) {  // straight edge of the section at the bead
    const double q = std::abs(s);
    const MeridianPoint a = line.offset(s, -section.inside.at(q)),
                        b = line.offset(s, section.outside.at(q));
    return (a.r * a.r + a.r * b.r + b.r * b.r) / 3.0 * (b.y - a.y);
  };
  return std::numbers::pi * (edge(true) - edge(false) + bead(1.0) - bead(-1.0));
}

TEST(MeshBuilder, VolumeOfACylinderIsThatOfItsPolygon) {
  TireDescription tire = reference_tire_b();
  tire.section.contour = {{0.0, 0.3}, {0.05, 0.3}, {0.1, 0.3}};
  tire.section.inside = {{0.0}, {0.006}};
  tire.section.outside = {{0.0}, {0.009}};
  const double n = tire.section.sectors, angle = 2.0 * std::numbers::pi / n;
  const double polygon = 0.5 * n * std::sin(angle) * (0.309 * 0.309 - 0.294 * 0.294) * 0.2;
  EXPECT_NEAR(volume(build_mesh(tire)), polygon, 1e-12 * polygon);
  EXPECT_NEAR(swept_volume(tire.section) * std::sin(angle) / angle, polygon, 1e-9 * polygon);
}

// Many rows of elements end on the straight edge of two rows. The elements must neither leave a gap
// nor overlap there. Faces inside the wall do not move its surface, so the volume must equal that
// of a mesh with two rows everywhere.
TEST(MeshBuilder, RowsThatEndInTheSidewallLeaveTheVolume) {
  TireDescription tire = reference_tire_b();
  tire.cord_model = CordModel::rebar;
  for (int refinement : {1, 2, 3}) {
    tire.section.faces.clear();
    const Mesh two = build_mesh(tire, refinement);
    tire.section.faces = {{{0.0}, {-0.6e-3}}, {{0.0}, {0.6e-3}}, {{0.0}, {1.7e-3}}};
    tire.section.faces_to = 0.46;
    const Mesh many = build_mesh(tire, refinement);
    EXPECT_TRUE(
        std::ranges::any_of(many.elements, [](const Element& e) { return e.tie.eta != 0; }));
    // Faces of the elements are bilinear; if they are twisted, the enclosed volume has an error of
    // second order.
    EXPECT_NEAR(volume(many), volume(two), 1e-4 / refinement / refinement * volume(two));
  }
}

// All nodes lie on the true contour, so the volume converges with order 2 to that of the swept
// section.
TEST(MeshBuilder, VolumeConvergesToTheSweptSectionWithOrderTwo) {
  for (TireDescription tire : {reference_tire_a(), reference_tire_b()}) {
    // The thickness is constant, since kinks between nodes would disturb the convergence.
    tire.section.inside = {{0.0}, {5e-3}};
    tire.section.outside = {{0.0}, {7e-3}};
    const double exact = swept_volume(tire.section);
    const double e1 = exact - volume(build_mesh(tire, 1)), e2 = exact - volume(build_mesh(tire, 2)),
                 e4 = exact - volume(build_mesh(tire, 4));
    EXPECT_GT(e1, 0.0);  // a polygon of chords lies inside the curve
    EXPECT_NEAR(std::log2(e1 / e2), 2.0, 0.2) << tire.name;
    EXPECT_NEAR(std::log2(e2 / e4), 2.0, 0.2) << tire.name;
    EXPECT_LT(e1, 0.02 * exact);
  }
}

/// Returns the total mass of rubber and cords, kg.
double mass(const Mesh& mesh, const Materials& materials) {
  double sum = 0.0;
  for (const Element& element : mesh.elements) {
    const auto X = mesh.coordinates(element);
    sum += materials.solids[element.solid].density * volume(X);
    for (const RebarPlacement& rebar : element.rebars) {
      const CordLayer& layer = materials.layers[rebar.layer];
      const double w = 0.5 * (1.0 + rebar.zeta);
      const Eigen::Matrix<double, 3, 4> M = (1.0 - w) * X.leftCols<4>() + w * X.rightCols<4>();
      const double area = 0.5 * (M.col(2) - M.col(0)).cross(M.col(3) - M.col(1)).norm();
      sum += layer.density * layer.thickness * area;
    }
  }
  return mesh.sectors * sum;
}

TireDescription with_rebars() {
  TireDescription tire = reference_tire_b();
  tire.cord_model = CordModel::rebar;
  const double offsets[] = {-2e-3, -0.8e-3, 0.5e-3, 1.5e-3};
  for (std::size_t i = 0; i < tire.plies.size(); ++i) {
    tire.plies[i].offset = {{0.0}, {offsets[i]}};
    tire.plies[i].cords.density = 5000.0;
  }
  return tire;
}

TEST(MeshBuilder, RefinementKeepsTheMassWithinTheGeometricError) {
  const TireDescription tire = with_rebars();
  const Materials materials = build_materials(tire);
  const double m1 = mass(build_mesh(tire, 1), materials), m2 = mass(build_mesh(tire, 2), materials),
               m3 = mass(build_mesh(tire, 3), materials);
  EXPECT_NEAR(m1, m3, 0.008 * m3);
  EXPECT_LT(std::abs(m2 - m3), 0.3 * std::abs(m1 - m3));
}

// Every ply must cross each column of elements that it covers exactly once, at its given distance
// from the reference line.
TEST(MeshBuilder, RefinementKeepsTheCordsAtTheirPlaceInTheWall) {
  const TireDescription tire = with_rebars();
  const Contour line(tire.section.contour);
  for (int r : {1, 2, 3}) {
    const Mesh mesh = build_mesh(tire, r);
    const int rows = 2 * r, columns = 29 * r;
    int found = 0;
    for (int i = 0; i < columns; ++i) {
      const double s = (2.0 * i + 1.0) / columns - 1.0;
      for (int k = 0; k < rows; ++k) {
        const Element& element = mesh.elements[i * rows + k];
        for (const RebarPlacement& rebar : element.rebars) {
          ++found;
          EXPECT_LE(std::abs(rebar.zeta), 1.0);
          // p is the center of the cord layer in the element's section, between its two columns of
          // nodes in the sector plane.
          const auto X = mesh.coordinates(element);
          const double w = 0.5 * (1.0 + rebar.zeta);
          const Eigen::Vector3d p =
              0.5 * ((1.0 - w) * (X.col(0) + X.col(3)) + w * (X.col(4) + X.col(7)));
          double nearest = 1.0;
          for (const CordPly& ply : tire.plies) {
            const MeridianPoint q = line.offset(s, ply.offset.at(std::abs(s)));
            nearest = std::min(nearest, std::hypot(p.y() - q.y, -p.z() - q.r));
          }
          EXPECT_LT(nearest, 1e-3 / (r * r));  // tolerance: distance between chord and arc
        }
      }
    }
    int expected = 0;
    for (int i = 0; i < 29; ++i)
      for (const CordPly& ply : tire.plies)
        expected += ply.extent.contains(std::abs((2.0 * i + 1.0) / 29 - 1.0)) ? r : 0;
    EXPECT_EQ(found, expected);
  }
}

TEST(MeshBuilder, RefinementKeepsTheClampedAndTreadBoundary) {
  const TireDescription tire = reference_tire_b();
  const Mesh mesh = build_mesh(tire, 2);
  EXPECT_EQ(mesh.sectors, 120);
  // 3 nodes at each of the two beads, from the reference line to the outer face
  EXPECT_EQ(mesh.clamped.size(), 2u * 3u);
  const Mesh coarse = build_mesh(tire);
  const auto tread_count = [](const Mesh& m) {
    return std::count_if(
        m.elements.begin(), m.elements.end(), [](const Element& e) { return e.tread; });
  };
  EXPECT_EQ(tread_count(mesh), 2 * tread_count(coarse));
}

TEST(MeshBuilder, ChangedModuliKeepTheMeshAndAChangedContourDoesNot) {
  const TireDescription a = reference_tire_b();
  TireDescription b = a;
  b.rubbers[0].law.C10 *= 2.0;
  b.plies[1].cords.E_tension *= 3.0;
  b.plies[1].cords.angle += 0.1;
  EXPECT_TRUE(same_mesh(a, b));
  b.section.contour[3].r += 1e-3;
  EXPECT_FALSE(same_mesh(a, b));
}

TEST(Mesh, SectorsAreCountedFromTheBottomTowardTheFront) {
  const Mesh mesh = build_mesh(reference_tire_b());
  const Eigen::Vector3d quarter = mesh.frame(mesh.sectors / 4) * Eigen::Vector3d(0, 0, -1);
  EXPECT_NEAR((quarter - Eigen::Vector3d::UnitX()).norm(), 0.0, 1e-15);
  Eigen::Matrix3d round = Eigen::Matrix3d::Identity();
  for (int s = 0; s < mesh.sectors; ++s) round = mesh.sector_rotation() * round;
  EXPECT_NEAR((round - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-13);
  // The radius is the reference line's radius plus the tread's thickness, minus the sag of half a
  // column of elements.
  EXPECT_NEAR(mesh.outer_radius(), 0.310 + 0.009, 5e-5);
}

TEST(Mesh, EtaRunsFromTheLeftBeadAndZetaOutward) {
  const Mesh mesh = build_mesh(reference_tire_b());
  const auto X = mesh.coordinates(mesh.elements[2 * 14]);  // element at the crown
  EXPECT_GT(X(0, 1), X(0, 0));
  EXPECT_LT(X(1, 3), X(1, 0));
  EXPECT_LT(X(2, 4), X(2, 0));
}

TEST(Mesh, AnInvertedElementIsNamedWithItsPlace) {
  Mesh mesh = build_mesh(reference_tire_b());
  std::swap(mesh.elements[7].node[0], mesh.elements[7].node[4]);
  try {
    check(mesh);
    FAIL() << "an inverted element passed";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("element 7"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("r = "), std::string::npos) << error.what();
  }
}

// The relative lengths are 2 at the crown and 1/2 at the bead. The columns there must have this
// ratio within 10 %, because each has the mean of the profile over its own length. A refined mesh
// must contain the nodes of the coarse one.
TEST(MeshBuilder, SectorZonesAreMirroredAtTheContactAndNestWhenRefined) {
  constexpr double kDegree = M_PI / 180.0;
  TireDescription tire = reference_tire_b();
  tire.section.sectors = 20;
  tire.section.sector_zones = {{4, 5.0 * kDegree}, {2, 10.0 * kDegree}};
  const Mesh mesh = build_mesh(tire), fine = build_mesh(tire, 2);
  for (int s = 0; s <= 4; ++s) EXPECT_NEAR(mesh.angle(s), 5.0 * kDegree * s, 1e-15);
  EXPECT_NEAR(mesh.angle(6), 40.0 * kDegree, 1e-15);
  EXPECT_NEAR(mesh.angle(7), 75.0 * kDegree, 1e-15);  // four sectors share the rest of the ring
  EXPECT_EQ(mesh.angle(10), M_PI);
  for (int s = 0; s <= 20; ++s) {
    EXPECT_NEAR(mesh.angle(s) + mesh.angle(20 - s), 2.0 * M_PI, 1e-14);
    EXPECT_NEAR(fine.angle(2 * s), mesh.angle(s), 1e-14);
  }
  Eigen::Matrix3d round = Eigen::Matrix3d::Identity();
  for (int s = 0; s < 20; ++s) round = round * mesh.sector_rotation(s);
  EXPECT_LT((round - Eigen::Matrix3d::Identity()).norm(), 1e-13);
}

TEST(MeshBuilder, SpacingShortensTheElementsWhereAsked) {
  TireDescription tire = reference_tire_b();
  tire.section.spacing = {{0.0, 1.0}, {2.0, 0.5}};
  const Section& section = tire.section;
  const double at_bead = section.station(1) - section.station(0);
  const double at_crown = section.station(15) - section.station(14);
  EXPECT_NEAR(at_crown / at_bead, 4.0, 0.4);
  EXPECT_EQ(section.station(0), -1.0);
  EXPECT_EQ(section.station(29), 1.0);
  const Mesh coarse = build_mesh(tire), fine = build_mesh(tire, 2);
  const int rows = 3, fine_rows = 5;
  for (int i = 0; i <= 29; ++i) {
    EXPECT_LT((coarse.X.col(i * rows) - fine.X.col(2 * i * fine_rows)).norm(), 1e-12) << i;
  }
}

}  // namespace
}  // namespace latsch::fe_tire
