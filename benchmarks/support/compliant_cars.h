// SPDX-License-Identifier: Apache-2.0
// Synthetic front corners on a K&C rig. Their parameters are known, so the fit of
// studies/compliance/axes.toml and its bands can be checked.
//
// A car has hardpoints displaced by up to 10 mm in each direction, every stiffness drawn from the
// prior that the study states, its sixteen numbers measured with the noise that the study states,
// and each stiffness started at 3 to 15 times its value (uniform in the logarithm).
#pragma once

#include <filesystem>
#include <string>

#include "correlation/study/study.h"

namespace latsch::benchmarks {

struct CompliantCar {
  correlation::Study study;  // the study a user would write, with its measured numbers
  DesignPoint truth;
  Channels recording;  // recording of the true car, including predicted experiments
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
