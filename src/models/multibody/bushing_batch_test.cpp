// SPDX-License-Identifier: Apache-2.0
// Tests the vectorized bushings against bushing.h, to 1e-13 of the largest number because the sums
// have some tens of products. Tests that both kernel sets with a fused multiply-add give equal
// bits.
#include "models/multibody/bushing_batch.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "numerics/kernels/kernel_set.h"

namespace latsch::multibody {
namespace {

using Eigen::Vector3d;

struct Case {
  BushingPlace place;
  BushingParameters law;
  Pose a, b;
  Vector6d rates_a, rates_b;
};

struct Answer {
  Vector6d on_a = Vector6d::Zero(), on_b = Vector6d::Zero();
  BushingTangent tangent{Matrix6d::Zero(), Matrix6d::Zero(), Matrix6d::Zero(), Matrix6d::Zero()};

  BushingTask task(const Case& of) {
    return {.place = numbers_of(of.place),
            .parameters = numbers_of(of.law),
            .pose_a = numbers_of(of.a),
            .pose_b = numbers_of(of.b),
            .rates_a = of.rates_a.data(),
            .rates_b = of.rates_b.data(),
            .on_a = on_a.data(),
            .on_b = on_b.data(),
            .aa = tangent.aa.data(),
            .ab = tangent.ab.data(),
            .ba = tangent.ba.data(),
            .bb = tangent.bb.data()};
  }
};

class BushingBatch : public ::testing::Test {
 protected:
  double any(double most) { return most * (2.0 * random_.uniform() - 1.0); }
  Vector3d any_vector(double most) { return {any(most), any(most), any(most)}; }
  Pose any_pose(double turn) {
    Pose pose;
    Vector6d way;
    way << any_vector(0.5), any_vector(turn);
    pose.move(way);
    return pose;
  }
  /// Returns bushings that are turned by up to 0.5 rad about each axis, and one that is turned by
  /// more than a right angle about x.
  std::vector<Case> cases(int count) {
    std::vector<Case> cases;
    for (int i = 0; i < count; ++i) {
      Case one;
      one.a = any_pose(2.0);
      one.b = one.a;
      Vector6d way;
      way << any_vector(1e-2), any_vector(0.5);
      if (i == 0) way.tail<3>() = one.a.turn.col(0) * 2.0;
      one.b.move(way);
      one.place = {any_vector(0.3), any_vector(0.3)};
      one.place.axes_in_a = one.place.axes_in_b =
          i == 0 ? Eigen::Matrix3d::Identity().eval() : any_pose(2.0).turn;
      one.law.stiffness = any_vector(1e7).cwiseAbs();
      one.law.rotational = any_vector(300.0).cwiseAbs();
      one.law.damping = any_vector(1e3).cwiseAbs();
      one.law.rotational_damping = any_vector(1.0).cwiseAbs();
      one.rates_a << any_vector(3.0), any_vector(5.0);
      one.rates_b << any_vector(3.0), any_vector(5.0);
      cases.push_back(one);
    }
    return cases;
  }

  RandomStream random_{15, 3};
};

std::vector<Answer> answers(const std::vector<Case>& cases, bool moving, double share) {
  std::vector<Answer> answers(cases.size());
  std::vector<BushingTask> tasks;
  for (std::size_t i = 0; i < cases.size(); ++i) tasks.push_back(answers[i].task(cases[i]));
  double turned = 0.0;
  for (const Case& one : cases)
    turned = std::max(turned, strain_of(one.place, one.a, one.b).q.lpNorm<Eigen::Infinity>());
  EXPECT_NEAR(add_bushings(tasks, moving, share), turned, 1e-14 * turned);
  return answers;
}

TEST_F(BushingBatch, IsTheLawOfOneBushing) {
  const std::vector<Case> all = cases(40);
  constexpr double kShare = 1e4;
  for (const KernelSet set : kernel_sets()) {
    const WithKernelSet with(set);
    for (const bool moving : {false, true}) {
      const std::vector<Answer> batch = answers(all, moving, kShare);
      for (std::size_t i = 0; i < all.size(); ++i) {
        const Case& one = all[i];
        const BushingStrain s = strain_of(one.place, one.a, one.b);
        const BushingForces forces = moving
                                         ? forces_in_motion(s,
                                                            rates_of(s, one.rates_a, one.rates_b),
                                                            one.law,
                                                            kShare,
                                                            nullptr,
                                                            2e-4,
                                                            nullptr)
                                         : spring_forces(s, one.law);
        const BushingWrenches w = wrenches(s, forces);
        const BushingTangent K = tangent(s, forces);
        const auto same = [&](const auto& a, const auto& b) {
          EXPECT_LT((a - b).template lpNorm<Eigen::Infinity>(),
                    1e-13 * b.template lpNorm<Eigen::Infinity>())
              << name(set) << " " << i << " " << moving;
        };
        same(batch[i].on_a, w.on_a);
        same(batch[i].on_b, w.on_b);
        same(batch[i].tangent.aa, K.aa);
        same(batch[i].tangent.ab, K.ab);
        same(batch[i].tangent.ba, K.ba);
        same(batch[i].tangent.bb, K.bb);
      }
    }
  }
}

TEST_F(BushingBatch, IsTheSameInEverySetWithFusedProducts) {
  const std::vector<Case> all = cases(8);
  std::vector<Answer> first;
  for (const KernelSet set : kernel_sets()) {
    if (set == KernelSet::baseline) continue;
    const WithKernelSet with(set);
    const std::vector<Answer> batch = answers(all, true, 1e4);
    if (first.empty()) first = batch;
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_EQ(batch[i].on_a, first[i].on_a);
      EXPECT_EQ(batch[i].on_b, first[i].on_b);
      EXPECT_EQ(batch[i].tangent.aa, first[i].tangent.aa);
      EXPECT_EQ(batch[i].tangent.ab, first[i].tangent.ab);
      EXPECT_EQ(batch[i].tangent.ba, first[i].tangent.ba);
      EXPECT_EQ(batch[i].tangent.bb, first[i].tangent.bb);
    }
  }
}

}  // namespace
}  // namespace latsch::multibody
