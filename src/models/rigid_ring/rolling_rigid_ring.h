// SPDX-License-Identifier: Apache-2.0
// The rigid ring of a tree of numbers as a model that rolls.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/document.h"
#include "models/magic_formula/tree/rolling_formula.h"
#include "models/tire/rolls.h"

namespace latsch::rigid_ring {

class RollingRigidRing final : public Rolls, public MeetsLimits {
 public:
  /// Throws InputError as magic_formula::parameters_of() does.
  explicit RollingRigidRing(const Document& numbers) : formula_(numbers) {}

  /// Throws InputError if the parameters do not define a ring.
  std::unique_ptr<Tire> tire(const Inflation& pressure = {}) const override;
  std::vector<std::string> limits_met() const override { return formula_.limits_met(); }

  const magic_formula::Parameters& parameters() const { return formula_.parameters(); }
  /// Records a load, N, under which a tire of this model stood.
  void stood_under(double load) { formula_.stood_under(load); }

 private:
  magic_formula::RollingFormula formula_;  // the slip forces, and the limits of their file
};

}  // namespace latsch::rigid_ring
