// SPDX-License-Identifier: Apache-2.0
// Tests single elements: their tangents, their behavior under rotation, their mass.
#include "models/fe_tire/element/hex8.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "models/fe_tire/element/hex8_batch.h"
#include "models/fe_tire/element/hex8_shape.h"
#include "models/fe_tire/element/hyperelastic.h"
#include "numerics/kernels/kernel_set.h"

namespace latsch::fe_tire {
namespace {

/// Generates reproducible numbers in [-1, 1].
class Sequence {
 public:
  double next() {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<double>(state_ >> 11) / 4503599627370496.0 - 1.0;
  }

 private:
  unsigned long long state_ = 1;
};

/// Returns the coordinates of a distorted, curved element as in a tire, 32 x 14 x 5 mm, 0.3 m below
/// the axis.
Matrix38 distorted_element() {
  Sequence random;
  Matrix38 X;
  for (int a = 0; a < 8; ++a) {
    const double theta = 0.05 * kXi[a], r = 0.300 + 0.0025 * kZeta[a];
    X.col(a) << r * std::sin(theta), 0.02 - 0.007 * kEta[a], -r * std::cos(theta);
    for (int i = 0; i < 3; ++i) X(i, a) += 4e-4 * random.next();
  }
  return X;
}

Materials materials() {
  Matrix6 A;
  Sequence random;
  for (int i = 0; i < 36; ++i) A(i / 6, i % 6) = random.next();
  Materials m;
  m.solids.push_back({Hyperelastic{.C10 = 0.8e6, .C01 = 0.2e6, .K = 100e6}, 1150.0});
  m.solids.push_back(
      {StVenantKirchhoff{Matrix6(1e7 * (A * A.transpose() + Matrix6::Identity()))}, 1600.0});
  m.layers.push_back({.E_tension = 2e9,
                      .E_compression = 2e8,
                      .thickness = 1e-3,
                      .angle = 0.4,
                      .pretension = 1e6,
                      .density = 3000.0});
  return m;
}

Element element(int solid, bool cords) {
  Element e{.node = {0, 1, 2, 3, 4, 5, 6, 7}, .solid = solid, .rebars = {}, .tie = {}};
  if (cords) e.rebars = {{0, 0.3}};
  return e;
}

Matrix38 random_displacement(double size) {
  Sequence random;
  for (int i = 0; i < 7; ++i) random.next();
  Matrix38 u;
  for (int a = 0; a < 8; ++a) {
    for (int i = 0; i < 3; ++i) u(i, a) = size * random.next();
  }
  return u;
}

struct Case {
  ElementKind kind;
  int solid;
  bool cords;
};

std::string name_of(const Case& c) {
  return std::string(c.kind == ElementKind::full_integration ? "Full" : "SolidShell") +
         (c.solid == 0 ? "Rubber" : "Composite") + (c.cords ? "Cords" : "");
}

void PrintTo(const Case& c, std::ostream* out) { *out << name_of(c); }

class Hex8 : public testing::TestWithParam<Case> {
 protected:
  Vector24 force(const Matrix38& u) const {
    Vector24 f;
    std::vector<double> alpha(internal_parameters(GetParam().kind) + 1, 0.0);
    EXPECT_TRUE(evaluate(shape, m, e, u, alpha.data(), f, nullptr));
    return f;
  }
  Materials m = materials();
  Element e = element(GetParam().solid, GetParam().cords);
  HexShape shape = make_shape(GetParam().kind, distorted_element());
};

// An element whose corners are tied to the line between two nodes must equal, except for rounding,
// a free element with corners at the same positions. The forces on the nodes must do the same work
// as those on the corners.
TEST_P(Hex8, TiedCornersAreTheFreeElementWithTheSameWork) {
  Matrix24 T = Matrix24::Identity();  // matrix from the displacements of nodes to those of corners
  for (int upper : {6, 7}) {
    const int lower = upper == 6 ? 2 : 3;
    for (int i = 0; i < 3; ++i) {
      const int l = 3 * lower + i, u = 3 * upper + i;
      T(l, l) = 0.75;
      T(l, u) = 0.25;
      T(u, l) = 0.4;
      T(u, u) = 0.6;
    }
  }
  const Matrix38 nodes = random_displacement(2e-4);
  const Vector24 corners = T * nodes.reshaped();
  Vector24 f, f_free;
  Matrix24 K, K_free;
  std::vector<double> alpha(internal_parameters(GetParam().kind) + 1, 0.0), alpha_free = alpha;
  ASSERT_TRUE(
      evaluate(shape, m, e, Matrix38(corners.reshaped(3, 8)), alpha_free.data(), f_free, &K_free));
  Element tied = e;
  tied.tie = {.eta = 1, .lower = 0.25, .upper = 0.6};
  ASSERT_TRUE(evaluate(shape, m, tied, nodes, alpha.data(), f, &K));
  EXPECT_LT((f - T.transpose() * f_free).norm(), 1e-12 * f_free.norm());
  EXPECT_LT((K - T.transpose() * K_free * T).norm(), 1e-12 * K_free.norm());
  EXPECT_NEAR(mass(shape, m, tied).sum(), mass(shape, m, e).sum(), 1e-12 * mass(shape, m, e).sum());
}

// Richardson extrapolation of two central differences has an error of O(h^4). The tolerance of 1e-8
// also allows for rounding.
TEST_P(Hex8, TangentIsTheDerivativeOfTheForce) {
  const Matrix38 u = random_displacement(2e-4);
  Vector24 f;
  Matrix24 K, difference;
  std::vector<double> alpha(internal_parameters(GetParam().kind) + 1, 0.0);
  ASSERT_TRUE(evaluate(shape, m, e, u, alpha.data(), f, &K));
  const auto slope = [&](int j, double h) {
    Matrix38 plus = u, minus = u;
    plus(j % 3, j / 3) += h;
    minus(j % 3, j / 3) -= h;
    return Vector24((force(plus) - force(minus)) / (2.0 * h));
  };
  for (int j = 0; j < 24; ++j) difference.col(j) = (4.0 * slope(j, 1e-7) - slope(j, 2e-7)) / 3.0;
  EXPECT_LT((K - difference).norm(), 1e-8 * K.norm());
  EXPECT_LT((K - K.transpose()).norm(), 1e-14 * K.norm());
}

TEST_P(Hex8, RigidRotationGivesNoForce) {
  if (GetParam().cords) m.layers[0].pretension = 0.0;
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(1.3, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Matrix38 u = (R * shape.X - shape.X).colwise() + Eigen::Vector3d(0.1, 0.2, -0.3);
  const double scale =
      force(random_displacement(1e-4)).norm();  // norm of the forces at strains of about a percent
  EXPECT_LT(force(u).norm(), 1e-10 * scale);
}

TEST_P(Hex8, ForcesAndMomentsBalance) {
  const Matrix38 u = random_displacement(2e-4);
  const Vector24 f = force(u);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), moment = sum;
  for (int a = 0; a < 8; ++a) {
    const Eigen::Vector3d x = shape.X.col(a) + u.col(a);
    sum += f.segment<3>(3 * a);
    moment += x.cross(Eigen::Vector3d(f.segment<3>(3 * a)));
  }
  EXPECT_LT(sum.norm(), 1e-12 * f.norm());
  EXPECT_LT(moment.norm(), 1e-12 * f.norm());
}

TEST_P(Hex8, AnInvertedElementIsRefused) {
  Matrix38 u = Matrix38::Zero();
  u.rightCols<4>() = -2.0 * (shape.X.rightCols<4>() - shape.X.leftCols<4>());
  Vector24 f;
  std::vector<double> alpha(internal_parameters(GetParam().kind) + 1, 0.0);
  EXPECT_FALSE(evaluate(shape, m, e, u, alpha.data(), f, nullptr));
}

/// Evaluates elements of one law with displacements between zero and 0.2 mm, with pressure on their
/// inner faces, and with the nodes of one side in another frame.
ElementBatch evaluated_batch(const ElementLaw& law, int first, int count) {
  const ElementSurroundings around{
      .pressure = 2e5, .turned = 0b01100110, .cosine = std::cos(0.1), .sine = -std::sin(0.1)};
  ElementBatch batch;
  batch.count = count;
  const double none[8] = {};
  for (int k = 0; k < count; ++k) {
    batch.set(
        k, random_displacement(5e-5 * (first + k)), none, internal_parameters(law.shape->kind));
  }
  EXPECT_EQ(evaluate(law, around, Stiffness::exact, batch), (1u << count) - 1);
  return batch;
}

TEST_P(Hex8, NeighborsInABatchDoNotChangeABit) {
  const ElementLaw law = element_law(shape, m, e);
  const ElementBatch together = evaluated_batch(law, 0, 5);
  for (int k = 0; k < 5; ++k) {
    const ElementBatch alone = evaluated_batch(law, k, 1);
    for (int i = 0; i < 24; ++i) EXPECT_EQ(together.f[i][k], alone.f[i][0]);
    for (int i = 0; i < ElementBatch::kEntries; ++i) EXPECT_EQ(together.K[i][k], alone.K[i][0]);
    for (int i = 0; i < internal_parameters(shape.kind); ++i) {
      EXPECT_EQ(together.alpha[i][k], alone.alpha[i][0]);
    }
  }
}

// Kernel sets with a fused multiply-add must give identical bits. The baseline set rounds more
// often.
TEST_P(Hex8, KernelSetsAgree) {
  const ElementLaw law = element_law(shape, m, e);
  // Choice independent of the environment variable LATSCH_KERNELS.
  const WithKernelSet fused(kernel_sets().back());
  const ElementBatch best = evaluated_batch(law, 0, 5);
  const double size = std::abs(best.K[0][4]);
  for (const KernelSet set : kernel_sets()) {
    const WithKernelSet with(set);
    const ElementBatch other = evaluated_batch(law, 0, 5);
    const double tolerance = set == KernelSet::baseline ? 1e-10 * size : 0.0;
    for (int i = 0; i < ElementBatch::kEntries; ++i) {
      for (int k = 0; k < 5; ++k) EXPECT_NEAR(other.K[i][k], best.K[i][k], tolerance);
    }
  }
}

TEST_P(Hex8, MassIsThatOfRubberAndCords) {
  const Matrix8 M = mass(shape, m, e);
  double expected = 0.0;
  for (double dV : shape.dV) expected += m.solids[e.solid].density * dV;
  if (GetParam().cords)
    expected += 3000.0 * 1e-3 * 0.03 * 0.014;  // the area of the cord layer is approximate
  EXPECT_NEAR(M.sum(), expected, GetParam().cords ? 1e-2 * expected : 1e-14 * expected);
  EXPECT_LT((M - M.transpose()).norm(), 1e-15 * M.norm());
}

std::string case_name(const testing::TestParamInfo<Case>& info) { return name_of(info.param); }

INSTANTIATE_TEST_SUITE_P(Kinds,
                         Hex8,
                         testing::Values(Case{ElementKind::full_integration, 0, false},
                                         Case{ElementKind::full_integration, 0, true},
                                         Case{ElementKind::full_integration, 1, true},
                                         Case{ElementKind::solid_shell, 0, false},
                                         Case{ElementKind::solid_shell, 0, true},
                                         Case{ElementKind::solid_shell, 1, true}),
                         case_name);

}  // namespace
}  // namespace latsch::fe_tire
