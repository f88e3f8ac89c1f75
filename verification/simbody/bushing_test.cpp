// SPDX-License-Identifier: Apache-2.0
// Compares one bushing between bodies that are displaced far and rotated by up to 0.4 rad in each
// component with Simbody's Force::LinearBushing: the wrenches must be equal.
#include "models/multibody/bushing.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "simbody/oracle_figures.h"

namespace latsch::verification {
namespace {

using Eigen::Vector3d;
using namespace multibody;

class Row {
 public:
  Row(const Figures& figures, std::size_t row) : figures_(figures), row_(row) {}

  Vector3d vector(const std::string& name) const {
    const std::size_t first = figures_.column(name + "_x");
    return {figures_.number(row_, first),
            figures_.number(row_, first + 1),
            figures_.number(row_, first + 2)};
  }
  Pose pose(const std::string& body) const {
    const Vector3d turn = vector(body + "_rotation");
    return {vector(body + "_travel"),
            Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix()};
  }
  Vector6d rate(const std::string& body) const {
    Vector6d rate;
    rate << vector(body + "_velocity"), vector(body + "_spin");
    return rate;
  }
  Vector6d wrench(const std::string& body) const {
    Vector6d wrench;
    wrench << vector("force_on_" + body), vector("moment_on_" + body);
    return wrench;
  }

 private:
  const Figures& figures_;
  std::size_t row_;
};

TEST(SimbodyBushing, WrenchesAreThoseOfSimbodysLinearBushing) {
  const Figures figures = read_figures(LATSCH_SIMBODY_CASES "/bushing_simbody.csv");
  int compared = 0;
  for (std::size_t i = 0; i < figures.rows.size(); ++i) {
    const Row row(figures, i);
    const Vector3d point = row.vector("point");
    const BushingStrain strain = strain_of({point, point}, row.pose("a"), row.pose("b"));
    BushingParameters bushing{row.vector("stiffness"), row.vector("rotational_stiffness")};
    bushing.damping = row.vector("damping");
    bushing.rotational_damping = row.vector("rotational_damping");
    const Vector6d rates = rates_of(strain, row.rate("a"), row.rate("b"));
    const BushingWrenches found =
        wrenches(strain, forces_in_motion(strain, rates, bushing, 0.0, nullptr, 0.0, nullptr));
    const Vector6d on_a = row.wrench("a"), on_b = row.wrench("b");
    // The tolerance is about ten times the rounding error of positions of 1 m and rotations of 1
    // rad, relative to deformations of 0.1 m.
    EXPECT_LT((found.on_a - on_a).norm(), 1e-13 * on_a.norm()) << i;
    EXPECT_LT((found.on_b - on_b).norm(), 1e-13 * on_b.norm()) << i;
    ++compared;
  }
  EXPECT_EQ(compared, 12);
}

}  // namespace
}  // namespace latsch::verification
