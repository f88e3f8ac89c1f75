// SPDX-License-Identifier: Apache-2.0
// Assembles residual, tangent and mass of the whole ring of sectors or of half of it. The sparsity
// pattern and the map from element entries to matrix entries are computed once per mesh.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "models/fe_tire/contact/tread_surface.h"
#include "models/fe_tire/ring/ring_elements.h"
#include "models/fe_tire/ring/ring_unknowns.h"
#include "numerics/sparse/symmetric_matrix.h"

namespace latsch::fe_tire {

/// Unknowns and enhanced strain parameters of the assembled sectors.
struct AssembledState {
  Eigen::VectorXd x;
  Eigen::VectorXd alpha;
};

class RingAssembly {
 public:
  /// If `tread` is given, the pattern includes entries for ground under its points.
  explicit RingAssembly(const RingUnknowns& unknowns, const TreadSurface* tread = nullptr);
  /// Uses the pattern of another assembly of the same ring, so that even and odd motions share it.
  RingAssembly(const RingUnknowns& unknowns,
               std::shared_ptr<const numerics::SymmetricPattern> pattern);

  const RingUnknowns& unknowns() const { return unknowns_; }
  const std::shared_ptr<const numerics::SymmetricPattern>& pattern() const { return pattern_; }
  /// Index of the tread's first cell among the elements of the sparsity pattern.
  int first_cell() const { return ring_.elements_per_sector() * unknowns_.sectors(); }
  /// Returns a state of zeros with the sizes that assemble() needs.
  AssembledState zero_state() const;

  /// Computes the forces f(x) = internal - pressure, which are zero in equilibrium off the ground,
  /// and, if K is not null, the symmetric part of K = df/dx. Returns false if an element is
  /// inverted; `worst` is then sector * elements_per_sector + element.
  bool assemble(const RingElements& elements,
                AssembledState& state,
                double pressure,
                Eigen::VectorXd& f,
                numerics::SymmetricMatrix* K,
                int* worst) const;
  /// Like assemble(), but the stiffness of the elements has single precision. The forces are exact,
  /// and K is accurate enough for a step of Newton's method.
  bool assemble_roughly(const RingElements& elements,
                        AssembledState& state,
                        double pressure,
                        Eigen::VectorXd& f,
                        numerics::SymmetricMatrix& K,
                        int* worst) const;

  /// Computes the tangent at `state` for the motions about it (even or odd) that the numbering
  /// `vibration` describes. Returns false like assemble().
  bool assemble_tangent(const RingElements& elements,
                        AssembledState& state,
                        double pressure,
                        const RingUnknowns& vibration,
                        numerics::SymmetricMatrix& K,
                        int* worst) const;
  /// A numbering of unknowns, and the tangent that is assembled in it.
  struct Vibration {
    const RingUnknowns* unknowns;
    numerics::SymmetricMatrix* K;
  };
  /// Like assemble_tangent() for several numberings at once. The tangents of the elements are
  /// computed only once.
  bool assemble_tangents(const RingElements& elements,
                         AssembledState& state,
                         double pressure,
                         const std::vector<Vibration>& vibrations,
                         int* worst) const;

  /// Returns the consistent mass matrix, kg.
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
