// SPDX-License-Identifier: Apache-2.0
// Power that the rubber and the cords of a rolling tire lose, by the history of their stresses
// along the streamlines of a known state.
//
// Along each streamline of the section the strains E and the relaxed stresses S of the state give
// the history H by (H.2) of streamlines.h, and
//   P = integral of sum_i H_i : E' dV                                                         (E.1)
// with the exact mean of H over every step. A streamline has one point a sector: the mean of the
// two Gauss points that the section's point has in a sector. Between them assumed strains are
// constant or vary as in one element; their steps at the borders of sectors would be losses of
// waves as short as a sector, of first order in its width. Between the sectors E and S follow a
// spline (sector_spline.h).
//   Strains count from those of a round state on the same mesh (the inflated tire): where sectors
// of different width meet, a round tire's strains step by the second order of the width. A tire
// that stays round therefore loses nothing.
//   In a state with these histories in its equilibrium (rolling_history.h) P is the power that
// drive and hub give, to the error of the discretization; in a state of elastic rubber it is of
// first order in the loss factor.
#pragma once

#include <string>
#include <vector>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/history/loss_materials.h"
#include "models/fe_tire/history/point_strains.h"
#include "models/fe_tire/history/streamlines.h"
#include "models/fe_tire/ring/ring_elements.h"

namespace latsch::fe_tire {

/// Powers that are lost, W, at least 0 but for a nonlinear law.
struct RollingLosses {
  std::vector<double> parts;  // W, one for each owner of the loss materials
  double rubber = 0.0;        // sum of the rubbers' parts
  double cords = 0.0;         // sum of the layers' parts
};

class LossMeter {
 public:
  /// Keeps a reference to the tire, and to its materials as they are now. `round`: the inflated
  /// tire, from which strains count.
  LossMeter(const FeTire& tire, LossMaterials losses, const Inflated& round);
  ~LossMeter();

  const RingElements& elements() const { return elements_; }
  const LossMaterials& materials() const { return losses_; }
  /// The streamline of all places: the middles of the sectors, in the order of the sectors.
  const Streamline& line() const { return line_; }
  /// Returns the strains of a section element in the round state, in a sector.
  const PointStrains& round(int sector, int element) const {
    return round_[elements_.ring().width(sector)][element];
  }
  /// Returns the strains of a section element in all sectors.
  std::vector<PointStrains> strains_of(int element,
                                       const Eigen::Matrix3Xd& u,
                                       const Eigen::VectorXd& alpha) const;
  /// Returns the powers lost by the tire in a state with displacements u [3 x nodes, sector frames]
  /// and enhanced strains alpha of all sectors, whose material passes with Omega, rad/s.
  RollingLosses measure(const Eigen::Matrix3Xd& u,
                        const Eigen::VectorXd& alpha,
                        double Omega) const;

 private:
  struct Line;
  void add_solid(int element,
                 const std::vector<PointStrains>& strains,
                 double Omega,
                 RollingLosses& sum) const;
  void add_cords(int element,
                 const std::vector<PointStrains>& strains,
                 double Omega,
                 RollingLosses& sum) const;

  const RingElements& elements_;
  LossMaterials losses_;
  Streamline line_, places_;
  Eigen::MatrixXd spline_;                        // values at places_ by those at line_
  std::vector<std::vector<PointStrains>> round_;  // strains [width][section element]
};

}  // namespace latsch::fe_tire
