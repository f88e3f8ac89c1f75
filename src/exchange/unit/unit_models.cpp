// SPDX-License-Identifier: Apache-2.0
#include "exchange/unit/unit_models.h"

#include "base/error.h"
#include "base/text.h"
#include "models/car/rolling_car.h"
#include "models/magic_formula/tree/rolling_formula.h"
#include "models/rigid_ring/rolling_rigid_ring.h"
#include "models/ring_tire/rolling_ring.h"

namespace latsch::exchange {

const std::vector<std::string>& slim_tire_kinds() {
  static const std::vector<std::string> kinds = {"ring_tire", "rigid_ring", "magic_formula"};
  return kinds;
}

RollingModel slim_tire(const std::string& kind, const Document& numbers) {
  if (kind == "ring_tire") return {std::make_shared<ring_tire::RollingRing>(numbers)};
  if (kind == "rigid_ring") {
    const auto ring = std::make_shared<rigid_ring::RollingRigidRing>(numbers);
    return {ring, ring};
  }
  if (kind == "magic_formula") {
    const auto formula = std::make_shared<magic_formula::RollingFormula>(numbers);
    return {formula, formula};
  }
  throw InputError({numbers.file(), 0},
                   "is a tire of kind " + in_quotes(kind) +
                       ", which this library lacks: expected a flexible ring, a rigid ring or a "
                       "Magic Formula");
}

DrivingModel slim_car(const Document& numbers) {
  const auto car = std::make_shared<car::RollingCar>(
      numbers, [](const std::string& kind, const Document& tire, const std::string&, bool) {
        return slim_tire(kind, tire);
      });
  return {car, car};
}

RollingModel SlimModels::tire(const std::string& kind, const std::filesystem::path& file) const {
  return slim_tire(kind, Document::read(file));
}

DrivingModel SlimModels::car(const std::filesystem::path& file) const {
  return slim_car(Document::read(file));
}

}  // namespace latsch::exchange
