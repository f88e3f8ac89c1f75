// SPDX-License-Identifier: Apache-2.0
// Changes of elements with a number of the tire's description, for the sums (M.4) of
// hex8_motions.h: differences between the tires with the number moved to either side, over the
// affected parts of each element only.
#pragma once

#include <functional>
#include <vector>

#include "models/fe_tire/element/hex8_motions.h"
#include "models/fe_tire/ring/ring_elements.h"

namespace latsch::fe_tire {

/// Two tires with a number moved to either side; `way` is the distance between the two values.
struct MovedNumber {
  const RingElements *below, *above;
  double pressure_below, pressure_above;  // Pa
  double way;                             // in the number's unit
  /// The parts of a section's element that the number changes.
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

/// The numbers that change an element, each as two elements, below and above.
struct FeltNumbers {
  std::vector<VariedElement> elements;
  std::vector<std::size_t> numbers;
  std::vector<std::size_t> masses;  // numbers that change the element's mass

  void find(int sector, int element, const std::vector<MovedNumber>& moved);
};

/// Receives the value of a motion and a number in every lane.
using LaneSink = std::function<void(
    std::size_t motion, std::size_t number, const double (&lanes)[ElementBatch::kLanes])>;

/// Computes dL/dp of (M.4) per unit of the number. Returns false if the element has no state.
bool sum_differences(const ElementLaw& law,
                     unsigned open_edges,
                     const FeltNumbers& felt,
                     const std::vector<MovedNumber>& moved,
                     ElementBatch& batch,
                     std::vector<ElementMotion>& motions,
                     const LaneSink& sink);

/// Computes phi dM/dp phi of the motions' modes, kg per unit of the number.
void sum_masses(int sector,
                int element,
                const FeltNumbers& felt,
                const std::vector<MovedNumber>& moved,
                const std::vector<ElementMotion>& motions,
                const LaneSink& sink);

}  // namespace latsch::fe_tire
