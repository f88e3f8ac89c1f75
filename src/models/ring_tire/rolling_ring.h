// SPDX-License-Identifier: Apache-2.0
// The flexible ring of a tree of numbers as a model that rolls.
#pragma once

#include <memory>

#include "base/document.h"
#include "models/ring_tire/description/ring_parameters.h"
#include "models/tire/rolls.h"

namespace latsch::ring_tire {

class RollingRing final : public Rolls {
 public:
  /// Throws InputError as read_ring_tire() does.
  explicit RollingRing(const Document& numbers);

  std::unique_ptr<Tire> tire(const Inflation& pressure = {}) const override;

  /// The parameters at the pressure of the numbers.
  const RingParameters& parameters() const { return parameters_; }
  /// Returns the parameters of the tire at this inflation pressure.
  RingParameters parameters_at(const Inflation& pressure) const;

 private:
  Document numbers_;
  RingParameters parameters_;
};

}  // namespace latsch::ring_tire
