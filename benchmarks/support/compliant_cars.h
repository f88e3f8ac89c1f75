// SPDX-License-Identifier: Apache-2.0
// Synthetic front suspension corners on a K&C rig. Their parameters are known, so the fit of
// studies/compliance/axes.toml and its uncertainty bands can be checked.
//
// A car's hardpoints are displaced by up to 10 mm in each direction and its stiffnesses are drawn
// from the prior that the study states. Its sixteen K&C numbers have the measurement noise that the
// study states. The fit starts each stiffness at 3 to 15 times its value (uniform in the
// logarithm).
#pragma once

#include <filesystem>
#include <string>

#include "correlation/study/study.h"

namespace latsch::benchmarks {

struct CompliantCar {
  /// the study as a user would write it, with the measured numbers of this car
  correlation::Study study;
  DesignPoint truth;
  Channels recording;  // results of the true car, including those of experiments that are predicted
};

class CompliantCars {
 public:
  /// The studies of the cars are written into `folder`.
  CompliantCars(std::filesystem::path folder, std::uint64_t seed);

  CompliantCar draw(int number) const;

 private:
  std::filesystem::path folder_;
  std::uint64_t seed_;
  std::string study_, corner_;
};

}  // namespace latsch::benchmarks
