// SPDX-License-Identifier: Apache-2.0
// Speed of a tire that spins off the ground, as a test states it.
#pragma once

#include <string>

#include "base/document.h"

namespace latsch::experiment {

/// Speed of rotation of a tire that does not touch the ground.
struct SpinSpeed {
  double value = 0.0;       // rad/s about the spin axis, or m/s
  bool is_of_road = false;  // true: m/s, of a wheel that rolls on the radius of the inflated tire
  /// Returns rad/s for the outer radius, m, of the tire inflated at rest.
  double on(double radius) const { return is_of_road ? value / radius : value; }
};

/// Reads the key `speed`: "100 km/h" or "90 rad/s". Throws InputError for another quantity, for a
/// speed of 0 and for one that no tire reaches.
SpinSpeed read_spin_speed(const Node& test);

/// Returns "100 km/h" or "90 rad/s".
std::string speed_in_words(const SpinSpeed& speed);

}  // namespace latsch::experiment
