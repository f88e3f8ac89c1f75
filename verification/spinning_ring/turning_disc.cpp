// SPDX-License-Identifier: Apache-2.0
#include "turning_disc.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "models/fe_tire/motion/spin.h"
#include "models/fe_tire/motion/spinning_tire.h"
#include "models/fe_tire/rolling/rolling_history.h"
#include "models/fe_tire/rolling/rolling_losses.h"
#include "numerics/sparse/factorization.h"
#include "ring_mesh.h"

namespace latsch::verification {
namespace {

using namespace fe_tire;

constexpr double kSpin = 50.0, kForce = 10.0;                // rad/s, N
constexpr double kSpread = 40.0 * std::numbers::pi / 180.0;  // rad
constexpr double kRelaxed = 0.8;                             // share of the unrelaxed moduli
constexpr int kMostPasses = 60;
constexpr double kAccepted = 1e-7;  // residual relative to the force

Materials relaxed_materials() {
  Materials materials = gyro_ring_materials();
  for (Solid& solid : materials.solids) std::get<StVenantKirchhoff>(solid.law).D *= kRelaxed;
  return materials;
}

/// All of the stress relaxes, that of the volume, too.
LossMaterials losses(const Materials& materials, double tau) {
  LossMaterials losses;
  losses.owners = {{"disc", false}};
  const PronyTerms terms = *from_unrelaxed({{1.0 - kRelaxed, tau}});
  for (const Solid& solid : materials.solids) {
    RelaxingSolid relaxing;
    relaxing.smeared = {{std::get<StVenantKirchhoff>(solid.law).D, terms, 0}};
    losses.solids.push_back(relaxing);
  }
  return losses;
}

/// Radial forces on all nodes [3 x nodes, sector frames], 10 N together.
Eigen::Matrix3Xd standing_force(const Mesh& mesh) {
  Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Zero(3, mesh.nodes());
  const int n = mesh.nodes_per_sector();
  for (int s = 0; s < mesh.sectors; ++s) {
    const double theta = std::remainder(mesh.angle(s), 2.0 * std::numbers::pi);
    if (std::abs(theta) >= kSpread) continue;
    for (int k = 0; k < n; ++k)  // inward: plane 0 of a sector's frame lies at the bottom
      if (std::abs(mesh.X(2, k) + mesh.outer_radius()) < 1e-9)
        force(2, s * n + k) = 0.5 * (1.0 + std::cos(theta / kSpread * std::numbers::pi));
  }
  return kForce / force.sum() * force;
}

}  // namespace

TurnedDisc turned_disc(int sectors, double tau) {
  const Mesh mesh = gyro_ring_mesh(sectors);
  FeTire tire(mesh, relaxed_materials(), {.element = ElementKind::full_integration});
  const auto at_rest = tire.inflate(0.0);
  const auto spun = SpinningTire(tire).inflate(*at_rest, kSpin);
  if (!spun) throw std::runtime_error(spun.failure().reason);
  const Ring ring(mesh, ElementKind::full_integration);
  const RingElements elements(ring, tire.materials());
  const RingUnknowns unknowns(ring, RingSymmetry::none, {});
  const RingAssembly assembly(unknowns);
  RollingHistory history(elements, losses(tire.materials(), tau), *spun);
  const numerics::SymmetricMatrix W = flow_stiffness(assembly, elements);
  numerics::SymmetricMatrix K(*assembly.pattern());
  numerics::Factorization factor(*assembly.pattern());
  const int n = mesh.nodes_per_sector();
  const Eigen::Matrix3Xd force = standing_force(mesh);
  const Eigen::VectorXd F = unknowns.compress(force);
  AssembledState state = assembly.zero_state();
  const Eigen::VectorXd round = unknowns.compress(spun->u.replicate(1, sectors));
  state.x = round;
  TurnedDisc turned{};
  for (turned.passes = 1;; ++turned.passes) {
    if (turned.passes > kMostPasses) throw std::runtime_error("the disc has no equilibrium");
    history.update(unknowns, state, kSpin);
    Eigen::VectorXd g;
    const bool is_first = turned.passes == 1;
    if (!assembly.assemble(history.elements(), state, 0.0, g, is_first ? &K : nullptr, nullptr))
      throw std::runtime_error("the disc is inverted");
    g -= kSpin * kSpin * flow_forces(unknowns, elements, unknowns.expand(state.x)) + F;
    if (g.norm() <= kAccepted * F.norm()) break;
    if (is_first) {
      K.add(-kSpin * kSpin, W);
      if (!factor.factorize(K).definite()) throw std::runtime_error("the disc buckles");
    }
    factor.solve(g);
    state.x -= g;
  }
  const Eigen::Matrix3Xd moved = unknowns.expand(state.x - round);
  const double step = 2.0 * std::numbers::pi / sectors;
  for (int k = 0; k < n; ++k)
    if (force(2, k) > 0.0) turned.displacement += 0.25 * moved(2, k);
  // Material passes the force toward decreasing theta: it moves inward at -spin d(u_in)/d(theta),
  // by differences of fourth order.
  for (int s = 0; s < sectors; ++s)
    for (int k = 0; k < n; ++k) {
      const auto at = [&](int steps) { return moved(2, (s + sectors + steps) % sectors * n + k); };
      turned.moment -=
          force(2, s * n + k) * (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * step);
    }
  const LossMeter meter(tire, losses(tire.materials(), tau), *spun);
  turned.by_losses = meter.measure(unknowns.expand(state.x), state.alpha, kSpin).rubber / kSpin;
  return turned;
}

const std::vector<ListedDisc>& listed_discs() {
  static const std::vector<ListedDisc> listed = {{36, 1e-3, 22.7757e-6, 13.561e-6},
                                                 {72, 1e-3, 23.2057e-6, 14.123e-6},
                                                 {144, 1e-3, 23.3322e-6, 14.288e-6},
                                                 {36, 1e-2, 20.1790e-6, 29.787e-6},
                                                 {72, 1e-2, 20.5273e-6, 30.164e-6},
                                                 {144, 1e-2, 20.6297e-6, 30.274e-6}};
  return listed;
}

}  // namespace latsch::verification
