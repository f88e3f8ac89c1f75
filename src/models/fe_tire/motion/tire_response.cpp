// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/motion/tire_response.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "models/fe_tire/analysis/fe_tire_impl.h"
#include "models/fe_tire/history/dynamic_moduli.h"
#include "models/fe_tire/motion/damped_tire.h"
#include "models/fe_tire/motion/response_ports.h"
#include "models/fe_tire/motion/response_shapes.h"

namespace latsch::fe_tire {
namespace {

/// One numbering of the ring's motions with its matrices and the shapes that were found in it.
struct ShapedMotions {
  NumberedMotions motions;
  const numerics::SymmetricMatrix* K;
  const numerics::Factorization* factor;
  const std::optional<numerics::SymmetricMatrix>* M;
  Eigen::MatrixXd shapes = {};  // columns of unit mass
};

std::vector<ShapedMotions> numberings(Systems& all) {
  std::vector<ShapedMotions> kinds = {
      {{&all.unknowns, &all.tread, 1.0}, &all.tangent, &all.factor, &all.mass}};
  if (all.odd_unknowns)
    kinds.push_back({{&*all.odd_unknowns, &*all.odd_tread, -1.0},
                     &*all.odd_tangent,
                     &*all.odd_factor,
                     &all.odd_mass});
  return kinds;
}

/// Appends the static displacements under the loads to the shapes, and those under the inertia of
/// these displacements: the first two terms of what truncated modes lack, in powers of omega^2.
void append_static(const Eigen::MatrixXd& loads, ShapedMotions& kind) {
  Eigen::MatrixXd displacements = loads;
  kind.factor->solve_columns(displacements);
  append_orthogonal(displacements, **kind.M, kind.shapes);
  Eigen::MatrixXd further(displacements.rows(), displacements.cols());
  (*kind.M)->multiply(displacements, further);
  kind.factor->solve_columns(further);
  append_orthogonal(further, **kind.M, kind.shapes);
}

/// Returns the shapes of the whole ring, in sector frames, of unit mass.
std::vector<Mode> on_the_ring(const std::vector<ShapedMotions>& kinds) {
  std::vector<Mode> modes;
  for (const ShapedMotions& kind : kinds) {
    const double scale = 1.0 / std::sqrt(kind.motions.unknowns->multiplicity());
    for (Eigen::Index k = 0; k < kind.shapes.cols(); ++k)
      modes.emplace_back().shape = scale * kind.motions.unknowns->expand(kind.shapes.col(k));
  }
  return modes;
}

}  // namespace

Result<TireResponse> TireResponse::about(FeTire& tire,
                                         const LossMaterials& losses,
                                         const TireState& state,
                                         const std::vector<ResponsePort>& ports,
                                         const ResponseSettings& settings) {
  FeTire::Impl& impl = *tire.impl_;
  Systems& all = impl.systems(state.is_halved, state.window);
  std::vector<ShapedMotions> kinds = numberings(all);
  std::vector<NumberedMotions> motions;
  for (const ShapedMotions& kind : kinds) motions.push_back(kind.motions);
  const PortLoads loads = port_loads(all, impl.elements(), state, motions, ports);
  const auto factorize = [&]() -> Status {
    const Status done = impl.factorize(all, state);
    if (done.ok()) all.find_masses(impl.elements());
    return done;
  };
  const auto add_static = [&] {
    if (!settings.has_static_shapes) return;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      append_static(loads.still[k], kinds[k]);
      append_static(loads.inertial[k], kinds[k]);
    }
  };
  // Modes, and static displacements with the moduli at the highest frequency.
  const bool relaxes = !losses.is_elastic();
  const Materials relaxed = tire.materials();
  const double highest = 2.0 * std::numbers::pi * settings.highest;
  if (relaxes) tire.set(stiffened(relaxed, losses, highest));
  const Status stiff = [&]() -> Status {
    if (const Status done = factorize(); !done) return done;
    for (ShapedMotions& kind : kinds) {
      auto modes = modes_up_to(settings.beyond * settings.highest, *kind.factor, **kind.M);
      if (!modes) return modes.failure();
      kind.shapes = *std::move(modes);
    }
    return {};
  }();
  TireResponse response;
  for (const ShapedMotions& kind : kinds) response.modes_ += static_cast<int>(kind.shapes.cols());
  if (stiff.ok()) add_static();
  if (relaxes) tire.set(relaxed);
  if (!stiff) return stiff.failure();
  if (relaxes) {
    if (const Status done = factorize(); !done) return done.failure();
    add_static();
  }

  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const Eigen::MatrixXd& shapes = kinds[k].shapes;
    Eigen::MatrixXd K_shapes(shapes.rows(), shapes.cols());
    kinds[k].K->multiply(shapes, K_shapes);
    Part& part = response.parts_.emplace_back();
    part.motion.K = shapes.transpose() * K_shapes;
    part.motion.rayleigh = settings.rayleigh;
    const double scale = std::sqrt(kinds[k].motions.unknowns->multiplicity());
    part.still = scale * (shapes.transpose() * loads.still[k]);
    part.inertial = scale * (shapes.transpose() * loads.inertial[k]);
  }
  response.sign_ = loads.sign;
  response.direct_ = loads.direct;
  response.direct_inertial_ = loads.direct_inertial;
  if (!relaxes) return response;
  auto projected = DampedTire(tire, losses).project(relaxed, state, on_the_ring(kinds));
  if (!projected) return projected.failure();
  Eigen::Index first = 0;
  for (Part& part : response.parts_) {
    const Eigen::Index own = part.motion.K.rows();
    for (const RelaxingStiffness& relaxing : projected->parts)
      part.motion.parts.push_back({relaxing.K.block(first, first, own, own), relaxing.terms});
    first += own;
  }
  return response;
}

int TireResponse::shapes() const {
  Eigen::Index count = 0;
  for (const Part& part : parts_) count += part.motion.K.rows();
  return static_cast<int>(count);
}

Eigen::MatrixXcd TireResponse::at(double frequency) const {
  const double omega = 2.0 * std::numbers::pi * frequency, squared = omega * omega;
  Eigen::MatrixXcd H = Eigen::MatrixXcd::Zero(direct_.rows(), direct_.cols());
  for (const Part& part : parts_) {
    const Eigen::MatrixXd loads = part.still + squared * part.inertial;
    H += loads.transpose() * part.motion.motions(omega, loads.cast<std::complex<double>>());
  }
  H = (sign_.asDiagonal() * H).eval();
  H += direct_ + squared * direct_inertial_;
  return H;
}

}  // namespace latsch::fe_tire
