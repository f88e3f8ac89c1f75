// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/spin_speed.h"

#include <cmath>

#include "base/error.h"
#include "base/units.h"

namespace latsch::experiment {
namespace {

constexpr const char* kKey = "speed";
constexpr double kFastestRoad = 400.0;   // m/s, faster than any wheel rolls
constexpr double kFastestSpin = 2000.0;  // rad/s

}  // namespace

SpinSpeed read_spin_speed(const Node& test) {
  SpinSpeed speed;
  try {
    speed = {test.quantity(kKey, "rad/s"), false};
  } catch (const InputError&) {
    try {
      speed = {test.quantity(kKey, "m/s"), true};
    } catch (const InputError&) {
      test.reject(kKey,
                  "is neither a speed such as \"100 km/h\" nor a speed of rotation such as \"90 "
                  "rad/s\"");
    }
  }
  if (speed.value == 0.0)
    test.reject(kKey, "is 0, expected the speed of a tire that spins, or no speed");
  if (std::abs(speed.value) > (speed.is_of_road ? kFastestRoad : kFastestSpin))
    test.reject(
        kKey,
        "is " + speed_in_words(speed) + ", expected at most " +
            speed_in_words({speed.is_of_road ? kFastestRoad : kFastestSpin, speed.is_of_road}));
  return speed;
}

std::string speed_in_words(const SpinSpeed& speed) {
  return format_quantity(speed.value, speed.is_of_road ? "km/h" : "rad/s", 4);
}

}  // namespace latsch::experiment
