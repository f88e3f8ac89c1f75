// SPDX-License-Identifier: Apache-2.0
// Assembly of residual, tangent and mass of the ring or its half. The sparsity pattern and the
// scatter map are made once per mesh.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "models/fe_tire/contact/tread_surface.h"
#include "models/fe_tire/ring/ring_elements.h"
#include "models/fe_tire/ring/ring_unknowns.h"
#include "numerics/sparse/symmetric_matrix.h"

namespace latsch::fe_tire {

/// Unknowns and enhanced parameters of the assembled sectors.
struct AssembledState {
  Eigen::VectorXd x;
  Eigen::VectorXd alpha;
};

class RingAssembly {
 public:
  /// The pattern includes entries for the ground under the points of `tread`, if given.
  explicit RingAssembly(const RingUnknowns& unknowns, const TreadSurface* tread = nullptr);
  /// Uses the pattern of another assembly of the same ring, so that even and odd states share it.
  RingAssembly(const RingUnknowns& unknowns,
               std::shared_ptr<const numerics::SymmetricPattern> pattern);

  const RingUnknowns& unknowns() const { return unknowns_; }
  const std::shared_ptr<const numerics::SymmetricPattern>& pattern() const { return pattern_; }
  /// Index of the tread's first cell among the elements of the pattern.
  int first_cell() const { return ring_.elements_per_sector() * unknowns_.sectors(); }
  /// Returns a state of zeros, of the size that assemble() needs.
  AssembledState zero_state() const;

  /// Computes the forces f(x) = internal - pressure, zero in equilibrium off the ground, and K =
  /// df/dx (its symmetric part) if K is not null. Returns false if an element fails; `worst` then
  /// is sector * elements_per_sector + element.
  bool assemble(const RingElements& elements,
                AssembledState& state,
                double pressure,
                Eigen::VectorXd& f,
                numerics::SymmetricMatrix* K,
                int* worst) const;
  /// Works as assemble(), with the elements' stiffness in single precision: the forces are exact, K
  /// is accurate enough for a step of Newton's method.
  bool assemble_roughly(const RingElements& elements,
                        AssembledState& state,
                        double pressure,
                        Eigen::VectorXd& f,
                        numerics::SymmetricMatrix& K,
                        int* worst) const;

  /// Computes the tangent at `state` in the numbering `vibration` of the motions about it (even or
  /// odd). Returns false as assemble() does.
  bool assemble_tangent(const RingElements& elements,
                        AssembledState& state,
                        double pressure,
                        const RingUnknowns& vibration,
                        numerics::SymmetricMatrix& K,
                        int* worst) const;
  /// A tangent and the numbering in which it is assembled.
  struct Vibration {
    const RingUnknowns* unknowns;
    numerics::SymmetricMatrix* K;
  };
  /// Works as assemble_tangent() for several numberings at once; the elements' tangents are
  /// computed only once.
  bool assemble_tangents(const RingElements& elements,
                         AssembledState& state,
                         double pressure,
                         const std::vector<Vibration>& vibrations,
                         int* worst) const;

  /// Consistent mass matrix, kg.
  numerics::SymmetricMatrix mass(const RingElements& elements) const;

 private:
  bool sum_elements(const RingElements& elements,
                    AssembledState& state,
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
