// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/bushing.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace latsch::multibody {
namespace {

using Eigen::Vector3d;

const BushingParameters kUneven{{3e5, 4e5, 7e5}, {200.0, 350.0, 90.0}};

Vector3d random_vector(RandomStream& random, double size) {
  return size * Vector3d(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5);
}

Pose random_pose(RandomStream& random) {
  Pose pose;
  Vector6d by;
  by << random_vector(random, 0.1), random_vector(random, 1.5);
  pose.move(by);
  return pose;
}

BushingPlace random_place(RandomStream& random) {
  BushingPlace place{random_vector(random, 0.5), random_vector(random, 0.5)};
  place.axes_in_a = random_pose(random).turn;
  place.axes_in_b = random_pose(random).turn;
  return place;
}

Pose moved(Pose pose, int i, double by) {
  Vector6d step = Vector6d::Zero();
  step[i] = by;
  pose.move(step);
  return pose;
}

TEST(Bushing, TravelAloneIsHookesLawInItsAxes) {
  const BushingPlace place{{0.1, 0.2, 0.3}, {-0.2, 0.1, 0.0}};
  Pose a, b;
  b.place = place.in_a - place.in_b + Vector3d(1e-3, -2e-3, 3e-3);
  const BushingWrenches w = wrenches(strain_of(place, a, b), kUneven);
  const Vector3d F(-300.0, 800.0, -2100.0);
  EXPECT_LT((w.on_b.head<3>() - F).norm(), 1e-9);
  EXPECT_LT((w.on_b.tail<3>() - place.in_b.cross(F)).norm(), 1e-9);
  EXPECT_LT((w.on_a.head<3>() + F).norm(), 1e-9);
}

TEST(Bushing, RotationAboutOneAxisIsATorsionSpring) {
  const BushingPlace place{Vector3d::Zero(), Vector3d::Zero()};
  for (int i = 0; i < 3; ++i) {
    const Pose b = moved({}, 3 + i, 0.7);
    const Vector6d on_b = wrenches(strain_of(place, {}, b), kUneven).on_b;
    Vector6d expected = Vector6d::Zero();
    expected[3 + i] = -0.7 * kUneven.rotational[i];
    EXPECT_LT((on_b - expected).norm(), 1e-11) << i;
  }
}

// The work of the wrenches on both bodies must equal the loss of stored energy. The energy's
// gradient is computed by central differences at random positions.
TEST(Bushing, WrenchesAreTheGradientOfItsEnergy) {
  RandomStream random(3, 1);
  for (int draw = 0; draw < 20; ++draw) {
    const BushingPlace place = random_place(random);
    const Pose a = random_pose(random), b = random_pose(random);
    const BushingWrenches w = wrenches(strain_of(place, a, b), kUneven);
    const double h = 1e-6, size = w.on_a.norm() + w.on_b.norm();
    const auto of = [&](const Pose& pose_a, const Pose& pose_b) {
      return energy(strain_of(place, pose_a, pose_b), kUneven);
    };
    for (int i = 0; i < 6; ++i) {
      EXPECT_NEAR(
          -(of(moved(a, i, h), b) - of(moved(a, i, -h), b)) / (2.0 * h), w.on_a[i], 1e-7 * size);
      EXPECT_NEAR(
          -(of(a, moved(b, i, h)) - of(a, moved(b, i, -h))) / (2.0 * h), w.on_b[i], 1e-7 * size);
    }
  }
}

TEST(Bushing, TangentIsThatOfDifferences) {
  RandomStream random(3, 2);
  for (int draw = 0; draw < 20; ++draw) {
    const BushingPlace place = random_place(random);
    const Pose a = random_pose(random), b = random_pose(random);
    const BushingTangent J = tangent(strain_of(place, a, b), kUneven);
    const double h = 1e-6;
    for (int i = 0; i < 6; ++i) {
      const auto by = [&](const Pose& a0, const Pose& b0, const Pose& a1, const Pose& b1) {
        const BushingWrenches w0 = wrenches(strain_of(place, a0, b0), kUneven),
                              w1 = wrenches(strain_of(place, a1, b1), kUneven);
        return BushingWrenches{(w1.on_a - w0.on_a) / (2.0 * h), (w1.on_b - w0.on_b) / (2.0 * h)};
      };
      const BushingWrenches by_a = by(moved(a, i, -h), b, moved(a, i, h), b),
                            by_b = by(a, moved(b, i, -h), a, moved(b, i, h));
      const double tolerance = 1e-8 * (J.aa.norm() + J.bb.norm());
      EXPECT_LT((J.aa.col(i) - by_a.on_a).norm(), tolerance) << i;
      EXPECT_LT((J.ba.col(i) - by_a.on_b).norm(), tolerance) << i;
      EXPECT_LT((J.ab.col(i) - by_b.on_a).norm(), tolerance) << i;
      EXPECT_LT((J.bb.col(i) - by_b.on_b).norm(), tolerance) << i;
    }
  }
}

}  // namespace
}  // namespace latsch::multibody
