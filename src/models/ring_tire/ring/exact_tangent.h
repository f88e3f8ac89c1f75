// SPDX-License-Identifier: Apache-2.0
// Exact tangent -dr/d(position, γ) of a time step's residual r, which consists of (17) and the rows
// of (25). Only the rotation of dampers with the wheel is omitted. K is the factorized approximate
// tangent, c are the unknowns of the contact patches, and E is the part of the tread blocks'
// derivatives, among c, that K does not contain:
//   (K + E) x = b:  x = K^-1 (b - w),  w = (1 + E S)^-1 E K^-1 b,  S: K^-1 among c
// This is Woodbury's formula.
#pragma once

#include <vector>

#include "models/ring_tire/belt/section_bending.h"
#include "models/ring_tire/tread/tread_contact.h"
#include "numerics/dense/lu.h"

namespace latsch::ring_tire {

/// Returns the index, among all unknowns, of an entry of a contact patch. The unknowns of the belt
/// come first.
Eigen::Index patch_row(const PatchSlopes& patch,
                       int entry,
                       const SectionBending& section,
                       int nodes);

/// The exact tangent. Its memory is reused from one step to the next.
class ExactTangent {
 public:
  /// Computes the tangent. `exact` are the derivatives of the tread blocks' forces, `approximate`
  /// those contained in the factorization. B and A belong to the border that bending sections add.
  /// `scale` is the factor of blocks and sections in the residual r.
  void find(const CyclicBandFactor& factor,
            const SectionBending& section,
            const std::vector<PatchSlopes>& exact,
            const CyclicBand& approximate,
            const Eigen::MatrixXd& B,
            const Eigen::MatrixXd& A,
            double scale);
  /// Computes x <- (K + E)^-1 x for a multiple of eight columns, with the factorization and the
  /// border that were used in find().
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

  std::vector<int> nodes_;          // nodes of the contact patches
  std::vector<Eigen::Index> rows_;  // c
  Eigen::MatrixXd E_, S_, whole_, y_c_, w_;
  numerics::Lu lu_;  // factorization of 1 + E S
  SideBySide y_;
};

}  // namespace latsch::ring_tire
