// SPDX-License-Identifier: Apache-2.0
// Balance of forces on the tire's ring of sectors: the residual f = g + c at a state, with the
// forces g of elements and pressure and c of the ground, and the tangent K = dg/dx.
#pragma once

#include <Eigen/Core>
#include <string>

#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/analysis/solver_settings.h"
#include "models/fe_tire/contact/contact.h"
#include "numerics/sparse/symmetric_matrix.h"

namespace latsch::fe_tire {

/// All loads on the ring. The pointers must stay valid during the search for the equilibrium.
struct RingLoad {
  const RingElements* elements = nullptr;
  double pressure = 0.0;                  // Pa
  const TreadContact* contact = nullptr;  // null: the tire is off the ground
};

class RingBalance {
 public:
  /// State to which the stored tangent belongs.
  enum class Tangent {
    none,     // no tangent in this search yet
    earlier,  // an earlier state of this search
    current   // the state at which the forces were computed
  };

  /// The object adds its work to `counts`. `tread` and `counts` must outlive this object.
  RingBalance(const RingUnknowns& unknowns, const TreadSurface& tread, SolverCounts& counts);

  /// Starts a search at `state` and computes its forces. If no tangent is needed and the forces of
  /// elements and pressure are known from the last evaluation, these are not computed again.
  /// Returns false if an element is inverted.
  bool begin(AssembledState& state, const RingLoad& load, bool needs_tangent);
  /// Computes the forces at a state, and the tangent if requested. Returns false if an element is
  /// inverted.
  bool evaluate(AssembledState& state, bool with_tangent);
  /// Computes the tangent at `state`, unless it is known already. The forces must have been
  /// computed at this state.
  bool ensure_tangent(AssembledState& state);

  /// Declares that the stored forces belong to `state`.
  void recall_at(const AssembledState& state) { known_ = state; }
  /// Must be called if the elements changed, because the forces of the last state are then invalid.
  void forget() { load_.elements = nullptr; }

  const RingLoad& load() const { return load_; }
  const Eigen::VectorXd& residual() const { return f_; }
  const Eigen::VectorXd& forces_off_ground() const { return g_; }
  numerics::SymmetricMatrix& K() { return K_; }
  Tangent tangent() const { return tangent_; }
  const RingAssembly& assembly() const { return assembly_; }

  /// Describes the largest component of the residual, or the inverted element, with its position on
  /// the mesh.
  std::string worst_in_words() const;

 private:
  void add_contact(const AssembledState& state);
  int worst_element() const;

  RingAssembly assembly_;
  const TreadSurface& tread_;
  SolverCounts& counts_;
  RingLoad load_;
  Eigen::VectorXd f_, g_;
  AssembledState known_;  // state to which g_ belongs
  numerics::SymmetricMatrix K_;
  Tangent tangent_ = Tangent::none;
  int inverted_ = -1;  // element that was inverted at the last evaluation; -1: no element
};

}  // namespace latsch::fe_tire
