// SPDX-License-Identifier: Apache-2.0
// The elements of the ring with their materials. Element laws are computed once for each set of
// materials and are evaluated for several equally wide sectors at a time.
#pragma once

#include <functional>
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
  /// Copies the elements of a ring, with laws that `change` changes. Materials are those of the
  /// other elements.
  RingElements(const RingElements& of,
               const std::function<void(const Element& element, ElementLaw& law)>& change);

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

  /// Adds dead stresses, all 0 at first, to those of the laws. They belong to the batches that
  /// groups() makes of the whole ring.
  void add_dead_stresses();
  /// Returns the dead stresses of the section's element in the sectors of the group that begins
  /// with `first`.
  PointStresses& dead(int first, int element) { return dead_[first][element]; }

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
  // Dead stresses [sector][section element] of the first sectors of groups; empty: none.
  std::vector<std::vector<PointStresses>> dead_;
};

}  // namespace latsch::fe_tire
