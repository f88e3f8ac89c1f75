// SPDX-License-Identifier: Apache-2.0
// A tire that rolls in time, for tests.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/passage/rolling_transient.h"
#include "models/fe_tire/rolling/rolling_tire.h"

namespace latsch::fe_tire {

inline constexpr double kTwoSixBar = 2.6e5, kRollsAt = 30.0, kPressedDown = 0.02;  // Pa, m/s, m

inline TireDescription with_few_columns(bool relaxes) {
  TireDescription tire = reference_tire_b();
  tire.element = ElementKind::solid_shell;
  tire.section.meridional = 13;
  if (relaxes)
    for (Rubber& rubber : tire.rubbers) rubber.prony = *constant_loss_factor(0.2, 0.1, 1000.0);
  return tire;
}

/// Tire B with few columns that rolls freely, elastic or with rubber that relaxes.
class Passing {
 public:
  explicit Passing(bool relaxes, std::optional<double> mu = 1.0, double speed = kRollsAt)
      : description_(with_few_columns(relaxes)),
        losses_(build_losses(description_)),
        tire_(description_),
        inflated_(*tire_.inflate(kTwoSixBar)),
        rolling_(tire_),
        passage_(tire_) {
    rolling_.set_history(losses_, inflated_);
    passage_.set_history(losses_, inflated_);
    const auto pressed = tire_.advance(tire_.over(inflated_, {}, FeTire::Poses::any),
                                       {FeTire::below(inflated_, kPressedDown)});
    start_ = rolling_.start(pressed->back());
    RollingCase of = start_.of;
    of.speed = speed;
    of.spin = speed / 0.312;
    of.friction.at_rest = mu.value_or(0.0);
    if (mu) of.drive = 0.0;
    free_ = roll(start_, of);
  }

  RollingState roll(const RollingState& from, const RollingCase& of) {
    auto found = rolling_.roll(from, of);
    EXPECT_TRUE(found) << found.failure().reason;
    return *std::move(found);
  }
  TransientForces start(const RollingState& state, const RollingTransientSettings& settings) {
    auto found = passage_.start(state, settings);
    EXPECT_TRUE(found) << found.failure().reason;
    return *found;
  }
  TransientForces advance(const WheelMoment& to) {
    auto found = passage_.advance(to);
    EXPECT_TRUE(found) << found.failure().reason;
    return found ? *found : TransientForces();
  }

  TireDescription description_;
  LossMaterials losses_;
  FeTire tire_;
  Inflated inflated_;
  RollingTire rolling_;
  RollingTransient passage_;
  RollingState start_, free_;
};

}  // namespace latsch::fe_tire
