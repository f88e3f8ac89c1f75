// SPDX-License-Identifier: Apache-2.0
// The noise of measured values, and its use in the fit.
//
// Noise has two more effects. A fit does not start again once the target is no larger than noise
// alone would make it, so a stated noise that is too large ends the fit early. And intervals do not
// have to estimate the noise. With d the difference of a value as compared (objective.h) and sigma
// its stated standard deviation in units of d, a value enters the fit as d / sigma, after a robust
// loss if one is stated (robust_loss.h). With Gaussian noise, the default scales of the losses keep
// 95 % of the efficiency of least squares. The intervals are those of M-estimation (confidence.h).
// The keys are in correlation/laboratory/noise_keys.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "optimization/identifiability/robust_loss.h"

namespace latsch::correlation {

struct MeasurementNoise {
  double relative = 0.0;  // share of what counts as 100 %
  double absolute = 0.0;  // in the SI unit of the compared quantity

  bool operator==(const MeasurementNoise&) const = default;
};

/// Reads `key`, in units of `unit` (SI) if it is absolute; nullopt if it is not given. Throws
/// InputError if it is no positive deviation of that dimension.
std::optional<MeasurementNoise> read_noise(const Node& table,
                                           const std::string& unit,
                                           const std::string& key = "noise");

/// True if the fit estimates the noise: noise = "estimated" or noise = "own_stage".
bool is_estimated(const Node& experiment);

/// True if the noise is the error that an earlier stage left: noise = "own_stage".
bool is_of_own_stage(const Node& experiment);

/// Throws InputError if a scale is missing or belongs to no loss.
RobustLoss read_loss(const Node& table, bool noise_is_stated);

}  // namespace latsch::correlation
