// SPDX-License-Identifier: Apache-2.0
// Values of the design variables, in the order of the design space, in SI.
#pragma once

#include <cstring>
#include <string>
#include <vector>

namespace latsch {

struct DesignPoint {
  std::vector<double> values;  // SI, one for each variable of the space

  bool operator==(const DesignPoint&) const = default;

  /// Returns the exact bits of the values: two points are the same trial if and only if their bits
  /// agree.
  std::string bits() const {
    std::string bytes(values.size() * sizeof(double), '\0');
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
  }
};

}  // namespace latsch
