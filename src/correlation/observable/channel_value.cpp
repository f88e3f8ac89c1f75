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

}  // namespace latsch::correlation
