// SPDX-License-Identifier: Apache-2.0
// Chains of known motions against closed forms.
#include "models/fe_tire/rolling/rolling_chain.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>

#include "base/document.h"
#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/motion/spinning_tire.h"
#include "models/fe_tire/rolling/rolling_fields.h"

namespace latsch::fe_tire {
namespace {

constexpr double kChainSpin = 40.0;  // rad/s

TireDescription chained_tire(bool is_zoned) {
  TireDescription tire = reference_tire_b();
  tire.element = ElementKind::solid_shell;
  tire.section.meridional = 13;
  tire.section.sectors = 60;
  if (is_zoned) tire.section.sector_zones = {{8, 0.035}, {8, 0.07}};
  for (Rubber& rubber : tire.rubbers) rubber.prony = {{0.2, 2e-3}};
  return tire;
}

class ChainOfTireB : public testing::TestWithParam<bool> {
 protected:
  ChainOfTireB()
      : description_(chained_tire(GetParam())),
        tire_(description_),
        losses_(build_losses(description_)) {}

  ChainPlace place(const std::string& depth) const {
    return *find_place(tire_.mesh(), losses_, 0.0, depth);
  }

  TireDescription description_;
  FeTire tire_;
  LossMaterials losses_;
};

TEST_P(ChainOfTireB, ATireThatSpinsOffTheGroundMovesAsARigidWheel) {
  const Inflated rest = *tire_.inflate(2.6e5);
  const Inflated spun = *SpinningTire(tire_).inflate(rest, kChainSpin);
  const Mesh& mesh = tire_.mesh();
  Eigen::Matrix3Xd u(3, mesh.nodes());
  for (int s = 0; s < mesh.sectors; ++s)
    u.middleCols(s * mesh.nodes_per_sector(), mesh.nodes_per_sector()) = spun.u;
  const LossMeter meter(tire_, losses_, rest);
  for (const char* depth : {"inner", "outer"}) {
    const auto points =
        chain(meter, place(depth), u, spun.alpha.replicate(mesh.sectors, 1), kChainSpin);
    ASSERT_EQ(std::ssize(points), mesh.sectors);
    for (const ChainPoint& at : points) {
      const Eigen::Vector3d spin(0.0, kChainSpin, 0.0);
      EXPECT_LT((at.v - spin.cross(at.x)).norm(), 1e-9);
      EXPECT_LT((at.a - spin.cross(spin.cross(at.x))).norm(), 1e-6);
      EXPECT_NEAR(at.dissipation, 0.0, 1e-3);  // W/m^3; a rolling tire has some 1e5
      EXPECT_GT(at.energy, 0.0);
    }
    // Forward rolling carries the lowest material backward, seen from the hub.
    EXPECT_LT(points[0].v.x(), -10.0);
  }
}

TEST_P(ChainOfTireB, AWaveHasItsVelocityAccelerationAndDissipation) {
  const Mesh& mesh = tire_.mesh();
  constexpr double kHigh = 1e-5;  // m
  constexpr int n = 3;
  Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Zero(3, mesh.nodes());
  for (int s = 0; s < mesh.sectors; ++s)
    u.middleCols(s * mesh.nodes_per_sector(), mesh.nodes_per_sector())
        .row(1)
        .setConstant(kHigh * std::cos(n * mesh.angle(s)));
  Inflated none;
  none.u = Eigen::Matrix3Xd::Zero(3, mesh.nodes_per_sector());
  none.alpha = Eigen::VectorXd::Zero(8 * std::ssize(mesh.elements));
  const LossMeter meter(tire_, losses_, none);
  const Eigen::VectorXd alpha = Eigen::VectorXd::Zero(8 * mesh.element_count());
  const auto points = chain(meter, place("outer"), u, alpha, kChainSpin);
  double mean = 0.0;
  for (const ChainPoint& at : points) {
    const Eigen::Vector3d moved = at.x - at.u;
    const double r = std::hypot(moved.x(), moved.z());
    EXPECT_NEAR(at.u.y(), kHigh * std::cos(n * at.theta), 1e-3 * kHigh);
    // Material moves toward decreasing theta: d/dt = -Omega d/dtheta.
    const double rate = n * kChainSpin * kHigh;
    EXPECT_NEAR(at.v.y(), rate * std::sin(n * at.theta), 5e-3 * rate);
    EXPECT_NEAR(
        at.a.y(), -n * kChainSpin * rate * std::cos(n * at.theta), 0.03 * n * kChainSpin * rate);
    EXPECT_GE(at.dissipation, 0.0);
    mean += at.dissipation * r * r;
  }
  // P = n Omega/2 G''(n Omega) (a n/r)^2, the mean around, on equal sectors.
  if (GetParam()) return;
  mean /= static_cast<double>(points.size());
  const Solid& solid = tire_.materials().solids[mesh.elements[place("outer").element].solid];
  const double G = 2.0 * std::get<Hyperelastic>(solid.law).C10;
  const double loss = relative_modulus(PronyTerm{0.2, 2e-3}, n * kChainSpin).imag();
  const double expected = 0.5 * n * kChainSpin * G * loss * std::pow(kHigh * n, 2);
  EXPECT_NEAR(mean, expected, 0.05 * expected);
}

// Fields of the whole tire: nodes of a tire that spins off the ground have the velocity of a rigid
// wheel, and an element has the mean of its faces' strains and of its energies' sums.
TEST_P(ChainOfTireB, FieldsOfAllElementsAreThoseOfChains) {
  const Inflated rest = *tire_.inflate(2.6e5);
  const Inflated spun = *SpinningTire(tire_).inflate(rest, kChainSpin);
  const Mesh& mesh = tire_.mesh();
  const int n = mesh.nodes_per_sector(), own = static_cast<int>(mesh.elements.size());
  const Eigen::Matrix3Xd u = spun.u.replicate(1, mesh.sectors);
  const Eigen::VectorXd alpha = spun.alpha.replicate(mesh.sectors, 1);
  const LossMeter meter(tire_, losses_, rest);
  const RollingFields fields = rolling_fields(meter, u, alpha, kChainSpin);
  for (int s = 0; s < mesh.sectors; ++s) {
    const Eigen::Matrix3d frame = mesh.frame(s);
    for (int node = 0; node < n; ++node) {
      const Eigen::Vector3d x = frame * (mesh.X.col(node) + spun.u.col(node));
      const Eigen::Vector3d v = frame * fields.v.col(s * n + node);
      EXPECT_LT((v - Eigen::Vector3d(0.0, kChainSpin, 0.0).cross(x)).norm(), 1e-9);
    }
  }
  ASSERT_EQ(fields.S.cols(), mesh.element_count());
  const ChainPlace outer = place("outer");
  const auto lower = chain(meter, {outer.element, -1.0, -1}, u, alpha, kChainSpin);
  const auto upper = chain(meter, {outer.element, 1.0, -1}, u, alpha, kChainSpin);
  for (int s = 0; s < mesh.sectors; ++s) {
    const Vector6 E = 0.5 * (lower[s].E + upper[s].E);
    EXPECT_LT((fields.E.col(s * own + outer.element) - E).norm(), 1e-12);
    EXPECT_GT(E.norm(), 1e-4);
  }
  EXPECT_TRUE((fields.energy.array() >= 0.0).all());
}

INSTANTIATE_TEST_SUITE_P(Sectors, ChainOfTireB, testing::Values(false, true));

TEST(RollingChain, FindsFacesAndLayersAndSaysWhichThereAre) {
  const TireDescription tire = read_tire(Document::read(std::filesystem::path(LATSCH_SOURCE_DIR) /
                                                        "studies/tires/passenger_225_50R16.toml")
                                             .root());
  const Mesh mesh = build_mesh(tire);
  const LossMaterials losses = build_losses(tire);
  const auto radius = [&](const ChainPlace& at) {
    const auto X = mesh.coordinates(mesh.elements[at.element]);
    const Eigen::Vector3d inner = 0.5 * (X.col(0) + X.col(3)), outer = 0.5 * (X.col(4) + X.col(7));
    const Eigen::Vector3d x = inner + 0.5 * (1.0 + at.zeta) * (outer - inner);
    return std::pair(-x.z(), x.y());
  };
  const auto inner = *find_place(mesh, losses, 0.0, "inner");
  const auto belt = *find_place(mesh, losses, 0.0, "belt_1");
  const auto outer = *find_place(mesh, losses, 0.0, "outer");
  EXPECT_LT(radius(inner).first, radius(belt).first);
  EXPECT_LT(radius(belt).first, radius(outer).first);
  EXPECT_NEAR(radius(outer).first, mesh.outer_radius(), 2e-3);
  // The element at the crown may begin or end there.
  const auto X = mesh.coordinates(mesh.elements[inner.element]);
  EXPECT_LE(std::abs(radius(inner).second), 0.5 * (X.col(3) - X.col(0)).norm() + 1e-9);
  EXPECT_GE(belt.cords, 0);
  // Positive positions lie at +y.
  EXPECT_GT(radius(*find_place(mesh, losses, 0.7, "outer")).second, 0.05);
  EXPECT_LT(radius(*find_place(mesh, losses, -0.7, "outer")).second, -0.05);
  EXPECT_EQ(find_place(mesh, losses, 0.7, "carcass")->cords >= 0, true);
  const auto none = find_place(mesh, losses, 0.9, "belt_1");
  ASSERT_FALSE(none);
  EXPECT_NE(none.failure().reason.find("carcass"), std::string::npos) << none.failure().reason;
  EXPECT_EQ(none.failure().reason.find("belt_2"), std::string::npos) << none.failure().reason;
}

}  // namespace
}  // namespace latsch::fe_tire
