// SPDX-License-Identifier: Apache-2.0
// -dr/d(place, γ) of a step's residual r, (17) with the rows of (25) below, but for the turning of
// dampers with the wheel. With K the factorized tangent and E what that leaves out of the blocks,
// among the unknowns c that patches hang on,
//   (K + E) x = b:  x = K^-1 (b - w),  w = (1 + E S)^-1 E K^-1 b,  S: K^-1 among c
// which is Woodbury's formula.
#pragma once

#include <vector>

#include "models/ring_tire/belt/section_bending.h"
#include "models/ring_tire/tread/tread_contact.h"
#include "numerics/dense/lu.h"

namespace latsch::ring_tire {

/// Where what an entry of a patch stands for is among all unknowns, those of the belt first.
Eigen::Index patch_row(const PatchSlopes& patch,
                       int entry,
                       const SectionBending& section,
                       int nodes);

/// Keeps its memory from one tangent to the next.
class ExactTangent {
 public:
  /// `exact`: of the blocks; `approximate`: what the factor has of them; B, A: of the section's
  /// border; `scale`: of blocks and sections in r.
  void find(const CyclicBandFactor& factor,
            const SectionBending& section,
            const std::vector<PatchSlopes>& exact,
            const CyclicBand& approximate,
            const Eigen::MatrixXd& B,
            const Eigen::MatrixXd& A,
            double scale);
  /// x <- (K + E)^-1 x of a multiple of eight columns, by the factor and border it was found with.
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

  std::vector<int> nodes_;          // of the patches
  std::vector<Eigen::Index> rows_;  // c
  Eigen::MatrixXd E_, S_, whole_, y_c_, w_;
  numerics::Lu lu_;  // of 1 + E S
  SideBySide y_;
};

}  // namespace latsch::ring_tire
