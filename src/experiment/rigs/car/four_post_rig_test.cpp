// SPDX-License-Identifier: Apache-2.0
// Compares the rig in the time domain with a linear model of the same car
// (models/car/car_linear.h), which needs neither time steps nor spectra.
#include "experiment/rigs/car/four_post_rig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiment/rigs/car/post_spectra.h"
#include "models/car/car_linear.h"
#include "models/car/race_car_testing.h"
#include "models/road/plane_road.h"
#include "numerics/signals/welch.h"

namespace latsch::experiment {
namespace {

/// Returns the coherence at lines of a spectrum with a spacing of 1/7 Hz.
std::vector<double> coherence_of_segments(const std::vector<double>& u,
                                          const std::vector<double>& y) {
  constexpr double kRate = 2500.0;
  auto settings = numerics::welch_settings(
      numerics::Convention::scipy, static_cast<int>(u.size()), static_cast<int>(7.0 * kRate));
  settings.overlap = settings.segment - settings.segment / 8;
  return numerics::coherence(numerics::densities(u, y, kRate, settings));
}

class FourPostOfALinearCar : public testing::TestWithParam<PostMode> {
 protected:
  FourPostOfALinearCar() {
    auto made = car::Car::make(car::race_car(false), car::spring_tires());
    car_ = std::move(*made);
    const road::PlaneRoad flat{road::PlaneRoad::Settings{}};
    const auto state = car_->settle(flat, 0.0, {});
    linear_ = *car::linearize(*car_, *state, flat);
  }

  std::unique_ptr<car::Car> car_;
  car::LinearCar linear_;
};

// 0.5 mm is a small amplitude: its geometric and damper nonlinearity is below 0.1 %. The error of
// the steps is (ω h)²/12, 1e-4 at 30 Hz. Lines of 0.2 Hz smooth steep densities, and the densities
// end with the record, so only those count whose segments agree, judged by the coherence of Welch's
// method.
TEST_P(FourPostOfALinearCar, ItsResponsesAreThoseOfTheLinearModel) {
  // In pitch the body hardly moves vertically: at 0.03 m/s the effect of nonlinear geometry is
  // above 1 % of that motion.
  FourPostTest test = sweep_test({.mode = GetParam(),
                                  .from = 0.5,
                                  .to = 40.0,
                                  .duration = 24.0,
                                  .amplitude = 5e-4,
                                  .velocity = GetParam() == PostMode::pitch ? 0.01 : 0.03},
                                 4e-4);
  test.step = 2e-4;
  const auto runs = run_both_ways(*car_, test);
  ASSERT_TRUE(runs) << runs.failure().reason;
  const Channels& record = runs->up;
  const Channels measured =
      spectra(*runs, GetParam(), 2500.0, {.segment = 7.0, .from = 1.0, .to = 30.0});
  const std::vector<double>& f = measured["frequency"];
  const std::array<double, 4> sign = signs_of(GetParam());
  long compared = 0;
  for (std::size_t k = 0; k < linear_.names.size(); ++k) {
    const std::string& sensor = linear_.names[k];
    const std::vector<double> agreement = coherence_of_segments(record["post_FL"], record[sensor]);
    for (std::size_t i = 0; i < f.size(); ++i) {
      const Eigen::VectorXcd H = linear_.response(f[i]) * Eigen::Vector4d(sign.data());
      // The contributions of both axles to the body's motion in pitch nearly cancel: above 20 Hz
      // the error of the time steps in each is more than 1 % of their sum.
      if (GetParam() == PostMode::pitch && sensor == "body_z" && f[i] > 20.0) continue;
      if (!(measured["coherence_" + sensor][i] > 0.99)) continue;
      const std::complex<double> expected = H[static_cast<Eigen::Index>(k)],
                                 H1 = std::polar(measured["tf_" + sensor][i],
                                                 measured["phase_" + sensor][i]);
      EXPECT_LT(std::abs(H1 - expected), 0.01 * std::abs(expected)) << sensor << " " << f[i];
      if (!(agreement[static_cast<std::size_t>(std::lround(7.0 * f[i]))] > 0.99)) continue;
      const double density = std::norm(expected) * measured["psd_post"][i];
      EXPECT_NEAR(measured["psd_" + sensor][i], density, 0.03 * density) << sensor << " " << f[i];
      ++compared;
    }
  }
  EXPECT_GT(compared, 500);  // there are 204 lines and nine sensors
}

// A sweep without any stated settings goes from 0.5 to 30 Hz in 20 s and has lines at intervals of
// 0.25 Hz.
TEST_P(FourPostOfALinearCar, AtItsDefaultsItsResponsesAreRightFromTheLowestLineOn) {
  const auto runs = run_both_ways(*car_, sweep_test({.mode = GetParam()}, 1e-3));
  ASSERT_TRUE(runs) << runs.failure().reason;
  const Channels measured = spectra(*runs, GetParam(), 1000.0, {.moving = 20.0});
  const std::vector<double>& f = measured["frequency"];
  ASSERT_EQ(f.front(), 0.5);
  const std::array<double, 4> sign = signs_of(GetParam());
  for (std::size_t i = 0; i < f.size() && f[i] <= 20.0; ++i) {
    const Eigen::VectorXcd H = linear_.response(f[i]) * Eigen::Vector4d(sign.data());
    for (std::size_t k = 0; k < linear_.names.size(); ++k) {
      const std::string& sensor = linear_.names[k];
      const std::complex<double> expected = H[static_cast<Eigen::Index>(k)],
                                 found = std::polar(measured["tf_" + sensor][i],
                                                    measured["phase_" + sensor][i]);
      // The body's center does not move vertically in roll to first order, because of the symmetry:
      // its motion has only even powers.
      if (GetParam() == PostMode::roll && sensor == "body_z") {
        EXPECT_LT(std::abs(found), 1e-6 * measured["tf_hub_FL"][i]) << f[i];
        EXPECT_LT(measured["coherence_body_z"][i], 0.1) << f[i];
        continue;
      }
      EXPECT_LT(std::abs(found - expected), 0.02 * std::abs(expected)) << sensor << " " << f[i];
      // The body hardly moves vertically in pitch: nonlinear laws cause a tenth of that motion.
      EXPECT_GT(measured["coherence_" + sensor][i], sensor == "body_z" ? 0.98 : 0.995)
          << sensor << " " << f[i];
    }
  }
}

// At 0.1 m/s in heave the tires of so light a car leave the plates, which no linear model
// represents. The rear wheels resonate there, at 11 Hz: their response has an error of a quarter.
TEST(FourPost, WhereItsTiresLeaveThePlatesTheCoherenceFalls) {
  const auto car = car::Car::make(car::race_car(false), car::spring_tires());
  ASSERT_TRUE(car);
  const auto runs = run_both_ways(**car, sweep_test({.velocity = 0.1}, 1e-3));
  ASSERT_TRUE(runs) << runs.failure().reason;
  const std::vector<double>& load = runs->up["Fz_RL"];
  ASSERT_EQ(*std::min_element(load.begin(), load.end()), 0.0);
  const Channels measured = spectra(*runs, PostMode::heave, 1000.0, {.moving = 20.0});
  const std::vector<double>&f = measured["frequency"], &coherence = measured["coherence_hub_RL"];
  const auto least = std::min_element(coherence.begin(), coherence.end());
  EXPECT_LT(*least, 0.95);
  EXPECT_NEAR(f[static_cast<std::size_t>(least - coherence.begin())], 11.5, 1.5);
}

INSTANTIATE_TEST_SUITE_P(Modes,
                         FourPostOfALinearCar,
                         testing::Values(PostMode::heave, PostMode::pitch, PostMode::roll));

// The signals of the modes are orthogonal: each mode has no component in the others.
TEST(FourPost, TheModesOfItsPostsDoNotMix) {
  for (const PostMode a : {PostMode::heave, PostMode::pitch, PostMode::roll, PostMode::warp})
    for (const PostMode b : {PostMode::heave, PostMode::pitch, PostMode::roll, PostMode::warp}) {
      double product = 0.0;
      for (std::size_t i = 0; i < 4; ++i) product += signs_of(a)[i] * signs_of(b)[i];
      EXPECT_EQ(product, a == b ? 4.0 : 0.0);
    }
}

// The identified stiffness k and damping c are those of the tire at any load.
TEST(CarLinear, ProbingASpringTireFindsItsNumbers) {
  const auto car = car::Car::make(car::race_car(true), car::spring_tires(420.0));
  ASSERT_TRUE(car);
  const road::PlaneRoad flat{road::PlaneRoad::Settings{}};
  const auto state = (*car)->settle(flat, 0.0, {});
  ASSERT_TRUE(state);
  const auto slopes = car::probe(state->wheels[0], flat, 0.0);
  ASSERT_TRUE(slopes);
  EXPECT_NEAR(slopes->stiffness(2, 2), 117e3, 1e-4 * 117e3);
  EXPECT_NEAR(slopes->damping(2, 2), 420.0, 1e-4 * 420.0);
  EXPECT_NEAR(slopes->stiffness(1, 1), 0.0, 1.0);
}

}  // namespace
}  // namespace latsch::experiment
