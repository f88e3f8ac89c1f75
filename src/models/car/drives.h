// SPDX-License-Identifier: Apache-2.0
// A model from which cars that drive in time steps are made.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "models/car/car.h"
#include "models/tire/rolls.h"

namespace latsch {

/// The model is a car that can be driven.
struct Drives {
  static constexpr const char* kName = "drives";  // in messages
  virtual ~Drives() = default;
  /// Returns a new car whose springs carry it in its drawn position under these loads.
  virtual Result<std::unique_ptr<car::Car>> car(const car::CarInputs& at_rest) const = 0;
};

/// A model that drives, and its limits; these are null if it knows none.
struct DrivingModel {
  std::shared_ptr<const Drives> drives;
  std::shared_ptr<const MeetsLimits> limits = {};

  /// Returns the limits met; none if the model knows no limits.
  std::vector<std::string> limits_met() const {
    return limits ? limits->limits_met() : std::vector<std::string>();
  }
};

}  // namespace latsch
