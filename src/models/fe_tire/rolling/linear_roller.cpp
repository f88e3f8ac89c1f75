// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/linear_roller.h"

#include <utility>

#include "numerics/sparse/elimination.h"

namespace latsch::fe_tire {

LinearRoller::LinearRoller(const RingAssembly& assembly,
                           const TreadSurface& tread,
                           const TreadLines& lines)
    : tread_(tread),
      factor_(*assembly.pattern(),
              numerics::Precision::single,
              std::make_shared<const numerics::Elimination>(
                  numerics::eliminate(*assembly.pattern(), tread.block_rows()))),
      nodes_(tread, lines) {}

bool LinearRoller::factorize(const numerics::SymmetricMatrix& K) {
  forget();
  has_factor_ = factor_.condense(K).definite();
  if (has_factor_) nodes_.set(factor_.condensed());
  return has_factor_;
}

void LinearRoller::forget() {
  has_factor_ = false;
  nodes_.forget();
}

Eigen::VectorXd LinearRoller::at_nodes(const Eigen::VectorXd& v) const {
  Eigen::VectorXd at(3 * tread_.nodes());
  for (int a = 0; a < tread_.nodes(); ++a)
    at.segment<3>(3 * a) = v.segment<3>(3 * tread_.block_rows()[a]);
  return at;
}

/// Returns a vector at all `size` unknowns from one at the tread's nodes.
Eigen::VectorXd LinearRoller::at_unknowns(const Eigen::VectorXd& at, Eigen::Index size) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(size);
  for (int a = 0; a < tread_.nodes(); ++a)
    all.segment<3>(3 * tread_.block_rows()[a]) = at.segment<3>(3 * a);
  return all;
}

Result<LinearRoller::Found> LinearRoller::solve(const RollingCase& of,
                                                const Eigen::VectorXd& x,
                                                const Eigen::VectorXd& g,
                                                double load,
                                                double enough,
                                                GripState& states,
                                                int& passes,
                                                const PassingMoment* moment) {
  Eigen::VectorXd at;
  Eigen::VectorXd d = reduced(g, at);
  auto found = nodes_.solve(
      of, tread_.displacements(x), std::move(at), load, enough, states, passes, moment);
  if (!found) return found;
  expand(found->d, d);
  found->d = std::move(d);
  found->c = at_unknowns(found->c, g.size());
  return found;
}

TreadPast::Instant LinearRoller::instant(const RollingCase& of, const Eigen::VectorXd& x) const {
  return nodes_.instant(of, tread_.displacements(x));
}

/// Eliminates all nodes but those of the tread from the forces g: returns what expand() takes, and
/// the forces `at` these. Forces at the tread's nodes balance those of the ground. They stay out of
/// the factor's single precision, so that rounding is relative to what is not yet balanced.
Eigen::VectorXd LinearRoller::reduced(const Eigen::VectorXd& g, Eigen::VectorXd& at) const {
  Eigen::VectorXd d = g;
  for (const int row : tread_.block_rows()) d.segment<3>(3 * row).setZero();
  factor_.reduce(d);
  at = at_nodes(d) + at_nodes(g);
  return d;
}

/// Finds the decrease d of all unknowns from that at the tread's nodes.
void LinearRoller::expand(const Eigen::VectorXd& at, Eigen::VectorXd& d) const {
  for (int a = 0; a < tread_.nodes(); ++a)
    d.segment<3>(3 * tread_.block_rows()[a]) = at.segment<3>(3 * a);
  factor_.expand(d);
}

}  // namespace latsch::fe_tire
