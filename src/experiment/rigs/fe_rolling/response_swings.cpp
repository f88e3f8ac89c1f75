// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_rolling/response_swings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/units.h"
#include "models/fe_tire/rolling/rolling_tire.h"

namespace latsch::experiment {
namespace {

using fe_tire::RollingCase;
using fe_tire::SlipInput;

/// Most halvings of a swing in the search for one over which response and chord agree.
constexpr int kMostHalvings = 6;

/// Returns the case of a state with its slip changed, at the same speed along the heading.
RollingCase swung(const fe_tire::RollingState& state, SlipInput slip, double by, bool follows) {
  RollingCase of = state.of;
  of.drive.reset();
  if (!follows) of.load.reset();
  const double along = of.speed * std::cos(of.slip_angle);
  if (slip == SlipInput::angle) of.slip_angle += by;
  if (slip == SlipInput::spin) of.spin *= 1.0 + by;
  if (slip == SlipInput::turn) of.turn_slip += by;
  if (slip == SlipInput::camber) of.camber += by;
  of.speed = along / std::cos(of.slip_angle);
  return of;
}

double main_force(const fe_tire::RollingForces& forces, int index) {
  return index < 3 ? forces.force[index] : forces.moment[index - 3];
}

/// Returns the slope of the main force between the steady states at a swing to both sides.
Result<double> chord(fe_tire::RollingTire& rolling,
                     const fe_tire::RollingState& state,
                     const ResponseSlip& slip,
                     double swing,
                     bool follows) {
  double sum = 0.0;
  for (const double side : {1.0, -1.0}) {
    const auto found = rolling.roll(state, swung(state, slip.input, side * swing, follows));
    if (!found) return found.failure();
    sum += side * main_force(found->forces, slip.judged);
  }
  return sum / (2.0 * swing);
}

}  // namespace

std::vector<std::string> swings_in_words(TireRig& rig,
                                         const RollingResponseTest& test,
                                         const RolledState& rolled,
                                         const std::vector<fe_tire::SlipResponse>& at_rest,
                                         std::size_t number) {
  constexpr const char* kForces[] = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
  const fe_tire::RollingState& state = rolled.state;
  const auto& round = rig.inflated(state.pressure);
  if (!round) return {};
  fe_tire::RollingTire rolling(rig.tire());
  rolling.set_history(rig.losses(), *round);
  const bool follows = test.axle == fe_tire::Axle::follows;
  const auto slides = std::ranges::count(state.patch, false, &fe_tire::RollingPatchPoint::sticks);
  std::vector<std::string> sentences;
  for (std::size_t k = 0; k < test.slips.size(); ++k) {
    const ResponseSlip& slip = test.slips[k];
    const double slope =
        (slip.judged < 3 ? at_rest[k].force[slip.judged] : at_rest[k].moment[slip.judged - 3])
            .real();
    const bool is_moment = slip.judged >= 3;
    // The spin changes by a share; kappa of the response counts from the free wheel.
    const double per = slip.input == SlipInput::spin ? 1.0 + rolled.kappa : 1.0;
    const auto in_words = [&](double value) {
      return fmt::format("{:.4g} {}", value / per, is_moment ? slip.moment_unit : slip.force_unit);
    };
    const auto swing_in_words = [&](double swing) {
      return format_quantity(swing * per, slip.swing_unit, 2);
    };
    const std::string what = fmt::format(
        "rolling_response: state {}, {} by {}", number, kForces[slip.judged], slip.of_slip);
    double swing = slip.swing / per;
    const auto over = chord(rolling, state, slip, swing, follows);
    if (!over) {
      sentences.push_back(fmt::format(
          "{}: over which swing the response holds is not known: {}", what, over.failure().reason));
      continue;
    }
    const auto agrees = [&](double value) {
      return std::abs(slope - value) <= kToldDifference * std::abs(value);
    };
    if (agrees(*over)) continue;
    std::string words = fmt::format("{}: {} at 0 Hz, but {} between steady states {} to both sides",
                                    what,
                                    in_words(slope),
                                    in_words(*over),
                                    swing_in_words(swing));
    bool found = false;
    for (int half = 0; half < kMostHalvings && !found; ++half) {
      swing *= 0.5;
      const auto smaller = chord(rolling, state, slip, swing, follows);
      if (!smaller) break;
      found = agrees(*smaller);
    }
    const std::string least = swing_in_words(swing);
    if (found)
      words += fmt::format(
          "; {} of {} points slide at the limit of friction {:g}, and the response holds for "
          "swings in which hardly any point changes between sticking and sliding: up to {} both "
          "agree within {:g} %; a test slip_history with the swing of the measurement has no such "
          "limit, and more elements below the tread widen it",
          slides,
          state.patch.size(),
          state.of.friction.at_rest,
          least,
          100.0 * kToldDifference);
    else if (rig.losses().is_elastic())
      words += fmt::format(", and they still differ at {}", least);
    else
      words += ", because the response leaves losses out";
    sentences.push_back(std::move(words));
  }
  return sentences;
}

}  // namespace latsch::experiment
