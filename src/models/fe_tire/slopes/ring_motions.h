// SPDX-License-Identifier: Apache-2.0
// Sums of (M.3) and (M.4) of hex8_motions.h over the elements of the assembled sectors, for motions
// of the ring about a state.
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
  /// The object keeps references to all arguments. `pressure` is in Pa. `modes` has at most
  /// ElementMotion::kMost columns; it has none for derivatives of loads.
  RingMotions(const RingUnknowns& unknowns,
              const RingElements& elements,
              const Eigen::VectorXd& x,
              const Eigen::VectorXd& alpha,
              double pressure,
              const std::vector<Mode>& modes);

  /// Computes the third derivative D3W[phi, phi, .] of the energy W for every mode phi [unknowns x
  /// modes]. Returns false if an element is inverted.
  bool curvatures(Eigen::MatrixXd& g);

  /// Computes the derivative of D2W[phi~, phi~] - omega^2 phi^T M phi + DW[along~] with respect to
  /// every parameter, for every motion, with constant motions [motions x parameters]. `along`
  /// [unknowns x motions] has one column per mode or, without modes, any number of columns.
  /// curvatures() must have been called before. Returns false if an element is inverted.
  bool slopes(const Eigen::MatrixXd& along,
              const std::vector<MovedNumber>& numbers,
              Eigen::MatrixXd& sums);

 private:
  void set_batch(int first, int count, int element, ElementBatch& batch) const;
  void set_modes(int first, int count, int element, std::vector<ElementMotion>& motions) const;
  /// Reads the stored enhanced strains of an element at `alphas` and returns the address of those
  /// of the next element.
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
  // Enhanced strains a_phi and a_2 of every group of sectors, element and mode.
  std::vector<double> alphas_;
};

}  // namespace latsch::fe_tire
