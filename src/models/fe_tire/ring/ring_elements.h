// SPDX-License-Identifier: Apache-2.0
// The ring's elements with their materials. Element laws are built once for each set of materials
// and evaluated in several equally wide sectors at a time.
#pragma once

#include <span>
#include <vector>

#include "models/fe_tire/element/hex8_batch.h"
#include "models/fe_tire/ring/ring.h"

namespace latsch::fe_tire {

class RingElements {
 public:
  /// The ring must outlive this object. Throws InputError if an element has too many cord layers.
  RingElements(const Ring& ring, Materials materials);

  const Ring& ring() const { return ring_; }
  const Materials& materials() const { return materials_; }

  /// Law and surroundings of the elements `element` in sectors as wide as `sector`; the
  /// surroundings have no pressure.
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
  /// Returns the sectors 0 ... count-1 in such groups.
  std::vector<Sectors> groups(int count) const;

  /// Computes forces and, if asked for, stiffness of the elements `element` in sectors as wide as
  /// `sector`, in the frames of their nodes. The pressure (Pa) acts on inner faces. The batch holds
  /// the displacements. Returns a bit for each lane that succeeded, see evaluate() of a batch.
  unsigned evaluate(
      int sector, int element, double pressure, Stiffness stiffness, ElementBatch& batch) const;

 private:
  const Ring& ring_;
  Materials materials_;
  std::vector<std::vector<ElementLaw>> laws_;                   // for every width
  std::vector<std::vector<ElementSurroundings>> surroundings_;  // for every width, without pressure
};

}  // namespace latsch::fe_tire
