// SPDX-License-Identifier: Apache-2.0
// Synthetic front corners on a K&C rig: what stands on it is known, so it can be said what the fit
// of studies/compliance/axes.toml finds, and whether its bands hold it.
//
// A car: hardpoints off by up to 10 mm in each direction, every stiffness drawn from the prior that
// the study states, its sixteen numbers measured with the noise that the study states, and each
// stiffness started at 3 to 15 times what it is (uniform in the logarithm).
#pragma once

#include <filesystem>
#include <string>

#include "correlation/study/study.h"

namespace latsch::benchmarks {

struct CompliantCar {
  correlation::Study study;  // as a user would have written it, with its measured numbers
  DesignPoint truth;
  Channels recording;  // of the car as it is, predicted experiments included
};

class CompliantCars {
 public:
  /// Writes the studies of its cars into `folder`.
  CompliantCars(std::filesystem::path folder, std::uint64_t seed);

  CompliantCar draw(int number) const;

 private:
  std::filesystem::path folder_;
  std::uint64_t seed_;
  std::string study_, corner_;
};

}  // namespace latsch::benchmarks
