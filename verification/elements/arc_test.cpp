// SPDX-License-Identifier: Apache-2.0
// Tests arcs: in axisymmetric states the forces of an element, per angle, do not depend on the
// width of its sector, and neither does the force through the section plane. Rigid motions that the
// map keeps cause no force. The stiffness is the derivative of the forces.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "models/fe_tire/element/hex8_batch.h"
#include "models/fe_tire/element/hex8_shape.h"

namespace latsch::fe_tire {
namespace {

constexpr int kEnds[4][2] = {{0, 1}, {3, 2}, {4, 5}, {7, 6}};

/// Section of an inclined, tapered element: radius, axial position and place along the
/// circumference (m) of its four corners.
struct Section {
  double r[4], y[4], v[4];
};
constexpr Section kUnloaded = {
    {0.3000, 0.2980, 0.3015, 0.2995}, {0.0600, 0.0500, 0.0602, 0.0503}, {0.0, 0.0, 0.0, 0.0}};
constexpr Section kRound = {
    {0.3010, 0.3002, 0.3028, 0.3019}, {0.0590, 0.0498, 0.0590, 0.0500}, {0.0, 0.0, 0.0, 0.0}};
/// This state is sheared along the circumference by 4 percent, and else as kRound.
constexpr Section kTwisted = {
    {0.3010, 0.3002, 0.3028, 0.3019}, {0.0590, 0.0498, 0.0590, 0.0500}, {0.0, 3e-5, 6e-5, 9e-5}};

/// Returns the corners, m, of a sector with the angle 2 h in the frame of its first plane.
Matrix38 corners(const Section& at, double h) {
  Matrix38 X;
  for (int k = 0; k < 4; ++k) {
    for (int end = 0; end < 2; ++end) {
      const double s = end * std::sin(2.0 * h), c = end == 1 ? std::cos(2.0 * h) : 1.0;
      X.col(kEnds[k][end]) << at.v[k] * c + at.r[k] * s, at.y[k], at.v[k] * s - at.r[k] * c;
    }
  }
  return X;
}

struct Arc {
  double h;
  bool has_cords;
  double pressure = 0.0;
  Matrix38 X = corners(kUnloaded, h);
  HexShape shape = make_arc_shape(X, h, 0.0);
  Materials materials;
  Element element;

  Arc(double half_angle, bool cords, double p) : h(half_angle), has_cords(cords), pressure(p) {
    materials.solids.push_back({Hyperelastic{.C10 = 0.8e6, .C01 = 0.2e6, .K = 100e6}, 1150.0});
    materials.layers = {{.E_tension = 2e9, .E_compression = 2e8, .thickness = 1e-3, .angle = 0.4},
                        {.E_tension = 3e9, .E_compression = 2e8, .thickness = 5e-4, .angle = 1.57}};
    if (cords) element.rebars = {{0, 0.3}, {1, -0.5}};
  }
  /// Returns forces and stiffness, in the frames of the nodes, for corners at x, m.
  Vector24 force(const Matrix38& x, Matrix24* K = nullptr) const {
    ElementBatch batch;
    batch.count = 1;
    double alpha[8] = {};
    batch.set(0, x - X, alpha, 8);
    const ElementSurroundings around{.pressure = pressure,
                                     .turned = 0b01100110,
                                     .cosine = std::cos(2.0 * h),
                                     .sine = -std::sin(2.0 * h)};
    const ElementLaw law = element_law(shape, materials, element);
    EXPECT_EQ(evaluate(law, around, K ? Stiffness::exact : Stiffness::none, batch), 1u);
    Vector24 f;
    batch.take(0, f, K, alpha, 8);
    return f;
  }
};

/// Forces on the corners of a section, in its own frame: both planes together, N/rad, and half of
/// the difference of both planes, N, freed of its share of the radial and tangential sums. This
/// share cancels in equilibrium, where the sums of all elements vanish.
struct SectionForces {
  Eigen::Matrix<double, 3, 4> per_angle, through;

  SectionForces(const Arc& arc, const Section& at) {
    const Vector24 f = arc.force(corners(at, arc.h));
    const double share = 1.0 / arc.h - 1.0 / std::tan(arc.h);
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector3d first = f.segment<3>(3 * kEnds[k][0]);
      const Eigen::Vector3d next = f.segment<3>(3 * kEnds[k][1]);
      per_angle.col(k) = (next + first) / (2.0 * arc.h);
      through.col(k) = 0.5 * (next - first);
      // A turn by a right angle takes the radial sum to the tangent and the tangential to the
      // radius.
      const double x = arc.h * per_angle(0, k), z = arc.h * per_angle(2, k);
      through(0, k) -= share * z;
      through(2, k) += share * x;
    }
  }
};

/// Compares sectors with those of h = 0.001. Relative tolerance: rounding + share h^2.
void expect_same(
    const Section& state, bool cords, double pressure, double rounding, double share = 0.0) {
  const SectionForces fine(Arc(1e-3, cords, pressure), state);
  for (const double h : {0.02, 0.06, 0.13}) {
    const SectionForces wide(Arc(h, cords, pressure), state);
    const double tolerance = rounding + share * h * h;
    EXPECT_LT((wide.per_angle - fine.per_angle).norm(), tolerance * fine.per_angle.norm()) << h;
    EXPECT_LT((wide.through - fine.through).norm(), tolerance * fine.through.norm()) << h;
  }
}

TEST(Arcs, RoundStatesHaveTheSameForcesInSectorsOfAnyWidth) {
  expect_same(kRound, false, 0.0, 1e-9);
  expect_same(kRound, false, 2.4e5, 1e-9);
}

TEST(Arcs, CordsOfRoundStatesHaveTheSameForcesInSectorsOfAnyWidth) {
  expect_same(kRound, true, 0.0, 1e-7);
  expect_same(kRound, true, 2.4e5, 1e-7);
}

// Shear along the circumference leaves the squares of the hourglass vectors in E_22, equation (4)
// of hex8_solid_shell_kernel.h. The forces of this nearly incompressible element then differ by
// 0.033 h^2.
TEST(Arcs, TwistedStatesHaveNearlyTheSameForces) {
  expect_same(kTwisted, false, 2.4e5, 1e-7, 0.05);
  expect_same(kTwisted, true, 2.4e5, 1e-7, 0.05);
}

// A brick of 7.5 degrees, between chords, errs by percents of the forces per angle.
TEST(Arcs, BricksDoNotHaveTheSameForces) {
  Arc fine(1e-3, true, 2.4e5), wide(0.13, true, 2.4e5);
  wide.shape = make_shape(ElementKind::solid_shell, wide.X);
  const SectionForces a(fine, kRound), b(wide, kRound);
  EXPECT_GT((b.per_angle - a.per_angle).norm(), 1e-3 * a.per_angle.norm());
}

TEST(Arcs, VolumeIsThatOfTheBodyOfRevolution) {
  double thin = 0.0, wide = 0.0;
  for (double dV : Arc(1e-4, false, 0.0).shape.dV) thin += dV / 1e-4;
  for (double dV : Arc(0.13, false, 0.0).shape.dV) wide += dV / 0.13;
  EXPECT_NEAR(wide, thin, 1e-12 * thin);
}

TEST(Arcs, TurnsAboutTheSpinAxisAndTranslationsCauseNoForce) {
  const Arc arc(0.06, true, 0.0);
  const double scale = arc.force(corners(kRound, arc.h)).norm();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const Eigen::Vector3d away(0.01, -0.02, 0.03);
  EXPECT_LT(arc.force((turn * arc.X).colwise() + away).norm(), 1e-9 * scale);
  // Turns about the radius of the middle are free of strain to first order in the angle.
  const Eigen::Vector3d radius(std::sin(arc.h), 0.0, -std::cos(arc.h));
  const double small = 1e-6;
  const Eigen::Matrix3d steered = Eigen::AngleAxisd(small, radius).toRotationMatrix();
  EXPECT_LT(arc.force(steered * arc.X).norm(), 1e-4 * small * scale);
}

// The turn about the tangent is not free of strain: its forces must fall with the square of the
// width, relative to those of the same turn of the section alone.
TEST(Arcs, TurnsAboutTheTangentAreFreeOfStrainToSecondOrderInTheWidth) {
  const auto stretch = [](double h) {
    const Arc arc(h, true, 0.0);
    const Eigen::Vector3d tangent(std::cos(h), 0.0, std::sin(h));
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1e-4, tangent).toRotationMatrix();
    return arc.force(turn * arc.X).norm() / h;
  };
  const double ratio = stretch(0.06) / stretch(0.03);
  EXPECT_NEAR(ratio, 4.0, 0.4);
}

// Richardson extrapolation of two central differences.
TEST(Arcs, StiffnessIsTheDerivativeOfTheForces) {
  const Arc arc(0.06, true, 0.0);
  Matrix38 x = corners(kRound, arc.h);
  for (int k = 0; k < 24; ++k) x.data()[k] += 1e-4 * std::sin(0.7 + 1.3 * k * k);
  Matrix24 K, difference;
  arc.force(x, &K);
  // Unknowns are displacements in the frame of the first plane; K is in the frames of the nodes.
  Matrix24 Q = Matrix24::Identity();
  const double c = std::cos(2.0 * arc.h), s = std::sin(2.0 * arc.h);
  Eigen::Matrix3d turn;
  turn << c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c;
  for (int a : {1, 2, 5, 6}) Q.block<3, 3>(3 * a, 3 * a) = turn;
  const auto slope = [&](int j, double step) {
    Matrix38 way;
    way.reshaped() = step * Q.col(j);
    return Vector24((arc.force(x + way) - arc.force(x - way)) / (2.0 * step));
  };
  for (int j = 0; j < 24; ++j) difference.col(j) = (4.0 * slope(j, 1e-7) - slope(j, 2e-7)) / 3.0;
  EXPECT_LT((K - difference).norm(), 1e-8 * K.norm());
  EXPECT_LT((K - K.transpose()).norm(), 1e-14 * K.norm());
}

}  // namespace
}  // namespace latsch::fe_tire
