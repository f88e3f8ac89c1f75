// SPDX-License-Identifier: Apache-2.0
// A program that uses an installed Latsch: reads a quantity and solves k u = F with it.
#include <cstdio>

#include "base/units.h"
#include "numerics/sparse/factorization.h"

int main() {
  const auto stiffness = latsch::parse_quantity("220 N/mm");
  const latsch::numerics::SymmetricPattern pattern(1, {{0}});
  latsch::numerics::SymmetricMatrix k(pattern);
  if (!stiffness) return 1;
  k.add_element(0, &stiffness->si);
  latsch::numerics::Factorization factor(pattern);
  if (!factor.factorize(k).definite()) return 1;
  Eigen::VectorXd u = Eigen::VectorXd::Constant(1, 4400.0);
  factor.solve(u);
  std::printf("4.4 kN deflect it by %g mm\n", 1e3 * u[0]);
  return u[0] == 0.02 ? 0 : 1;
}
