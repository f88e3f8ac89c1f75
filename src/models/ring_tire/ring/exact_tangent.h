// SPDX-License-Identifier: Apache-2.0
// Exact tangent -dr/d(position, γ) of a step's residual r, which is (17) followed by the rows of
// (25); the rotation of dampers with the wheel is left out. K is the factorized tangent and E the
// part of the blocks' derivatives that K omits, among the unknowns c of the patches:
//   (K + E) x = b:  x = K^-1 (b - w),  w = (1 + E S)^-1 E K^-1 b,  S: K^-1 among c
// This is Woodbury's formula.
#pragma once

#include <vector>

#include "models/ring_tire/belt/section_bending.h"
#include "models/ring_tire/tread/tread_contact.h"
#include "numerics/dense/lu.h"

namespace latsch::ring_tire {

/// Returns the index of an entry of a patch among all unknowns, of which those of the belt come
/// first.
Eigen::Index patch_row(const PatchSlopes& patch,
                       int entry,
                       const SectionBending& section,
                       int nodes);

/// An exact tangent that keeps its memory from one tangent to the next.
class ExactTangent {
 public:
  /// Finds the tangent. `exact` are the derivatives of the blocks, `approximate` those contained in
  /// the factor; B and A belong to the section's border; `scale` is that of blocks and sections in
  /// r.
  void find(const CyclicBandFactor& factor,
            const SectionBending& section,
            const std::vector<PatchSlopes>& exact,
            const CyclicBand& approximate,
            const Eigen::MatrixXd& B,
            const Eigen::MatrixXd& A,
            double scale);
  /// Computes x <- (K + E)^-1 x for a multiple of eight columns, with the factor and border used in
  /// find().
  void solve(const CyclicBandFactor& factor,
             const SectionBending& section,
             Eigen::Ref<SideBySide> x);

 private:
  void find_left_out(const SectionBending& section,
                     const std::vector<PatchSlopes>& exact,
                     const CyclicBand& approximate,
                     const Eigen::MatrixXd& B,
                     const Eigen::MatrixXd& A,
                     double scale);

  std::vector<int> nodes_;          // nodes of the patches
  std::vector<Eigen::Index> rows_;  // c
  Eigen::MatrixXd E_, S_, whole_, y_c_, w_;
  numerics::Lu lu_;  // factors of 1 + E S
  SideBySide y_;
};

}  // namespace latsch::ring_tire
