// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/rolling_ring.h"

#include "models/ring_tire/description/ring_reader.h"
#include "models/ring_tire/ring/ring_tire.h"

namespace latsch::ring_tire {

RollingRing::RollingRing(const Document& numbers)
    : numbers_(numbers), parameters_(read_ring_tire(numbers.root())) {}

std::unique_ptr<Tire> RollingRing::tire(const Inflation& pressure) const {
  return std::make_unique<RingTire>(parameters_at(pressure));
}

RingParameters RollingRing::parameters_at(const Inflation& pressure) const {
  if (!pressure) return parameters_;
  Document numbers = numbers_;
  numbers.set("pressure", *pressure);
  return read_ring_tire(numbers.root());
}

}  // namespace latsch::ring_tire
