// SPDX-License-Identifier: Apache-2.0
// The ring's elements with their materials in them: laws are made once, whenever materials change,
// and evaluated in as many sectors at a time as are equally wide.
#pragma once

#include <span>
#include <vector>

#include "models/fe_tire/element/hex8_batch.h"
#include "models/fe_tire/ring/ring.h"

namespace latsch::fe_tire {

class RingElements {
 public:
  /// The ring must outlive them. Throws InputError for elements of too many cord layers.
  RingElements(const Ring& ring, Materials materials);

  const Ring& ring() const { return ring_; }
  const Materials& materials() const { return materials_; }

  /// Of the elements `element` of sectors as wide as `sector`; surroundings without pressure.
  const ElementLaw& law(int sector, int element) const {
    return laws_[ring_.width(sector)][element];
  }
  const ElementSurroundings& surroundings(int sector, int element) const {
    return surroundings_[ring_.width(sector)][element];
  }

  /// Successive sectors of one width, at most ElementBatch::kLanes of them.
  struct Sectors {
    int first, count;
  };
  /// The sectors 0 ... count-1 in such groups.
  std::vector<Sectors> groups(int count) const;

  /// Forces and, where asked for, stiffness of the elements `element` of sectors as wide as
  /// `sector`, in the frames of their nodes; pressure (Pa) acts on inner faces. Displacements stand
  /// in the batch. Bits of the lanes that succeeded, see evaluate() of a batch.
  unsigned evaluate(
      int sector, int element, double pressure, Stiffness stiffness, ElementBatch& batch) const;

 private:
  const Ring& ring_;
  Materials materials_;
  std::vector<std::vector<ElementLaw>> laws_;                   // of every width
  std::vector<std::vector<ElementSurroundings>> surroundings_;  // likewise, without pressure
};

}  // namespace latsch::fe_tire
