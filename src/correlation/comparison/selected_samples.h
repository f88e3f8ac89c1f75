// SPDX-License-Identifier: Apache-2.0
// The samples of a recording that a comparison with a reference uses: those behind its run-in.
#pragma once

#include <string>
#include <vector>

#include "correlation/comparison/model_comparison_file.h"
#include "measurement/channels.h"

namespace latsch::correlation {

/// Returns the samples of a channel from `file.from` on, or all of them if the channel has other
/// samples than the time. `whose` names the recording. Throws InputError if there is no such
/// channel, or if `from` lies before the record.
std::vector<double> selected_samples(const ModelComparisonFile& file,
                                     const Channels& channels,
                                     const std::string& name,
                                     const std::string& whose);

}  // namespace latsch::correlation
