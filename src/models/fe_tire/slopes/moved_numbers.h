// SPDX-License-Identifier: Apache-2.0
// What moves with a number of the tire's description in the sums of (M.4) of hex8_motions.h,
// element by element: differences between the tire with the number on either side, of those parts
// of an element that feel it.
#pragma once

#include <functional>
#include <vector>

#include "models/fe_tire/element/hex8_motions.h"
#include "models/fe_tire/ring/ring_elements.h"

namespace latsch::fe_tire {

/// A tire with a number moved to one side, of which `way` is how far it is from the other side.
struct MovedNumber {
  const RingElements *below, *above;
  double pressure_below, pressure_above;  // Pa
  double way;                             // in the number's unit
  /// Parts of a section's elements in which it is felt.
  struct Parts {
    bool solid, gas, mass;
    unsigned cords;  // VariedElement::cords
    bool any() const { return solid || cords != 0 || gas; }
    void add(const Parts& other) {
      solid = solid || other.solid;
      gas = gas || other.gas;
      mass = mass || other.mass;
      cords |= other.cords;
    }
  };
  const std::vector<Parts>* parts;
};

/// The numbers that an element feels, each as two elements, below and above.
struct FeltNumbers {
  std::vector<VariedElement> elements;
  std::vector<std::size_t> numbers;
  std::vector<std::size_t> masses;  // numbers that its mass feels

  void find(int sector, int element, const std::vector<MovedNumber>& moved);
};

/// Of a motion and a number, in every lane.
using LaneSink = std::function<void(
    std::size_t motion, std::size_t number, const double (&lanes)[ElementBatch::kLanes])>;

/// dL/dp of (M.4), a unit of the number. False where the element has no state.
bool sum_differences(const ElementLaw& law,
                     unsigned open_edges,
                     const FeltNumbers& felt,
                     const std::vector<MovedNumber>& moved,
                     ElementBatch& batch,
                     std::vector<ElementMotion>& motions,
                     const LaneSink& sink);

/// phi dM/dp phi of the motions' modes, kg a unit of the number.
void sum_masses(int sector,
                int element,
                const FeltNumbers& felt,
                const std::vector<MovedNumber>& moved,
                const std::vector<ElementMotion>& motions,
                const LaneSink& sink);

}  // namespace latsch::fe_tire
