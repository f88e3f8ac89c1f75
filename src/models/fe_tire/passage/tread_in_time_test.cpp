// SPDX-License-Identifier: Apache-2.0
// The contact by the flexibility of the tread beside the one that is condensed to nodes near the
// ground (tread_roller.h).
#include "models/fe_tire/passage/tread_in_time.h"

#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "models/fe_tire/passage/passing_tire_testing.h"
#include "models/fe_tire/passage/reduced_passage.h"

namespace latsch::fe_tire {
namespace {

constexpr double kMoment = 5e-4;  // s

/// The tread of a reduced tire B with 13 columns, linear about a free wheel, with the symmetric
/// flexibility of rest.
class ResilientTread {
 public:
  ResilientTread() : tire_(false), passage_(tire_.passage_) {
    EXPECT_TRUE(passage_.start(tire_.free_, {.step = kMoment}));
    const ReducedTire& of = reduced();
    F_ = of.rest + of.at_tread * of.K.ldlt().solve(of.at_tread.transpose());
    F_ = (0.5 * (F_ + F_.transpose())).eval();
  }
  const ReducedTire& reduced() const { return *passage_.state().tire; }
  double load() const { return tire_.free_.forces.force.z(); }
  /// A wheel that comes down, brakes and slips within the step.
  RollingCase wheel(std::optional<double> load) const {
    RollingCase of = tire_.free_.of;
    of.drive.reset();
    of.load = load;
    of.slip_angle = 0.03;
    of.spin *= 0.97;
    if (!load) of.height -= 1e-3;
    return of;
  }
  TreadPast past() const {
    TreadRoller roller(*reduced().tread, *reduced().lines);
    return {roller.instant(tire_.free_.of, reduced().u), 0.01};
  }
  const Eigen::MatrixXd& F() const { return F_; }
  const GripState& grip() const { return tire_.free_.grip; }

 private:
  Passing tire_;
  ReducedPassage passage_;
  Eigen::MatrixXd F_;
};

// Forces, displacements and height are those of the condensed contact, with the height held and
// with a load; F is in single precision.
TEST(TreadInTime, FindsTheContactOfTheCondensedTread) {
  const ResilientTread tread;
  const ReducedTire& tire = tread.reduced();
  const TreadPast past = tread.past();
  const PassingMoment moment{past, kMoment};
  TreadRoller roller(*tire.tread, *tire.lines);
  roller.set(tread.F().inverse());
  TreadInTime flexible(*tire.tread, *tire.lines);
  flexible.set(tread.F().cast<float>());
  for (const std::optional<double> load : {std::optional<double>(), std::optional(4200.0)}) {
    const RollingCase of = tread.wheel(load);
    int passes = 0, solves = 0;
    GripState one = tread.grip(), other = tread.grip();
    roller.begin();
    flexible.begin();
    const auto expected =
        roller.solve(of, tire.u, tire.c, tread.load(), 1e-5, one, passes, &moment);
    const auto found =
        flexible.solve(of, tire.u, tire.c, tread.load(), 1e-5, other, solves, moment);
    ASSERT_TRUE(expected) << expected.failure().reason;
    ASSERT_TRUE(found) << found.failure().reason;
    EXPECT_GT((expected->c - tire.c).norm(), 0.01 * tread.load());
    EXPECT_LT((found->c - expected->c).norm(), 1e-4 * tread.load());
    EXPECT_LT((found->d - expected->d).norm(), 1e-4 * expected->d.norm());
    EXPECT_LT((found->forces.force - expected->forces.force).norm(), 1e-4 * tread.load());
    EXPECT_NEAR(found->of.height, expected->of.height, 1e-8);
    if (load) EXPECT_NEAR(found->forces.force.z(), *load, 1e-4 * *load);
    EXPECT_EQ(one.grip, other.grip);
    EXPECT_EQ(found->patch.size(), expected->patch.size());
  }
}

// The contact that was found holds at the places to which it moves the points, and nothing is
// solved again; other forces do not hold.
TEST(TreadInTime, KnowsAContactThatHolds) {
  const ResilientTread tread;
  const ReducedTire& tire = tread.reduced();
  const TreadPast past = tread.past();
  const PassingMoment moment{past, kMoment};
  TreadInTime flexible(*tire.tread, *tire.lines);
  flexible.set(tread.F().cast<float>());
  const RollingCase of = tread.wheel({});
  GripState grip = tread.grip();
  int solves = 0;
  flexible.begin();
  const auto found = flexible.solve(of, tire.u, tire.c, tread.load(), 1e-5, grip, solves, moment);
  ASSERT_TRUE(found) << found.failure().reason;
  const Eigen::Matrix3Xd u = tire.u - found->d.reshaped(3, tire.u.cols());
  int more = 0;
  const auto again = flexible.solve(of, u, found->c, tread.load(), 1e-5, grip, more, moment, 1e-4);
  ASSERT_TRUE(again);
  EXPECT_EQ(more, 0);
  EXPECT_LT((again->c - found->c).norm(), 1e-4 * tread.load());
  const auto other =
      flexible.solve(of, u, 1.1 * found->c, tread.load(), 1e-5, grip, more, moment, 1e-4);
  ASSERT_TRUE(other);
  EXPECT_GT(more, 0);
}

}  // namespace
}  // namespace latsch::fe_tire
