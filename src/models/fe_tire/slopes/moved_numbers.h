// SPDX-License-Identifier: Apache-2.0
// Changes of the elements by a parameter of the tire's description, for the sums (M.4) of
// hex8_motions.h. They are differences between two tires whose parameter is decreased and
// increased, evaluated only for the affected parts of each element.
#pragma once

#include <functional>
#include <vector>

#include "models/fe_tire/element/hex8_motions.h"
#include "models/fe_tire/ring/ring_elements.h"

namespace latsch::fe_tire {

/// Two tires whose parameter is decreased and increased; `way` is the difference of the two values.
struct MovedNumber {
  const RingElements *below, *above;
  double pressure_below, pressure_above;  // Pa
  double way;                             // in the unit of the parameter
  /// Parts of an element of the section that the parameter changes.
  struct Parts {
    bool solid, gas, mass;
    unsigned cords;  // mask of cord layers, see VariedElement::cords
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

/// The parameters that change an element. For each, there are two elements: with the decreased and
/// with the increased value.
struct FeltNumbers {
  std::vector<VariedElement> elements;
  std::vector<std::size_t> numbers;
  std::vector<std::size_t> masses;  // indices of the parameters that change the element's mass

  void find(int sector, int element, const std::vector<MovedNumber>& moved);
};

/// Function that receives the value for a motion and a parameter in every lane.
using LaneSink = std::function<void(
    std::size_t motion, std::size_t number, const double (&lanes)[ElementBatch::kLanes])>;

/// Computes the derivative dL/dp of (M.4) per unit of each parameter. Returns false if an element
/// is inverted.
bool sum_differences(const ElementLaw& law,
                     unsigned open_edges,
                     const FeltNumbers& felt,
                     const std::vector<MovedNumber>& moved,
                     ElementBatch& batch,
                     std::vector<ElementMotion>& motions,
                     const LaneSink& sink);

/// Computes phi^T dM/dp phi for the modes of the motions, kg per unit of the parameter.
void sum_masses(int sector,
                int element,
                const FeltNumbers& felt,
                const std::vector<MovedNumber>& moved,
                const std::vector<ElementMotion>& motions,
                const LaneSink& sink);

}  // namespace latsch::fe_tire
