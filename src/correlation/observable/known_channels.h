// SPDX-License-Identifier: Apache-2.0
// The channels of a trial before there is one: what an experiment or a constraint may name.
#pragma once

#include <string>

namespace latsch::correlation {

struct KnownChannel {
  std::string name;        // "response/z": OUTPUT/QUANTITY
  std::string unit;        // in which people read it
  std::string frame = "";  // "W", "H" or "C" of a force or moment that a rig records
};

}  // namespace latsch::correlation
