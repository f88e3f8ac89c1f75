// SPDX-License-Identifier: Apache-2.0
// Patch test: on a distorted mesh, a uniform deformation is an equilibrium and gives the exact
// uniform stress, whatever the shape of the elements. [Irons & Razzaque 1972; MacNeal & Harder
// 1985, Finite Elements Anal. Des. 1] The deformation is finite. Inner nodes must carry no force
// (relative to the resultant on a face), and the resultants on the faces must be P N A with the
// first Piola-Kirchhoff stress P, the normal N and the area A. The tolerance 1e-10 is rounding
// times the bulk modulus.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>
#include <string>

#include "models/fe_tire/element/cord_law.h"
#include "models/fe_tire/element/hyperelastic.h"
#include "small_model.h"

namespace latsch::verification {
namespace {

constexpr double kSize = 0.03;  // m
constexpr int kElements = 3;    // along each edge

const Eigen::Matrix3d kF =
    (Eigen::Matrix3d() << 1.08, 0.05, -0.03, 0.02, 0.94, 0.04, 0.01, -0.06, 1.02).finished();

struct Case {
  std::string name;
  ElementKind kind;
  Solid solid;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

std::vector<Case> cases() {
  std::vector<Case> all;
  Matrix6 D = Matrix6::Zero();
  D.topLeftCorner<3, 3>().setConstant(4e6);
  D.diagonal() << 10e6, 10e6, 10e6, 3e6, 3e6, 3e6;
  for (auto [name, kind] : {std::pair{"Full", ElementKind::full_integration},
                            std::pair{"SolidShell", ElementKind::solid_shell}}) {
    all.push_back({std::string(name) + "Soft",
                   kind,
                   {Hyperelastic{.C10 = 1e6, .C01 = 0.3e6, .K = 10e6}, 1e3}});
    all.push_back({std::string(name) + "NearlyIncompressible",
                   kind,
                   {Hyperelastic{.C10 = 1e6, .C01 = 0.0, .K = 1e9}, 1e3}});
    all.push_back({std::string(name) + "Linear", kind, {StVenantKirchhoff{D}, 1e3}});
  }
  return all;
}

struct Kind {
  ElementKind value;
};

void PrintTo(const Kind& kind, std::ostream* out) {
  *out << (kind.value == ElementKind::full_integration ? "Full" : "SolidShell");
}

std::string kind_name(const testing::TestParamInfo<Kind>& info) {
  return testing::PrintToString(info.param);
}

Eigen::Vector3d grid_point(int i, int j, int k) {
  return Eigen::Vector3d(0.1, 0.2, -0.3) + kSize / kElements * Eigen::Vector3d(i, j, k);
}

bool inside(int i, int j, int k) { return i % kElements && j % kElements && k % kElements; }

class Patch : public testing::TestWithParam<Case> {
 protected:
  /// Returns a model whose inner nodes are displaced by up to a quarter of an element.
  SmallModel distorted() {
    Sequence random;
    Materials materials;
    materials.solids = {GetParam().solid};
    return SmallModel(
        {kElements, kElements, kElements},
        [&](int i, int j, int k) {
          Eigen::Vector3d x = grid_point(i, j, k);
          if (inside(i, j, k)) {
            for (double& c : x) c += 0.25 * kSize / kElements * random.next();
          }
          return x;
        },
        GetParam().kind,
        materials);
  }

  static Eigen::VectorXd uniform(const SmallModel& model, const Eigen::Matrix3d& F) {
    const Eigen::Matrix3Xd u = F * model.X() - model.X();
    return u.reshaped();
  }

  Eigen::Matrix3d first_piola(const Eigen::Matrix3d& F) const {
    const Eigen::Matrix3d C = F.transpose() * F;
    Vector6 E, S;
    E << 0.5 * (C(0, 0) - 1), 0.5 * (C(1, 1) - 1), 0.5 * (C(2, 2) - 1), C(0, 1), C(1, 2), C(0, 2);
    EXPECT_TRUE(std::visit([&](const auto& law) { return stress(law, E, S, nullptr); },
                           GetParam().solid.law));
    Eigen::Matrix3d T;
    T << S[0], S[3], S[5], S[3], S[1], S[4], S[5], S[4], S[2];
    return F * T;
  }
};

/// Forces on the inner nodes, and the resultant force on the face i = kElements, whose normal is x.
struct Forces {
  double inside = 0.0;
  Eigen::Vector3d face = Eigen::Vector3d::Zero();
};

Forces sort(const SmallModel& model, const Eigen::VectorXd& f) {
  Forces forces;
  for (int k = 0; k <= kElements; ++k) {
    for (int j = 0; j <= kElements; ++j) {
      for (int i = 0; i <= kElements; ++i) {
        const Eigen::Vector3d force = f.segment<3>(3 * model.grid().node(i, j, k));
        if (inside(i, j, k)) forces.inside = std::max(forces.inside, force.norm());
      }
    }
  }
  return forces;
}

TEST_P(Patch, UniformDeformationIsAnEquilibriumOfUniformStress) {
  SmallModel model = distorted();
  const Eigen::VectorXd f = model.forces(uniform(model, kF), nullptr);
  const Eigen::Matrix3d P = first_piola(kF);
  const Forces forces = sort(model, f);
  EXPECT_LT(forces.inside, 1e-10 * P.norm() * kSize * kSize);
  // The virial, the sum of f x X over all nodes with force f and position X, is equal to the volume
  // integral of the stress P [virtual work of a uniform gradient].
  Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();
  for (int a = 0; a < model.grid().nodes(); ++a)
    virial += f.segment<3>(3 * a) * model.X().col(a).transpose();
  EXPECT_LT((virial / (kSize * kSize * kSize) - P).norm(), 1e-10 * P.norm());
}

TEST_P(Patch, NewtonFindsItQuadratically) {
  SmallModel model = distorted();
  // The deformation kF is scaled to a volume increase of 0.5 %, which with K = 500 G gives a
  // hydrostatic tension of 2.5 G. More than that tears rubber [Gent & Lindley 1959, Proc. R. Soc. A
  // 249, 195-205]; the 3.5 % of kF itself would give 17 G.
  const Eigen::VectorXd exact = uniform(model, kF * std::cbrt(1.005 / kF.determinant()));
  Eigen::VectorXd u = exact;
  std::vector<char> held(model.unknowns(), 1);
  for (int k = 1; k < kElements; ++k) {
    for (int j = 1; j < kElements; ++j) {
      for (int i = 1; i < kElements; ++i) {
        for (int c = 0; c < 3; ++c) {
          const int dof = 3 * model.grid().node(i, j, k) + c;
          held[dof] = 0;
          // The iteration starts near the solution: with K = 500 G, undamped Newton steps from
          // twice this distance may converge elsewhere.
          u[dof] += 5e-6 * (c - 1.0) * (i % 2 ? 1 : -1);
        }
      }
    }
  }
  ASSERT_GE(model.solve(u, held, Eigen::VectorXd::Zero(model.unknowns())), 0);
  EXPECT_LT((u - exact).norm(), 1e-10 * exact.norm());
  const auto& r = model.residuals();
  if (GetParam().name != "FullLinear" && r.size() >= 4) {
    const size_t n = r.size() - 2;  // the last residual is only rounding
    EXPECT_LT(r[n], 1e-3 * r[n - 1]);
  }
}

std::string case_name(const testing::TestParamInfo<Case>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Kinds, Patch, testing::ValuesIn(cases()), case_name);

// Straight cords run at 25 degrees to x; the elements are sheared and unequal in the plane of the
// layer.
class CordPatch : public testing::TestWithParam<Kind> {};

TEST_P(CordPatch, UniformDeformationIsAnEquilibrium) {
  Sequence random;
  Materials materials;
  materials.solids = {{Hyperelastic{.C10 = 1e6, .C01 = 0.0, .K = 100e6}, 1e3}};
  materials.layers = {{.E_tension = 2e9,
                       .E_compression = 2e8,
                       .thickness = 3e-4,
                       .angle = 0.44,
                       .pretension = 5e6}};
  SmallModel model({kElements, kElements, kElements},
                   [&](int i, int j, int k) {
                     Eigen::Vector3d x = grid_point(i, j, k);
                     if (i % kElements) x[0] += 0.25 * kSize / kElements * random.next();
                     if (j % kElements) x[1] += 0.2 * kSize / kElements * (j == 1 ? 1 : -1);
                     return x;
                   },
                   GetParam().value,
                   materials,
                   {{0, 0.4}});
  const Eigen::Matrix3Xd u = kF * model.X() - model.X();
  const Eigen::VectorXd f = model.forces(u.reshaped(), nullptr);
  EXPECT_LT(sort(model, f).inside, 1e-10 * 2e9 * 3e-4 * kSize * 0.05);
  // The virial of the cords is S l (x) d times their volume, where S is their stress, d their
  // direction and l that direction after the deformation.
  materials.layers.clear();
  SmallModel rubber(
      {kElements, kElements, kElements},
      [&](int i, int j, int k) {
        return Eigen::Vector3d(model.X().col(model.grid().node(i, j, k)));
      },
      GetParam().value,
      materials);
  const Eigen::VectorXd cords = f - rubber.forces(u.reshaped(), nullptr);
  Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();
  for (int a = 0; a < model.grid().nodes(); ++a)
    virial += cords.segment<3>(3 * a) * model.X().col(a).transpose();
  const Eigen::Vector3d d(std::cos(0.44), std::sin(0.44), 0.0), l = kF * d;
  const CordLayer layer{
      .E_tension = 2e9, .E_compression = 2e8, .thickness = 3e-4, .angle = 0.44, .pretension = 5e6};
  const double S = stress(layer, 0.5 * (l.squaredNorm() - 1.0)).S;
  const Eigen::Matrix3d expected =
      S * 3 * 3e-4 * kSize * kSize * l * d.transpose();  // three sheets
  EXPECT_LT((virial - expected).norm(), 1e-10 * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(Kinds,
                         CordPatch,
                         testing::Values(Kind{ElementKind::full_integration},
                                         Kind{ElementKind::solid_shell}),
                         kind_name);

// There are six rigid motions and no other motion without energy, also under compression: an
// element with an hourglass mode under compression shows a negative eigenvalue here. The block is
// between lubricated plates with free sides, in a homogeneous deformation of incompressible rubber
// with the stretches lambda, 1/sqrt(lambda) and 1/sqrt(lambda).
class Squeezed : public testing::TestWithParam<Kind> {};

TEST_P(Squeezed, BlockStaysStable) {
  Materials materials;
  materials.solids = {{Hyperelastic{.C10 = 1e6, .C01 = 0.0, .K = 100e6}, 1e3}};
  const Grid grid{4, 4, 2};
  SmallModel model(
      grid,
      [](int i, int j, int k) { return Eigen::Vector3d(0.01 * i, 0.01 * j, 0.006 * k); },
      GetParam().value,
      materials);
  std::vector<char> held(model.unknowns(), 0);
  for (int j = 0; j <= grid.ny; ++j) {
    for (int i = 0; i <= grid.nx; ++i)
      held[3 * grid.node(i, j, 0) + 2] = held[3 * grid.node(i, j, grid.nz) + 2] = 1;
  }
  held[3 * grid.node(0, 0, 0)] = held[3 * grid.node(0, 0, 0) + 1] =
      held[3 * grid.node(4, 0, 0) + 1] = 1;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.unknowns());
  for (int step = 1; step <= 8; ++step) {  // to 40 % compression
    const double lambda = 1.0 - 0.05 * step, wide = 1.0 / std::sqrt(lambda);
    for (int a = 0; a < grid.nodes(); ++a) {
      const Eigen::Vector3d X = model.X().col(a);
      u.segment<3>(3 * a) << (wide - 1) * X[0], (wide - 1) * X[1], (lambda - 1) * X[2];
    }
    ASSERT_GE(model.solve(u, held, Eigen::VectorXd::Zero(model.unknowns())), 0) << lambda;
    Eigen::MatrixXd K;
    model.forces(u, &K);
    const auto lowest = eigenvalues(K, Eigen::MatrixXd::Identity(K.rows(), K.cols()), held, 1);
    EXPECT_GT(lowest[0], 0.0) << "at a stretch of " << lambda;
  }
}

// Long, narrow elements like those of a tread are under hydrostatic stress, which must not make
// them unstable. They are fixed at the bottom and the sides, with a lubricated plate at the top.
// (Rubber tears from a tension of 2.5 G on.)
TEST_P(Squeezed, LongElementsStayStableUnderHydrostaticStress) {
  constexpr double kShear = 2e6, kBulk = 1e9;
  Materials materials;
  materials.solids = {{Hyperelastic{.C10 = 0.5 * kShear, .C01 = 0.0, .K = kBulk}, 1e3}};
  const Grid grid{4, 4, 3};
  SmallModel model(
      grid,
      [](int i, int j, int k) { return Eigen::Vector3d(0.016 * i, 0.002 * j, 0.004 * k - 1.0); },
      GetParam().value,
      materials);
  std::vector<char> held(model.unknowns(), 0);
  for (int k = 0; k <= grid.nz; ++k) {
    for (int j = 0; j <= grid.ny; ++j) {
      for (int i = 0; i <= grid.nx; ++i) {
        const int node = grid.node(i, j, k);
        const bool side = i % grid.nx == 0 || j % grid.ny == 0;
        if (side || k == 0) held[3 * node] = held[3 * node + 1] = 1;
        if (side || k % grid.nz == 0) held[3 * node + 2] = 1;
      }
    }
  }
  for (const double tension : {-2.0, -1.0, -0.5, 0.5, 0.9}) {  // multiples of the shear modulus
    const double stretch = std::cbrt(1.0 + tension * kShear / kBulk);
    const Eigen::Matrix3Xd u = (stretch - 1.0) * model.X();
    Eigen::MatrixXd K;
    model.forces(u.reshaped(), &K);
    const auto lowest = eigenvalues(K, Eigen::MatrixXd::Identity(K.rows(), K.cols()), held, 1);
    EXPECT_GT(lowest[0], 0.0) << "at a hydrostatic tension of " << tension << " G";
  }
}

// Long, narrow elements like those of a tire's wall have cords across them under a compressive
// force N, as in the carcass below belts that grow. They are fixed at the sides, between lubricated
// plates. Rubber has at least the energy of G |grad u|^2 (Korn), from which the cords take N
// |du/dy|^2. Below N = G t for a row of thickness t only waves along the cords with the length of
// an element buckle.
TEST_P(Squeezed, LongElementsStayStableUnderCordsInCompression) {
  constexpr double kShear = 3.3e6, kRow = 0.005, kCords = 0.3e-3;
  const Grid grid{4, 8, 2};
  std::vector<char> held(3 * grid.nodes(), 0);
  for (int k = 0; k <= grid.nz; ++k) {
    for (int j = 0; j <= grid.ny; ++j) {
      for (int i = 0; i <= grid.nx; ++i) {
        const int node = grid.node(i, j, k);
        const bool side = i % grid.nx == 0 || j % grid.ny == 0;
        if (side) held[3 * node] = held[3 * node + 1] = 1;
        if (side || k % grid.nz == 0) held[3 * node + 2] = 1;
      }
    }
  }
  for (const double share : {0.1, 0.3, 0.5}) {  // multiples of G t
    Materials materials;
    materials.solids = {{Hyperelastic{.C10 = 0.5 * kShear, .C01 = 0.0, .K = 50 * kShear}, 1e3}};
    materials.layers = {{.E_tension = 6e9,
                         .E_compression = 0.6e9,
                         .thickness = kCords,
                         .angle = 0.5 * std::numbers::pi,
                         .pretension = -share * kShear * kRow / kCords}};
    SmallModel model(
        grid,
        [](int i, int j, int k) { return Eigen::Vector3d(0.056 * i, 0.004 * j, kRow * k - 1.0); },
        GetParam().value,
        materials,
        {{0, 0.5}});
    Eigen::MatrixXd K;
    model.forces(Eigen::VectorXd::Zero(model.unknowns()), &K);
    const auto lowest = eigenvalues(K, Eigen::MatrixXd::Identity(K.rows(), K.cols()), held, 1);
    EXPECT_GT(lowest[0], 0.0) << "N = " << share << " G t";
  }
}

TEST_P(Squeezed, OneElementHasSixRigidMotionsOnly) {
  Materials materials;
  materials.solids = {{Hyperelastic{.C10 = 1e6, .C01 = 0.0, .K = 100e6}, 1e3}};
  SmallModel model(
      {1, 1, 1},
      [](int i, int j, int k) {
        return Eigen::Vector3d(0.015 * i, 0.012 * j + 0.002 * i * k, 0.008 * k);
      },
      GetParam().value,
      materials);
  Eigen::MatrixXd K;
  model.forces(Eigen::VectorXd::Zero(24), &K);
  const auto lambda =
      eigenvalues(K, Eigen::MatrixXd::Identity(24, 24), std::vector<char>(24, 0), 24);
  EXPECT_LT(std::abs(lambda[5]), 1e-10 * lambda[23]);
  EXPECT_GT(lambda[6], 1e-4 * lambda[23]);
}

INSTANTIATE_TEST_SUITE_P(Kinds,
                         Squeezed,
                         testing::Values(Kind{ElementKind::full_integration},
                                         Kind{ElementKind::solid_shell}),
                         kind_name);

}  // namespace
}  // namespace latsch::verification
