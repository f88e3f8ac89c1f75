// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/history/dynamic_moduli.h"

#include <variant>

namespace latsch::fe_tire {

Materials stiffened(const Materials& relaxed, const LossMaterials& losses, double omega) {
  Materials materials = relaxed;
  for (std::size_t i = 0; i < materials.solids.size(); ++i) {
    const double factor = relative_modulus(losses.solids[i].terms, omega).real();
    if (auto* rubber = std::get_if<Hyperelastic>(&materials.solids[i].law)) {
      rubber->C10 *= factor;
      rubber->C01 *= factor;
    }
  }
  for (std::size_t i = 0; i < materials.layers.size(); ++i) {
    const double factor = relative_modulus(losses.layers[i].terms, omega).real();
    materials.layers[i].E_tension *= factor;
    materials.layers[i].E_compression *= factor;
  }
  return materials;
}

}  // namespace latsch::fe_tire
