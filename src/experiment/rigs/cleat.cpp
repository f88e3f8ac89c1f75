// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/cleat.h"

#include <algorithm>

namespace latsch::experiment {

std::optional<Cleat> read_cleat(const Node& test, double widest) {
  const auto table = test.find_table("cleat");
  if (!table) return std::nullopt;
  Cleat cleat;
  cleat.height = table->quantity("height", "m", {0.0, 0.2, true});
  cleat.length = table->quantity("length", "m", {0.0, 1.0, true});
  const double most = std::min(cleat.height, 0.5 * cleat.length);
  cleat.bevel = table->quantity("bevel", "m", Range::between(0.0, most), 0.0);
  cleat.angle = table->quantity("angle", "rad", Range::between(-widest, widest), 0.0);
  return cleat;
}

}  // namespace latsch::experiment
