// SPDX-License-Identifier: Apache-2.0
// A varied tire (tire_slopes.h) with its elements. It shares what the base tire already has, and
// knows for every element which parts the moved number changes. The other parts have zero slope and
// are not evaluated.
#pragma once

#include <optional>
#include <vector>

#include "models/fe_tire/analysis/fe_tire_impl.h"
#include "models/fe_tire/slopes/moved_numbers.h"
#include "models/fe_tire/slopes/tire_slopes.h"

namespace latsch::fe_tire {

struct Varied {
  using Base = FeTire::Impl;
  const VariedTire& tire;
  bool same_shape;
  std::optional<Ring> own_ring, own_even;  // only if its shape differs
  std::optional<RingElements> elements, even_elements;
  std::vector<MovedNumber::Parts> parts;  // parts of the section's elements that differ

  Varied(const Varied&) = delete;  // elements refer to their ring
  Varied(const VariedTire& varied, const Base& base);

  const RingElements& even() const { return even_elements ? *even_elements : *elements; }
  const Ring& ring() const { return elements->ring(); }
};

/// The tread of a varied tire with another shape, on the unknowns of the base tire.
struct VariedTread {
  RingUnknowns unknowns;
  TreadSurface surface;

  VariedTread(const VariedTread&) = delete;  // the surface refers to its unknowns
  VariedTread(const Varied& varied, const Systems& all, Varied::Base& base, bool is_halved);
};

/// The tires with a number moved to either side.
struct VariedPair {
  Varied below, above;
  std::vector<MovedNumber::Parts> parts;  // parts that differ on either side
  VariedPair(const Variation& variation, const Varied::Base& base);
};

}  // namespace latsch::fe_tire
