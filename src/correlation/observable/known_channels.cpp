// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/known_channels.h"

namespace latsch::correlation {

std::vector<KnownChannel> known_channels(const Simulator& simulator) {
  std::vector<KnownChannel> channels;
  for (const OutputReader& output : simulator.outputs) {
    for (const auto& quantity : output.quantities) {
      channels.push_back({output.name + "/" + quantity.name, quantity.unit});
    }
  }
  return channels;
}

}  // namespace latsch::correlation
