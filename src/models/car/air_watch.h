// SPDX-License-Identifier: Apache-2.0
// Counts the samples of a run in which the floor of a car is outside of the heights of its map of
// air forces. The map is constant beyond its heights (models/car/aero_map.h), so its coefficients
// are assumed there, not measured.
#pragma once

#include <array>
#include <string>

#include "models/car/car.h"

namespace latsch::car {

class AirWatch {
 public:
  /// Takes a sample at `time`, s. A car at rest, which has no air forces, and a car without a map
  /// do not count.
  void see(const Car& car, const CarState& state, double time);
  /// Returns a sentence on the first sample outside of the map: time, axle, height, heights of the
  /// map; empty if no sample was outside. Later samples do not change it.
  const std::string& first() const { return first_; }
  /// Returns a sentence with the share of the samples outside of the map, and for each axle the
  /// heights that the floor reached and those of the map; empty if no sample was outside.
  std::string sentence() const;

 private:
  struct AtAxle {
    AeroMap::Heights map{};
    double least = 0.0, most = 0.0;  // m, heights that the floor reached
    long outside = 0;                // samples
  };
  std::array<AtAxle, 2> axles_;
  std::string first_;
  long samples_ = 0, outside_ = 0;  // all samples; those outside of the map at any axle
};

}  // namespace latsch::car
