// SPDX-License-Identifier: Apache-2.0
// Motions of the ring about a state, element by element: sums of (M.3) and (M.4) of hex8_motions.h
// over the assembled sectors.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/element/hex8_motions.h"
#include "models/fe_tire/ring/ring_elements.h"
#include "models/fe_tire/ring/ring_unknowns.h"
#include "models/fe_tire/slopes/moved_numbers.h"

namespace latsch::fe_tire {

class RingMotions {
 public:
  /// Keeps references to all arguments. `pressure` is in Pa. `modes` has at most
  /// ElementMotion::kMost entries; it is empty for slopes of loads.
  RingMotions(const RingUnknowns& unknowns,
              const RingElements& elements,
              const Eigen::VectorXd& x,
              const Eigen::VectorXd& alpha,
              double pressure,
              const std::vector<Mode>& modes);

  /// Computes D3W[phi, phi, .] of every mode [unknowns x modes]. Returns false if an element has no
  /// state.
  bool curvatures(Eigen::MatrixXd& g);

  /// Computes d/dp of D2W[phi~, phi~] - omega^2 phi.M phi + DW[along~] of every motion and number
  /// [motions x numbers] with motions held. `along` [unknowns x motions] has a column for each mode
  /// or, without modes, any number of columns. Call it after curvatures(). Returns false if an
  /// element has no state.
  bool slopes(const Eigen::MatrixXd& along,
              const std::vector<MovedNumber>& numbers,
              Eigen::MatrixXd& sums);

 private:
  void set_batch(int first, int count, int element, ElementBatch& batch) const;
  void set_modes(int first, int count, int element, std::vector<ElementMotion>& motions) const;
  /// Reads the element's stored values at `alphas` and returns the address of the next element's.
  const double* recall_alphas(const double* alphas, std::vector<ElementMotion>& motions) const;
  bool add_differences(int first,
                       int count,
                       int element,
                       const FeltNumbers& felt,
                       const std::vector<MovedNumber>& numbers,
                       std::vector<ElementMotion>& motions,
                       Eigen::MatrixXd& sums) const;
  void add_masses(int first,
                  int count,
                  int element,
                  const FeltNumbers& felt,
                  const std::vector<MovedNumber>& numbers,
                  const std::vector<ElementMotion>& motions,
                  Eigen::MatrixXd& sums) const;

  const RingUnknowns& unknowns_;
  const RingElements& elements_;
  const Ring& ring_;
  const Eigen::VectorXd &x_, &alpha_;
  double pressure_;
  const std::vector<Mode>& modes_;
  std::vector<double> alphas_;  // a_phi and a_2 of every group, element and mode
};

}  // namespace latsch::fe_tire
