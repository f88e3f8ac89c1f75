// SPDX-License-Identifier: Apache-2.0
// Slopes of the values of an experiment that a campaign is to make predictable.
#pragma once

#include <Eigen/Core>
#include <string>

#include "correlation/campaign/campaign_start.h"

namespace latsch::correlation {

/// Returns the derivatives of the differences of an experiment, in its errors of 100 %, by the free
/// variables of the unit cube. Runs the model at the point of the start and, unless the model
/// computes slopes, beside it. Fails if the model fails there.
Result<Eigen::MatrixXd> predicted_slopes(const Study& study,
                                         const CampaignStart& start,
                                         const std::string& experiment);

}  // namespace latsch::correlation
