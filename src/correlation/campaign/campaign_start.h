// SPDX-License-Identifier: Apache-2.0
// The start of a campaign of measurements: the point of the variables, the information about them,
// and the noise of the measured channels.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "correlation/analysis/identifiability.h"
#include "correlation/study/study.h"

namespace latsch::correlation {

/// Noise of one measured channel.
struct ChannelNoise {
  MeasurementNoise noise;  // its share counts from the channel's largest value
  bool is_stated = false;  // false: that of fitted experiments
};

struct CampaignStart {
  DesignPoint point;                // point at which slopes are taken
  std::vector<int> free;            // indices of the variables that the study may move
  Eigen::MatrixXd data;             // information of data and priors, free variables in ranges
  bool is_fitted = false;           // false: priors alone
  Eigen::VectorXd lengths;          // lengths of differences, one for each variable of the study
  std::vector<ChannelNoise> noise;  // one for each measured channel
  std::vector<DesignPoint> draws = {};  // points of the posterior density; empty: none
};

/// Returns the start after a fit, or a Failure that says what is missing.
Result<CampaignStart> start_after_fit(const Study& study, const Identifiability& what);

/// Returns the start of a study that has not been fitted, from its priors; a Failure without them.
Result<CampaignStart> start_before_fit(const Study& study);

/// Returns what is known of the variables of a rival model, without noise of channels: from its fit
/// or, without one (nullptr), from its priors alone.
Result<CampaignStart> start_of_rival(const Study& rival, const Identifiability* what);

/// Returns the present information of the free variables: that of data and priors, and 12 for each
/// variable, as of a number anywhere in its range (d_optimality.h).
Eigen::MatrixXd present_information(const CampaignStart& start);

}  // namespace latsch::correlation
