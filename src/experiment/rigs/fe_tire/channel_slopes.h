// SPDX-License-Identifier: Apache-2.0
// Converts the slopes of a tire into slopes of the recorded channels.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "measurement/channels.h"

namespace latsch::experiment {

/// Slopes of channels by name, [values x variables].
using ChannelSlopes = std::vector<std::pair<std::string, Eigen::MatrixXd>>;

Channels with_slopes(const Channels& channels, const ChannelSlopes& slopes);

/// True if at least one of these channels is requested.
bool any_asked(const std::vector<std::string>& asked, const std::vector<std::string>& names);

}  // namespace latsch::experiment
