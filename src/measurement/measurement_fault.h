// SPDX-License-Identifier: Apache-2.0
// The reason why a measurement cannot be used, and the point that causes it; the reader of the file
// adds the line.
#pragma once

#include <string>

namespace latsch {

struct MeasurementFault {
  int point = -1;       // index of the point; -1: the measurement as a whole
  std::string message;  // "force is -3, expected more than 0 N"
};

}  // namespace latsch
