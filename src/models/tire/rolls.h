// SPDX-License-Identifier: Apache-2.0
// A model from which tires that roll on a road in time steps are made, whatever its kind.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "models/tire/tire.h"

namespace latsch {

using Inflation = std::optional<double>;  // Pa, gauge; none: the tire's own

/// The model rolls on a road in time steps.
struct Rolls {
  static constexpr const char* kName = "rolls";  // in messages
  virtual ~Rolls() = default;
  /// Returns a new tire at rest under this pressure. Throws InputError if the pressure does not
  /// suit this tire.
  virtual std::unique_ptr<Tire> tire(const Inflation& pressure = {}) const = 0;
  /// Returns a sentence for everything that such a tire assumes, which its file does not say.
  virtual std::vector<std::string> assumed_in_time() const { return {}; }
  /// Half of the width over which the tire follows the road, and the height of its section, m.
  struct Felt {
    double half_width = 0.0, section = 0.0;
  };
  /// Returns nullopt if this is asked of KnowsLimits (experiment/language/known_limits.h).
  virtual std::optional<Felt> felt() const { return std::nullopt; }
};

/// A model that reports which of its limits its tires have met.
struct MeetsLimits {
  virtual ~MeetsLimits() = default;
  /// Returns a sentence for every limit that was met since the model was built: validity ranges of
  /// its file that were left, conditions that have no effect on it.
  virtual std::vector<std::string> limits_met() const { return {}; }
};

/// A model that rolls, and its limits; these are null if it knows none.
struct RollingModel {
  std::shared_ptr<const Rolls> rolls;
  std::shared_ptr<const MeetsLimits> limits = {};

  /// Returns the limits met; none if the model knows no limits.
  std::vector<std::string> limits_met() const {
    return limits ? limits->limits_met() : std::vector<std::string>();
  }
};

/// Largest distance, m, that a tire may move in one time step: a block of its tread makes and loses
/// contact within a few steps.
inline constexpr double kFarthestStep = 0.02;

/// Returns a Failure if a deflection, m, exceeds the section height of any tire of this radius. If
/// the tire's file states its rim radius, the limit is lower.
Status check_depth(const Tire& tire, double deflection);

}  // namespace latsch
