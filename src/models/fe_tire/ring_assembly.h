// SPDX-License-Identifier: Apache-2.0
// Residual, tangent and mass of the whole ring; the sparsity and the scatter map are made once a
// mesh.
#pragma once

#include <Eigen/Core>

#include "models/fe_tire/contact.h"
#include "models/fe_tire/ring.h"
#include "numerics/symmetric_matrix.h"

namespace latsch::fe_tire {

/// Unknowns and enhanced parameters of the whole ring.
struct RingState {
  Eigen::VectorXd x;
  Eigen::VectorXd alpha;
};

class RingAssembly {
 public:
  explicit RingAssembly(const Ring& ring);

  const numerics::SymmetricPattern& pattern() const { return pattern_; }

  /// Forces f(x) = internal - pressure - ground, zero in equilibrium; K = df/dx (symmetric part)
  /// where given. Contact may be null. False where an element fails; `worst` then is sector *
  /// elements_per_sector + element.
  bool assemble(const Materials& materials,
                RingState& state,
                double pressure,
                const GroundContact* contact,
                bool stuck,
                Eigen::VectorXd& f,
                numerics::SymmetricMatrix* K,
                int* worst) const;

  /// Consistent mass matrix, kg.
  numerics::SymmetricMatrix mass(const Materials& materials) const;

 private:
  const Ring& ring_;
  numerics::SymmetricPattern pattern_;
};

}  // namespace latsch::fe_tire
