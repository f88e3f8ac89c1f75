// SPDX-License-Identifier: Apache-2.0
// Tests mass properties against closed forms for bodies of revolution, and against volumes and
// areas that this test integrates on the mesh itself.
#include "models/fe_tire/analysis/mass_properties.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <numbers>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {
namespace {

constexpr double kPi = std::numbers::pi;

/// Returns a mesh whose section, of columns x rows elements, is swept around the spin axis. `at`
/// maps the unit square to (y, r).
Mesh swept(int sectors,
           int columns,
           int rows,
           const std::function<Eigen::Vector2d(double, double)>& at) {
  Mesh mesh;
  mesh.sectors = sectors;
  mesh.region_names = {"all"};
  const int nodes = (columns + 1) * (rows + 1);
  mesh.X.resize(3, nodes);
  for (int i = 0; i <= columns; ++i) {
    for (int j = 0; j <= rows; ++j) {
      const Eigen::Vector2d p = at(static_cast<double>(i) / columns, static_cast<double>(j) / rows);
      mesh.X.col(i * (rows + 1) + j) = Eigen::Vector3d(0.0, p[0], -p[1]);
    }
  }
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const int here = i * (rows + 1) + j, beside = here + rows + 1;
      Element element;
      element.node = {here,
                      here + nodes,
                      beside + nodes,
                      beside,
                      here + 1,
                      here + 1 + nodes,
                      beside + 1 + nodes,
                      beside + 1};
      mesh.elements.push_back(element);
    }
  }
  return mesh;
}

MassProperties of(Mesh mesh,
                  const Materials& materials,
                  ElementKind kind = ElementKind::solid_shell) {
  const Ring ring(std::move(mesh), kind);
  const RingElements elements(ring, materials);
  return mass_properties(elements, Eigen::Matrix3Xd::Zero(3, ring.mesh().nodes_per_sector()));
}

/// Returns values extrapolated to an infinitely fine mesh, from a mesh and one twice as fine, with
/// an error of order h^2.
MassProperties extrapolated(const std::function<MassProperties(int)>& on) {
  const MassProperties coarse = on(1), fine = on(2);
  const auto both = [](double a, double b) { return (4.0 * b - a) / 3.0; };
  return {both(coarse.mass, fine.mass),
          both(coarse.spin_inertia, fine.spin_inertia),
          both(coarse.diametral_inertia, fine.diametral_inertia)};
}

constexpr double kDensity = 1130.0;
Materials rubber() { return {{{Hyperelastic::from_young_modulus(4e6, 0.49), kDensity}}, {}}; }

void expect_near(const MassProperties& found, const MassProperties& expected, double share) {
  EXPECT_NEAR(found.mass, expected.mass, share * expected.mass);
  EXPECT_NEAR(found.spin_inertia, expected.spin_inertia, share * expected.spin_inertia);
  EXPECT_NEAR(
      found.diametral_inertia, expected.diametral_inertia, share * expected.diametral_inertia);
}

// Tube of radii a, b and width w:  m = rho pi (b^2 - a^2) w,  I_spin = m (a^2 + b^2) / 2,
// I_diametral = m (a^2 + b^2) / 4 + m w^2 / 12. The error of order h^4 with 64 sectors, (pi/64)^4,
// is 6e-6.
TEST(MassProperties, OfATube) {
  constexpr double a = 0.2, b = 0.33, w = 0.19;
  const double mass = kDensity * kPi * (b * b - a * a) * w, square = a * a + b * b;
  const MassProperties expected{
      mass, 0.5 * mass * square, 0.25 * mass * square + mass * w * w / 12.0};
  const auto on = [&](int r) {
    return of(
        swept(64 * r,
              8 * r,
              4 * r,
              [&](double s, double t) { return Eigen::Vector2d(w * (0.5 - s), a + t * (b - a)); }),
        rubber());
  };
  expect_near(extrapolated(on), expected, 1e-5);
  // The volume of arcs is exact. Their mass matrix has the error that the header states.
  const double short_by = std::pow(kPi / 64.0, 2) / 3.0;
  EXPECT_NEAR(on(1).mass / mass, 1.0, 1e-12);
  EXPECT_NEAR(on(1).spin_inertia / expected.spin_inertia, 1.0 - short_by, 1e-5);
}

// A hollow torus: R is the radius of its center line; the wall of its section lies between circles
// of radii c and d. Its mass is m = 2 pi^2 rho R (d^2 - c^2). With q2, q4 the integrals over the
// section of r^2 and r^4 about its middle, and A its area:  I_spin = 2 pi rho R (A R^2 + 3 q2 / 2),
// int y^2 dm = 2 pi rho R q2 / 2.
TEST(MassProperties, OfATorus) {
  constexpr double R = 0.28, c = 0.06, d = 0.07;
  const double A = kPi * (d * d - c * c), q2 = 0.5 * kPi * (std::pow(d, 4) - std::pow(c, 4));
  const double spin = 2.0 * kPi * kDensity * R * (A * R * R + 1.5 * q2);
  const MassProperties expected{
      2.0 * kPi * kDensity * R * A, spin, 0.5 * spin + kPi * kDensity * R * q2};
  const auto on = [&](int r) {
    return of(swept(64 * r,
                    48 * r,
                    2 * r,
                    [&](double s, double t) {
                      const double angle = 2.0 * kPi * s, radius = c + t * (d - c);
                      return Eigen::Vector2d(-radius * std::sin(angle),
                                             R + radius * std::cos(angle));
                    }),
              rubber());
  };
  expect_near(extrapolated(on), expected, 2e-5);
}

/// Calls `visit` at points of the cube [-1, 1]^3, or of the square at one zeta: the centers of a
/// grid of n intervals per axis.
void over_cube(int n, const std::function<void(const Eigen::Vector3d&, double)>& visit) {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        visit(Eigen::Vector3d(
                  (2.0 * i + 1.0) / n - 1.0, (2.0 * j + 1.0) / n - 1.0, (2.0 * k + 1.0) / n - 1.0),
              8.0 / (n * n * n));
}

constexpr int kCorner[8][3] = {{-1, -1, -1},
                               {1, -1, -1},
                               {1, 1, -1},
                               {-1, 1, -1},
                               {-1, -1, 1},
                               {1, -1, 1},
                               {1, 1, 1},
                               {-1, 1, 1}};

/// Returns the position and the Jacobian of the element's map at a point of the reference cube.
std::pair<Eigen::Vector3d, Eigen::Matrix3d> map(const Matrix38& X, const Eigen::Vector3d& p) {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
  for (int a = 0; a < 8; ++a) {
    const Eigen::Array3d s(kCorner[a][0], kCorner[a][1], kCorner[a][2]), f = 1.0 + s * p.array();
    x += X.col(a) * f.prod() / 8.0;
    J += X.col(a) * Eigen::RowVector3d(s[0] * f[1] * f[2], s[1] * f[0] * f[2], s[2] * f[0] * f[1]) /
         8.0;
  }
  return {x, J};
}

/// Integrates mass properties over rubber and cord layers by the midpoint rule.
MassProperties measured(const Mesh& mesh, const Materials& materials) {
  MassProperties all;
  constexpr int kPoints = 16;
  const auto add = [&](const Eigen::Vector3d& x, double dm) {
    const double across = x.y() * x.y(), around = x.x() * x.x() + x.z() * x.z();
    all.mass += mesh.sectors * dm;
    all.spin_inertia += mesh.sectors * dm * around;
    all.diametral_inertia += mesh.sectors * dm * (0.5 * around + across);
  };
  for (const Element& element : mesh.elements) {
    const Matrix38 X = mesh.coordinates(element);
    over_cube(kPoints, [&](const Eigen::Vector3d& p, double weight) {
      const auto [x, J] = map(X, p);
      add(x, materials.solids[element.solid].density * J.determinant() * weight);
      if (p.z() > 2.0 / kPoints - 1.0) return;  // points of the square are visited once only
      for (const RebarPlacement& rebar : element.rebars) {
        const CordLayer& cords = materials.layers[rebar.layer];
        const auto [at, G] = map(X, {p.x(), p.y(), rebar.zeta});
        add(at,
            cords.density * cords.thickness * G.col(0).cross(G.col(1)).norm() * weight * kPoints /
                2.0);
      }
    });
  }
  return all;
}

/// Returns a tire in which rows of elements meet on plies, many in the crown and two in the
/// sidewalls, so that some corners of elements are not nodes.
TireDescription tire_of_faces() {
  TireDescription tire = reference_tire_b();
  tire.cord_model = CordModel::rebar;
  tire.section.faces = {{{0.0}, {-0.6e-3}}, {{0.0}, {0.6e-3}}, {{0.0}, {1.7e-3}}};
  tire.section.faces_to = 0.46;
  return tire;
}

// The midpoint rule has a relative error of 1/16^2 of the Jacobian's curvature, about 4e-6. The
// mass matrix of the solid shells overestimates the moments by h^2/12 relative to a radius squared,
// 1e-3 for 60 sectors.
TEST(MassProperties, OfATireAreThoseOfItsVolumesAndCords) {
  const TireDescription tire = tire_of_faces();
  const Mesh mesh = build_mesh(tire);
  const Materials materials = build_materials(tire);
  const MassProperties expected = measured(mesh, materials);
  expect_near(of(mesh, materials, ElementKind::full_integration), expected, 1e-5);
  const MassProperties found = of(mesh, materials);
  // Default elements are arcs: their mass is that of infinitely many sectors.
  const MassProperties round = extrapolated([&](int r) {
    TireDescription finer = tire;
    finer.section.sectors *= r;
    return measured(build_mesh(finer), materials);
  });
  EXPECT_NEAR(found.mass, round.mass, 1e-5 * round.mass);
  expect_near(found, round, 2e-3);
  FeTire whole(mesh, materials);
  EXPECT_NEAR(whole.total_mass(), found.mass, 1e-12 * found.mass);
}

TEST(MassProperties, OfABodyTwiceAsLargeOfTheSameMass) {
  const TireDescription tire = tire_of_faces();
  const Ring ring(build_mesh(tire), ElementKind::solid_shell);
  const RingElements elements(ring, build_materials(tire));
  const MassProperties once = mass_properties(elements, 0.0 * ring.mesh().X),
                       twice = mass_properties(elements, ring.mesh().X);
  expect_near(twice, {once.mass, 4.0 * once.spin_inertia, 4.0 * once.diametral_inertia}, 1e-12);
}

}  // namespace
}  // namespace latsch::fe_tire
