// SPDX-License-Identifier: Apache-2.0
// -dr/d(place, γ) of a step's residual r, (17) with the rows of (25) below, solved to rounding. With
// K the factorized tangent, E what that leaves out of the blocks (among the unknowns c that patches
// hang on) and D the turning of dampers with the wheel (everywhere, small),
//   (K + E) x = b:  x = K^-1 (b - w), w = (1 + E S)^-1 E K^-1 b, S = K^-1 among c     [Woodbury]
// and D by iteration.
#pragma once

#include <memory>

#include "models/ring_tire/belt/section_bending.h"
#include "models/ring_tire/tread/tread_contact.h"
#include "numerics/dense/lu.h"

namespace latsch::ring_tire {

class ExactTangent {
 public:
  using Columns = CyclicBandFactor::Columns;

  /// `exact`: of the blocks; `approximate`: what K has of them; `scale`: of both in r. K, the
  /// factor and the section's border, are asked as long as this lives.
  ExactTangent(const CyclicBandFactor& factor,
               const SectionBending& section,
               const std::vector<PatchSlopes>& exact,
               const CyclicBand& approximate,
               const Eigen::MatrixXd& B,
               const Eigen::MatrixXd& A,
               double scale);
  /// x <- (K + E)^-1 x; a multiple of eight columns.
  void solve(Columns& x) const;

 private:
  void solve_approximately(Columns& x) const;

  const CyclicBandFactor& factor_;
  const SectionBending& section_;
  std::vector<Eigen::Index> rows_;  // c
  Eigen::MatrixXd E_;
  std::unique_ptr<numerics::Lu> lu_;  // of 1 + E S
};

}  // namespace latsch::ring_tire
