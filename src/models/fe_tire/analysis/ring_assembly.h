// SPDX-License-Identifier: Apache-2.0
// Residual, tangent and mass of the ring (or its half); the sparsity and the scatter map are made
// once a mesh.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "models/fe_tire/contact/tread_surface.h"
#include "models/fe_tire/ring/ring_elements.h"
#include "models/fe_tire/ring/ring_unknowns.h"
#include "numerics/sparse/symmetric_matrix.h"

namespace latsch::fe_tire {

/// Unknowns and enhanced parameters of the sectors assembled.
struct RingState {
  Eigen::VectorXd x;
  Eigen::VectorXd alpha;
};

class RingAssembly {
 public:
  /// The pattern has places for the ground under the points of `tread`, where there is one.
  explicit RingAssembly(const RingUnknowns& unknowns, const TreadSurface* tread = nullptr);
  /// On the pattern of another assembly of the same ring: even and odd states share it.
  RingAssembly(const RingUnknowns& unknowns,
               std::shared_ptr<const numerics::SymmetricPattern> pattern);

  const RingUnknowns& unknowns() const { return unknowns_; }
  const std::shared_ptr<const numerics::SymmetricPattern>& pattern() const { return pattern_; }
  /// Where the cells of the tread begin among the elements of the pattern.
  int first_cell() const { return ring_.elements_per_sector() * unknowns_.sectors(); }
  /// All zero, of the size that assemble() needs.
  RingState zero_state() const;

  /// Forces f(x) = internal - pressure, zero in equilibrium off the ground; K = df/dx (symmetric
  /// part) where given. False where an element fails; `worst` then is sector * elements_per_sector
  /// + element.
  bool assemble(const RingElements& elements,
                RingState& state,
                double pressure,
                Eigen::VectorXd& f,
                numerics::SymmetricMatrix* K,
                int* worst) const;
  /// The same with elements' stiffness in single precision: forces are exact, K is what a step of
  /// Newton's method needs.
  bool assemble_roughly(const RingElements& elements,
                        RingState& state,
                        double pressure,
                        Eigen::VectorXd& f,
                        numerics::SymmetricMatrix& K,
                        int* worst) const;

  /// Tangent at `state` in the numbering `vibration` of the motions about it (even or odd ones).
  /// False as for assemble().
  bool assemble_tangent(const RingElements& elements,
                        RingState& state,
                        double pressure,
                        const RingUnknowns& vibration,
                        numerics::SymmetricMatrix& K,
                        int* worst) const;
  /// A tangent and the numbering it is wanted in.
  struct Vibration {
    const RingUnknowns* unknowns;
    numerics::SymmetricMatrix* K;
  };
  /// The same of several numberings; the elements' tangents are the same.
  bool assemble_tangents(const RingElements& elements,
                         RingState& state,
                         double pressure,
                         const std::vector<Vibration>& vibrations,
                         int* worst) const;

  /// Consistent mass matrix, kg.
  numerics::SymmetricMatrix mass(const RingElements& elements) const;

 private:
  bool sum_elements(const RingElements& elements,
                    RingState& state,
                    double pressure,
                    Eigen::VectorXd* f,
                    Stiffness stiffness,
                    const std::vector<Vibration>& tangents,
                    int* worst) const;

  const RingUnknowns& unknowns_;
  const Ring& ring_;
  std::shared_ptr<const numerics::SymmetricPattern> pattern_;
};

}  // namespace latsch::fe_tire
