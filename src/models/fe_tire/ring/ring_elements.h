// SPDX-License-Identifier: Apache-2.0
// The elements of the ring with their materials. Element laws are computed once for each set of
// materials and are evaluated for several equally wide sectors at a time.
#pragma once

#include <span>
#include <vector>

#include "models/fe_tire/element/hex8_batch.h"
#include "models/fe_tire/ring/ring.h"

namespace latsch::fe_tire {

class RingElements {
 public:
  /// Computes the laws of all elements. The ring must outlive this object. Throws InputError if an
  /// element has too many cord layers.
  RingElements(const Ring& ring, Materials materials);

  const Ring& ring() const { return ring_; }
  const Materials& materials() const { return materials_; }

  /// Return the law and the surroundings (without pressure) of the section's element number
  /// `element`, in all sectors as wide as `sector`.
  const ElementLaw& law(int sector, int element) const {
    return laws_[ring_.width(sector)][element];
  }
  const ElementSurroundings& surroundings(int sector, int element) const {
    return surroundings_[ring_.width(sector)][element];
  }

  /// A group of successive sectors of equal width, at most ElementBatch::kLanes of them.
  struct Sectors {
    int first, count;
  };
  /// Returns the sectors 0 ... count-1, divided into groups of successive, equally wide sectors.
  std::vector<Sectors> groups(int count) const;

  /// Computes the forces and, if requested, the stiffness of the section's element number `element`
  /// in sectors as wide as `sector`, in the frames of their nodes. The pressure (Pa) acts on inner
  /// faces. The batch holds the displacements. Returns a bit for each lane that succeeded, like
  /// evaluate() of a batch.
  unsigned evaluate(
      int sector, int element, double pressure, Stiffness stiffness, ElementBatch& batch) const;

 private:
  const Ring& ring_;
  Materials materials_;
  std::vector<std::vector<ElementLaw>> laws_;  // laws of the section's elements, for every width
  // Surroundings of the section's elements, without pressure, for every width.
  std::vector<std::vector<ElementSurroundings>> surroundings_;
};

}  // namespace latsch::fe_tire
