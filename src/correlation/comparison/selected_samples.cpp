// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/selected_samples.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/text.h"

namespace latsch::correlation {

std::vector<double> selected_samples(const ModelComparisonFile& file,
                                     const Channels& channels,
                                     const std::string& name,
                                     const std::string& whose) {
  const Channel* channel = channels.find(name);
  if (!channel)
    throw InputError({file.file.string(), 0}, whose + " does not record " + in_quotes(name));
  if (!file.has_from || channel->values.size() != channels["time"].size()) return channel->values;
  const auto& time = channels["time"];
  const double step = (time.back() - time.front()) / static_cast<double>(time.size());
  if (file.from < time.front() - 2.0 * step)  // the first sample may be a step behind the beginning
    throw InputError(
        {file.file.string(), 0},
        fmt::format("from is {:g} s, but {} is recorded from {:g} s on; expected a time "
                    "within the record",
                    file.from,
                    whose,
                    time.front()));
  const auto first = std::lower_bound(time.begin(), time.end(), file.from - 1e-9) - time.begin();
  return {channel->values.begin() + first, channel->values.end()};
}

}  // namespace latsch::correlation
