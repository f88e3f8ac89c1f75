// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/ring_balance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace latsch::fe_tire {

RingBalance::RingBalance(const RingUnknowns& unknowns,
                         const TreadSurface& tread,
                         SolverCounts& counts)
    : assembly_(unknowns, &tread),
      tread_(tread),
      counts_(counts),
      f_(unknowns.size()),
      K_(*assembly_.pattern()) {}

bool RingBalance::begin(AssembledState& state, const RingLoad& load, bool needs_tangent) {
  const bool is_known = !needs_tangent && load_.elements == load.elements &&
                        load_.pressure == load.pressure && known_.x == state.x &&
                        known_.alpha == state.alpha;
  load_ = load;
  tangent_ = Tangent::none;
  inverted_ = -1;
  if (!is_known) return evaluate(state, needs_tangent);
  f_ = g_;
  add_contact(state);
  return true;
}

bool RingBalance::evaluate(AssembledState& state, bool with_tangent) {
  inverted_ = -1;
  if (with_tangent) {
    tangent_ = Tangent::current;
    ++counts_.assemblies;
  } else if (tangent_ == Tangent::current) {
    tangent_ = Tangent::earlier;
  }
  const bool valid =
      with_tangent
          ? assembly_.assemble_roughly(*load_.elements, state, load_.pressure, f_, K_, &inverted_)
          : assembly_.assemble(*load_.elements, state, load_.pressure, f_, nullptr, &inverted_);
  if (!valid) return false;
  g_ = f_;
  known_ = state;
  add_contact(state);
  return true;
}

bool RingBalance::ensure_tangent(AssembledState& state) {
  return tangent_ == Tangent::current || evaluate(state, true);
}

void RingBalance::add_contact(const AssembledState& state) {
  if (load_.contact) add_forces(tread_, load_.contact->touches(tread_.displacements(state.x)), f_);
}

int RingBalance::worst_element() const {
  if (inverted_ >= 0) return inverted_;
  int worst = -1;
  double largest = -1.0;
  const std::vector<std::vector<int>> dofs = assembly_.unknowns().connectivity();
  for (int e = 0; e < static_cast<int>(dofs.size()); ++e) {
    double here = 0.0;
    for (int dof : dofs[e]) {
      if (dof >= 0) here = std::max(here, std::abs(f_[dof]));
    }
    if (here > largest) {
      largest = here;
      worst = e;
    }
  }
  return worst;
}

std::string RingBalance::worst_in_words() const {
  return fmt::format("{} at {}",
                     inverted_ >= 0 ? "inverted" : "largest",
                     assembly_.unknowns().ring().place(worst_element()));
}

}  // namespace latsch::fe_tire
