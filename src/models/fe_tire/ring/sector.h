// SPDX-License-Identifier: Apache-2.0
// One sector represents the ring as long as all sectors are equally wide and have the same state
// (inflated, not yet loaded).
//
// In sector frames the tangent of the ring is block-circulant. Every sector has the blocks
//   A = K_00 + K_11   (its own nodes, from the elements on both sides)
//   B = K_01          (toward the next sector)
// For displacements u_s = Re(u exp(i n s 2 pi / S)) of circumferential number n it therefore acts
// as the Hermitian matrix
//   K(n) = A + B exp(i phi) + B^T exp(-i phi),   phi = 2 pi n / S.
// n = 0 is the axisymmetric tangent needed for inflation; all n together give every mode of the
// unloaded tire.
#pragma once

#include <Eigen/Core>

#include "models/fe_tire/ring/ring_elements.h"
#include "numerics/sparse/banded_hermitian.h"

namespace latsch::fe_tire {

/// The blocks A (symmetric) and B of a block-circulant matrix, in banded storage: entry (i, j) is
/// stored at the row i - j + band of column j.
class SectorBlocks {
 public:
  explicit SectorBlocks(const Ring& ring);

  void set_zero();
  /// Adds a 24x24 element matrix in the frames of the nodes. `local_dofs` are Ring::local_dofs() of
  /// this element.
  void add(const std::array<int, 24>& local_dofs, const Matrix24& K);
  /// Returns A + B exp(i phi) + B^T exp(-i phi) for circumferential number n.
  numerics::BandedHermitian harmonic(int n) const;
  /// Returns i (A + B exp(i phi) - B^T exp(-i phi)) for skew-symmetric element matrices. The result
  /// is Hermitian.
  numerics::BandedHermitian harmonic_of_skew(int n) const;

  int size() const { return static_cast<int>(A_.cols()); }
  int band() const { return band_; }

 private:
  int sectors_;
  int band_;
  Eigen::MatrixXd A_, B_;  // banded storage [2 band + 1 x size]
};

/// Returns the largest distance between two coupled unknowns in the numbering of a sector; unknowns
/// of the next sector count as those of the same sector.
int sector_band(const Ring& ring);

/// Computes the internal forces per sector (pressure included) in the axisymmetric state x [sector
/// unknowns] and, if `tangent` is not null, the blocks of its tangent. Returns false if an element
/// is inverted; `worst` is then its index.
bool assemble_sector(const RingElements& elements,
                     const Eigen::VectorXd& x,
                     double pressure,
                     Eigen::VectorXd& alpha,
                     Eigen::VectorXd& f,
                     SectorBlocks* tangent,
                     int* worst);

/// Returns the consistent mass matrix of an element's 24 displacements in the frame of its sector,
/// kg.
Matrix24 element_mass(const Ring& ring, const Materials& materials, int sector, int element);

/// Returns the blocks of the consistent mass matrix of the ring.
SectorBlocks sector_mass(const RingElements& elements);

}  // namespace latsch::fe_tire
