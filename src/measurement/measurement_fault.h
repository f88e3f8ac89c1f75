// SPDX-License-Identifier: Apache-2.0
// Says why a measurement is useless and at which of its points; the reader of a file adds the line.
#pragma once

#include <string>

namespace latsch {

struct MeasurementFault {
  int point = -1;       // -1: the measurement as a whole
  std::string message;  // "force is -3, expected more than 0 N"
};

}  // namespace latsch
