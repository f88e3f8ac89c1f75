// SPDX-License-Identifier: Apache-2.0
#include "correlation/basic_data/slip_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/random.h"

namespace latsch::correlation {
namespace {

using magic_formula::MagicFormula;
using magic_formula::Parameters;

Parameters truth() {
  Parameters p;
  p.UNLOADED_RADIUS = 0.2;
  p.FNOMIN = 1600.0;
  p.VERTICAL_STIFFNESS = 2e5;
  p.NOMPRES = p.INFLPRES = 8e4;
  p.PCX1 = 1.5;
  p.PDX1 = 1.3;
  p.PKX1 = 40.0;
  p.PCY1 = 1.4;
  p.PDY1 = 1.3;
  p.PDY2 = -0.15;
  p.PEY1 = -0.6;
  p.PKY1 = -35.0;
  p.PKY2 = 1.5;
  return p;
}

/// Sweeps of +-10 degrees at three loads, measured with a spread of `noise` N.
SlipRecord sweeps(double noise) {
  SlipRecord record;
  const MagicFormula tire(truth());
  RandomStream random(9, 0);
  for (const double Fz : {800.0, 1600.0, 2400.0}) {
    for (int i = -50; i <= 50; ++i) {
      record.states.push_back({Fz, 0.0, 0.0035 * i, 0.0, 0.0, 11.0, 8e4});
      const auto s = tire.evaluate(record.states.back());
      record.Fy.push_back(s.Fy + noise * random.normal());
      record.Mz.push_back(s.Mz + noise * random.normal());
    }
  }
  return record;
}

const SlipFitStage kCurve{
    "curve", SlipChannel::Fy, {"PCY1", "PDY1", "PDY2", "PEY1", "PKY1", "PKY2"}, true};

Parameters off() {
  Parameters p = truth();
  p.PCY1 = 1.2;
  p.PDY1 = 1.6;
  p.PDY2 = 0.0;
  p.PEY1 = 0.0;
  p.PKY1 = -25.0;
  p.PKY2 = 2.2;
  return p;
}

TEST(SlipFit, FindsTheCoefficientsOfATireItself) {
  const SlipFit found = fit(off(), sweeps(0.0), kCurve);
  EXPECT_LT(found.error, 1e-6);
  EXPECT_NEAR(found.parameters.PCY1, 1.4, 1e-3);
  EXPECT_NEAR(found.parameters.PDY1, 1.3, 1e-3);
  EXPECT_NEAR(found.parameters.PKY1, -35.0, 1e-2);
  EXPECT_EQ(found.parameters.PKX1, 40.0);  // not of this stage
}

TEST(SlipFit, IntervalsHoldTheTruthAndSayHowWell) {
  const SlipFit found = fit(off(), sweeps(10.0), kCurve);
  const SlipRecord record = sweeps(10.0);
  EXPECT_NEAR(relative_error(found.parameters, record, SlipChannel::Fy), found.error, 1e-12);
  // 95 % each; twice the half width leaves out one in 10^4.
  for (std::size_t i = 0; i < found.variables.size(); ++i) {
    const double expected = truth().*magic_formula::find_parameter(found.variables[i].name)->member;
    EXPECT_NEAR(found.variables[i].initial, expected, 2.0 * found.half_width(static_cast<int>(i)))
        << found.variables[i].name;
    EXPECT_TRUE(std::isfinite(found.half_width(static_cast<int>(i))));
  }
}

TEST(SlipFit, WhatCannotBeFittedIsNamed) {
  EXPECT_THROW(fit(off(), sweeps(0.0), {"x", SlipChannel::Fy, {"FNOMIN"}, false}), InputError);
  SlipRecord leaning = sweeps(0.0);
  for (auto& state : leaning.states) state.gamma = 0.1;
  EXPECT_THROW(fit(off(), leaning, kCurve), InputError);
}

}  // namespace
}  // namespace latsch::correlation
