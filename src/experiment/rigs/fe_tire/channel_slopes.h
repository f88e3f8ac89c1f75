// SPDX-License-Identifier: Apache-2.0
// Slopes of a tire brought to the channels of its recording.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "measurement/channels.h"

namespace latsch::experiment {

/// Of channels by their names, [values x variables].
using ChannelSlopes = std::vector<std::pair<std::string, Eigen::MatrixXd>>;

Channels with_slopes(const Channels& channels, const ChannelSlopes& slopes);

/// Whether one of these channels is among those asked for.
bool any_asked(const std::vector<std::string>& asked, const std::vector<std::string>& names);

}  // namespace latsch::experiment
