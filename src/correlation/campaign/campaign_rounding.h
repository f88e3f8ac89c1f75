// SPDX-License-Identifier: Apache-2.0
// Rounds the settings of tests to numbers that a person can set, and lets tests share them.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "correlation/study/settings/campaign_settings.h"

namespace latsch::correlation {

/// Returns the step to which values of a setting are rounded, in its unit: 1, 2 or 5 times a power
/// of ten, at most a hundredth of the range.
double rounding_step(const CampaignSetting& setting);

/// Returns a value of a setting, SI, without the rounding of the last digits: one that a file
/// writes with at most ten digits.
double tidy_value(const CampaignSetting& setting, double value);

/// Returns the places of tests, in the unit cube, with values of a setting that are nearer than 2 %
/// of its range made equal, and rounded. A place that `admits` then refuses is rounded to other
/// neighbors, or stays as it was.
std::vector<Eigen::VectorXd> rounded_places(
    const CampaignSettings& campaign,
    const std::vector<Eigen::VectorXd>& places,
    const std::function<bool(const Eigen::VectorXd&)>& admits);

}  // namespace latsch::correlation
