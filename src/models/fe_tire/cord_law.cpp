// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/cord_law.h"

#include <cmath>

namespace latsch::fe_tire {

CordStress stress(const CordLayer& layer, double e) {
  constexpr double w = kCordTransition;
  const double root = std::sqrt(e * e + w * w);
  const double E_c = layer.E_compression, step = layer.E_tension - E_c;
  return {.S = layer.pretension + E_c * e + step * 0.5 * (e + root - w),
          .tangent = E_c + step * 0.5 * (1.0 + e / root)};
}

}  // namespace latsch::fe_tire
