// SPDX-License-Identifier: Apache-2.0
// The balance of forces of the ring: the residual f = g + c at a state, where g are the forces of
// elements and pressure and c those of the ground, and the tangent K = dg/dx.
#pragma once

#include <Eigen/Core>
#include <string>

#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/analysis/solver_settings.h"
#include "models/fe_tire/contact/contact.h"
#include "numerics/sparse/symmetric_matrix.h"

namespace latsch::fe_tire {

/// Everything that loads the ring. The pointers must outlive the search for the equilibrium.
struct RingLoad {
  const RingElements* elements = nullptr;
  double pressure = 0.0;                  // Pa
  const TreadContact* contact = nullptr;  // null: off the ground
};

class RingBalance {
 public:
  /// The state to which the tangent belongs.
  enum class Tangent {
    none,     // none of this search
    earlier,  // an earlier state of this search
    current   // the state of the forces
  };

  /// `tread` and `counts`, to which the work is added, must outlive this object.
  RingBalance(const RingUnknowns& unknowns, const TreadSurface& tread, SolverCounts& counts);

  /// Starts a search at `state`. If forces alone are needed and those of elements and pressure are
  /// known from the last evaluation, they are not computed again. Returns false if an element is
  /// inverted.
  bool begin(AssembledState& state, const RingLoad& load, bool needs_tangent);
  /// Computes the forces at a state, and the tangent if requested. Returns false if an element is
  /// inverted.
  bool evaluate(AssembledState& state, bool with_tangent);
  /// Computes the tangent unless it belongs to `state`, that of the forces, already.
  bool ensure_tangent(AssembledState& state);

  /// Declares the forces known to be those at `state`.
  void recall_at(const AssembledState& state) { known_ = state; }
  /// Called if the elements changed: the forces of the last state are then invalid.
  void forget() { load_.elements = nullptr; }

  const RingLoad& load() const { return load_; }
  const Eigen::VectorXd& residual() const { return f_; }
  const Eigen::VectorXd& forces_off_ground() const { return g_; }
  numerics::SymmetricMatrix& K() { return K_; }
  Tangent tangent() const { return tangent_; }
  const RingAssembly& assembly() const { return assembly_; }

  /// Describes the largest residual, or the element that is inverted, with its place on the mesh.
  std::string worst_in_words() const;

 private:
  void add_contact(const AssembledState& state);
  int worst_element() const;

  RingAssembly assembly_;
  const TreadSurface& tread_;
  SolverCounts& counts_;
  RingLoad load_;
  Eigen::VectorXd f_, g_;
  AssembledState known_;  // state of g_
  numerics::SymmetricMatrix K_;
  Tangent tangent_ = Tangent::none;
  int inverted_ = -1;  // element that was inverted at the last evaluation; -1: none
};

}  // namespace latsch::fe_tire
