// SPDX-License-Identifier: Apache-2.0
// A tire with a changed parameter (tire_slopes.h) and its elements. It shares what does not change
// with the base tire, and knows for every element which parts the parameter changes. The other
// parts have zero derivatives and are not evaluated.
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
  std::optional<Ring> own_ring, own_even;  // rings of its own; set only if its shape differs
  std::optional<RingElements> elements, even_elements;
  std::vector<MovedNumber::Parts> parts;  // parts of each element of the section that differ

  Varied(const Varied&) = delete;  // not copied, because elements refer to their ring
  Varied(const VariedTire& varied, const Base& base);

  const RingElements& even() const { return even_elements ? *even_elements : *elements; }
  const Ring& ring() const { return elements->ring(); }
};

/// Tread surface of a tire whose changed parameter changes its shape, with the numbering of the
/// base tire.
struct VariedTread {
  RingUnknowns unknowns;
  TreadSurface surface;

  // Not copied, because the surface refers to the unknowns.
  VariedTread(const VariedTread&) = delete;
  VariedTread(const Varied& varied, const Systems& all, Varied::Base& base, bool is_halved);
};

/// The two tires with a decreased and an increased parameter.
struct VariedPair {
  Varied below, above;
  std::vector<MovedNumber::Parts> parts;  // parts of each element that differ in either tire
  VariedPair(const Variation& variation, const Varied::Base& base);
};

}  // namespace latsch::fe_tire
