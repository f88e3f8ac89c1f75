// SPDX-License-Identifier: Apache-2.0
// Compares our transient of a car of 21 bodies over a kerb with Simbody's. If Simbody is installed,
// its present run must agree with the committed one.
#include "models/multibody/transient.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simbody/case_file.h"
#include "simbody/oracle_figures.h"

namespace latsch::verification {
namespace {

// The present run has a tolerance a thousand times as large as the stored run, and its result
// differs by 20 nm.
TEST(SimbodyTransient, CommittedRunIsWhatItGivesToday) {
  const std::string folder = LATSCH_SIMBODY_CASES;
  const auto today = figures_of_oracle("transient '" + folder + "/car_21_bodies.json' 1e-6");
  if (!today) GTEST_SKIP() << "Simbody (libsimbody-dev) is not installed: no oracle was built";
  const Figures committed = read_figures(folder + "/car_21_bodies_simbody.csv");
  ASSERT_EQ(today->head, committed.head);
  ASSERT_EQ(committed.rows.size(), 301u);
  ASSERT_EQ(today->rows.size(), committed.rows.size());
  double away = 0.0;
  for (std::size_t i = 0; i < committed.rows.size(); ++i)
    for (std::size_t j = 0; j < committed.head.size(); ++j)
      away = std::max(away, std::abs(today->number(i, j) - committed.number(i, j)));
  EXPECT_LT(away, 1e-7);  // s, m
}

using Eigen::Vector3d;
using namespace multibody;

/// Forces of the tires on the kerb, in a frame that moves with the car.
Outside tires_on_road(const CaseFile& file) {
  return [&file](const Motion& motion, std::vector<BodyForce>& wrenches) {
    const KerbStretch& kerb = *file.road;
    for (const LinearTire& tire : file.tires) {
      const auto body = static_cast<std::size_t>(tire.body);
      const Pose& pose = motion.poses[body];
      const Vector3d arm = pose.turn * (tire.wheel_center - file.bodies[body].origin);
      const Vector3d center = pose.place + arm;
      const Vector3d velocity = motion.rates->segment<3>(6 * tire.body) +
                                motion.rates->segment<3>(6 * tire.body + 3).cross(arm);
      const double s = center.x() + file.speed * motion.time - kerb.start;
      double h = 0.0, rise = 0.0;
      if (s >= 0.0 && s <= kerb.count * kerb.pitch && center.y() >= kerb.right &&
          center.y() <= kerb.left) {
        const double phase = 2.0 * std::numbers::pi * s / kerb.pitch;
        h = 0.5 * kerb.height * (1.0 - std::cos(phase));
        rise = 0.5 * kerb.height * std::sin(phase) * 2.0 * std::numbers::pi / kerb.pitch *
               (file.speed + velocity.x());
      }
      const double force =
          tire.stiffness * (tire.radius - (center.z() - h)) + tire.damping * (rise - velocity.z());
      BodyForce wrench{.body = tire.body};
      const Vector3d up(0.0, 0.0, std::max(force, 0.0));
      wrench.value << up, arm.cross(up);
      wrenches.push_back(wrench);
    }
  };
}

/// Returns the largest distance, m, of any output point at any time from Simbody's result.
double away_from_simbody(double step) {
  const CaseFile file = read_case_file(LATSCH_SIMBODY_CASES "/car_21_bodies.json");
  const Figures figures = read_figures(LATSCH_SIMBODY_CASES "/car_21_bodies_simbody.csv");
  const std::vector<Load> loads = loads_of(file, file.load_cases.front());
  const Mechanism standing(file.bodies, joints_in_statics(file)),
      mechanism(file.bodies, file.joints);
  EXPECT_EQ(file.bodies.size(), 21u);
  EXPECT_EQ(file.joints.size(), 40u);
  const auto rest = Equilibrium(standing).solve(loads);
  EXPECT_TRUE(rest);
  Transient transient(mechanism, {.dissipation = 0.0});
  const Outside tires = tires_on_road(file);
  const RestSettings acting{.loads = loads, .outside = &tires};
  auto state = transient.start({*rest, {}}, acting);
  EXPECT_TRUE(state);
  double away = 0.0;
  const int each = static_cast<int>(std::lround(file.output_step / step));
  for (std::size_t row = 0; row < figures.rows.size(); ++row) {
    for (std::size_t i = 0; i < file.outputs.size(); ++i) {
      const Vector3d ours = displacement(file, file.outputs[i], state->poses);
      for (int axis = 0; axis < 3; ++axis)
        away = std::max(
            away,
            std::abs(ours[axis] - figures.number(row, 1 + 3 * i + static_cast<std::size_t>(axis))));
    }
    for (int k = 0; k < each; ++k) {
      const auto done = transient.advance(*state, step, acting);
      EXPECT_TRUE(done.ok());
      if (!done) return INFINITY;
    }
  }
  return away;
}

// A wheel leaves the road during the run. The distance from Simbody's result is 17 µm at 5000 steps
// per second, 4 µm at 10,000 and 0.3 µm at 40,000.
TEST(SimbodyTransient, OursStaysBesideItAndComesCloserWithShorterSteps) {
  EXPECT_LT(away_from_simbody(1e-4), 10e-6);
  EXPECT_LT(away_from_simbody(2.5e-5), 1e-6);
}

}  // namespace
}  // namespace latsch::verification
