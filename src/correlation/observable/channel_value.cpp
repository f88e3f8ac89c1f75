// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/channel_value.h"

#include <algorithm>
#include <numeric>

namespace latsch::correlation {

const std::vector<std::string>& names_of_values() {
  static const std::vector<std::string> names{"largest", "smallest", "mean", "first", "last"};
  return names;
}

double value_of(const std::string& of, const std::vector<double>& values) {
  if (of == "smallest") return *std::min_element(values.begin(), values.end());
  if (of == "first") return values.front();
  if (of == "last") return values.back();
  if (of == "mean") {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  }
  return *std::max_element(values.begin(), values.end());
}

std::vector<double> slopes_of(const std::string& of, const Channel& channel) {
  const auto rows = std::ssize(channel.values);
  const double value = value_of(of, channel.values);
  const auto row =
      std::find(channel.values.begin(), channel.values.end(), value) - channel.values.begin();
  const bool is_extreme = of == "largest" || of == "smallest";
  std::vector<double> slopes;
  for (auto from = channel.slopes.begin(); from != channel.slopes.end(); from += rows)
    slopes.push_back(is_extreme ? from[row] : value_of(of, {from, from + rows}));
  return slopes;
}

}  // namespace latsch::correlation
