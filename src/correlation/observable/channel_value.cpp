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
  const std::size_t rows = channel.values.size(), n = channel.slopes.size() / rows;
  const auto row = [&](std::size_t i) { return channel.slopes.begin() + static_cast<long>(i * n); };
  if (of == "mean") {
    std::vector<double> mean(n, 0.0);
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < n; ++j) mean[j] += row(i)[j] / static_cast<double>(rows);
    return mean;
  }
  const auto at =
      std::find(channel.values.begin(), channel.values.end(), value_of(of, channel.values));
  const auto i = static_cast<std::size_t>(of == "last" ? rows - 1 : at - channel.values.begin());
  return {row(i), row(i + 1)};
}

}  // namespace latsch::correlation
