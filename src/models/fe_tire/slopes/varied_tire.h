// SPDX-License-Identifier: Apache-2.0
// A varied tire (tire_slopes.h) with its elements. What the base tire has already is shared with
// it, and of every element it is known which parts feel the number that moves: the others have no
// slope and are not evaluated.
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
  std::optional<Ring> own_ring, own_even;  // where its shape is another one
  std::optional<RingElements> elements, even_elements;
  std::vector<MovedNumber::Parts> parts;  // that differ, of the section's elements

  Varied(const Varied&) = delete;  // elements refer to their ring
  Varied(const VariedTire& varied, const Base& base);

  const RingElements& even() const { return even_elements ? *even_elements : *elements; }
  const Ring& ring() const { return elements->ring(); }
};

/// The tread of a varied tire of another shape, on the unknowns of the tire's own.
struct VariedTread {
  RingUnknowns unknowns;
  TreadSurface surface;

  VariedTread(const VariedTread&) = delete;  // the surface refers to its unknowns
  VariedTread(const Varied& varied, const Systems& all, Varied::Base& base, bool is_halved);
};

/// A number moved to both sides.
struct VariedPair {
  Varied below, above;
  std::vector<MovedNumber::Parts> parts;  // that differ on either side
  VariedPair(const Variation& variation, const Varied::Base& base);
};

}  // namespace latsch::fe_tire
