// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_rolling/cleat_rig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "models/fe_tire/description/reference_tires.h"

namespace latsch::experiment {
namespace {

fe_tire::TireDescription coarse_lossy_tire() {
  fe_tire::TireDescription tire = fe_tire::reference_tire_b();
  tire.element = fe_tire::ElementKind::solid_shell;
  tire.section.meridional = 13;
  for (fe_tire::Rubber& rubber : tire.rubbers)
    rubber.prony = *fe_tire::constant_loss_factor(0.15, 1.0, 1000.0);
  return tire;
}

class CleatRig : public testing::Test {
 protected:
  CleatRig() : description_(coarse_lossy_tire()), tire_(description_), rig_(tire_, 2.6e5) {
    rig_.set_losses(fe_tire::build_losses(description_));
  }

  /// A low cleat on a drum, at 60 km/h and 4 kN; the record begins before it.
  static DrumTest drum() {
    DrumTest test;
    test.speed = 60.0 / 3.6;
    test.load = 4000.0;
    test.diameter = 2.5;
    test.duration = 0.04;
    test.lead = 0.02;
    test.step = test.sample_step = 1e-3;
    return test;
  }
  Channels cross(const DrumTest& test) {
    const auto found = cross_cleat(rig_, test, remarks_);
    EXPECT_TRUE(found) << found.failure().reason;
    return found ? *found : Channels();
  }

  fe_tire::TireDescription description_;
  fe_tire::FeTire tire_;
  TireRig rig_;
  std::vector<std::string> remarks_;
};

TEST_F(CleatRig, KeepsTheForcesOfASmoothDrum) {
  const Channels found = cross(drum());
  const auto [least, most] = std::ranges::minmax(found["Fz"]);
  EXPECT_EQ(found["time"].size(), 40u);
  EXPECT_NEAR(found["time"].front(), -0.019, 1e-12);
  EXPECT_NEAR(found["time"].back(), 0.02, 1e-12);
  EXPECT_LT(most - least, 1e-3 * most);
  // At speed the belt grows, and the axle stays where it was under the load at rest.
  EXPECT_GT(least, 4000.0);
  EXPECT_LT(most, 4600.0);
  EXPECT_LT(found["Fx"].front(), 0.0);  // rolling resistance
}

TEST_F(CleatRig, IsLiftedByACleatThatComesToTheAxleAtTimeZero) {
  DrumTest test = drum();
  test.cleat = Cleat{.height = 0.004, .length = 0.02};
  const Channels found = cross(test);
  const std::vector<double>&Fz = found["Fz"], &time = found["time"];
  EXPECT_NEAR(Fz.front(), cross(drum())["Fz"].front(), 2.0);
  const auto peak = std::ranges::max_element(Fz) - Fz.begin();
  EXPECT_GT(Fz[peak], 1.05 * Fz.front());
  EXPECT_LT(std::abs(time[peak]), 0.012);  // on the patch
  EXPECT_GT(std::ranges::max(found["Fx"]) - std::ranges::min(found["Fx"]), 100.0);
  EXPECT_NE(found["wheel_speed"].front(), found["wheel_speed"].back());
}

TEST_F(CleatRig, PassesTheSamplesOnAsTheyCome) {
  std::size_t blocks = 0, samples = 0;
  const auto count = [&](const Channels& block) {
    ++blocks;
    samples += block["time"].size();
  };
  const Status done = cross_cleat(rig_, drum(), count, remarks_);
  ASSERT_TRUE(done.ok());
  EXPECT_GT(blocks, 1u);
  EXPECT_EQ(samples, 40u);
}

TEST_F(CleatRig, RefusesACleatAsHighAsTheSection) {
  DrumTest test = drum();
  test.cleat = Cleat{.height = 0.3, .length = 0.5};
  const auto found = cross_cleat(rig_, test, remarks_);
  ASSERT_FALSE(found);
  EXPECT_NE(found.failure().reason.find("the rim would hit it"), std::string::npos);
}

TEST_F(CleatRig, SaysHowFarAReducedTireIsFromTheFullOne) {
  DrumTest test = drum();
  test.cleat = Cleat{.height = 0.001, .length = 0.02};
  const Channels full = cross(test);
  EXPECT_TRUE(remarks_.empty());
  rig_.set_reduction(300.0);
  const Channels reduced = cross(test);
  double error = 0.0, change = 0.0;
  for (std::size_t k = 0; k < full["Fz"].size(); ++k) {
    error += std::pow(reduced["Fz"][k] - full["Fz"][k], 2);
    change += std::pow(full["Fz"][k] - full["Fz"][0], 2);
  }
  EXPECT_GT(change, 1.0);
  EXPECT_LT(std::sqrt(error / change), 0.15);
  ASSERT_EQ(remarks_.size(), 1u);
  EXPECT_NE(remarks_[0].find("the tire is reduced to"), std::string::npos) << remarks_[0];
  EXPECT_NE(remarks_[0].find("1 mm lower its load rises by"), std::string::npos) << remarks_[0];
}

TEST_F(CleatRig, SaysWhatItAssumes) {
  DrumTest test = drum();
  test.cleat = Cleat{.height = 0.004, .length = 0.02};
  test.passages = 3;
  const auto says = [&](const std::string& words) {
    return std::ranges::any_of(remarks_on_cleat(rig_, test), [&](const std::string& one) {
      return one.find(words) != std::string::npos;
    });
  };
  EXPECT_TRUE(says("friction 1"));
  EXPECT_TRUE(says("the length of an element"));
  EXPECT_TRUE(says("passages, wheel_start and wheel_step have no effect"));
  EXPECT_FALSE(says("no Prony terms"));
  rig_.set_losses({});
  EXPECT_TRUE(says("no Prony terms"));
}

}  // namespace
}  // namespace latsch::experiment
