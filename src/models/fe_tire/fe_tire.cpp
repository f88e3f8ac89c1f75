// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/fe_tire.h"

#include <algorithm>
#include <cmath>

#include "models/fe_tire/contact.h"
#include "models/fe_tire/equilibrium.h"
#include "models/fe_tire/inflation.h"
#include "models/fe_tire/loading.h"
#include "models/fe_tire/mode_label.h"
#include "models/fe_tire/modes.h"
#include "models/fe_tire/ring.h"

namespace latsch::fe_tire {

struct FeTire::Impl {
  Ring ring;
  Materials materials;
  SolverSettings settings;
  EquilibriumSolver solver;
  std::optional<numerics::SymmetricMatrix> M;  // of the present materials

  Impl(Mesh mesh, Materials given, const SolverSettings& s)
      : ring(std::move(mesh), s.element),
        materials(std::move(given)),
        settings(s),
        solver(ring, s) {}

  const numerics::SymmetricMatrix& mass_matrix() {
    if (!M) M = solver.assembly().mass(materials);
    return *M;
  }

  /// The inflated state in all sectors.
  RingState replicate(const Inflated& inflated) const {
    return {ring.replicate(ring.compress(inflated.u)), inflated.alpha.replicate(ring.sectors(), 1)};
  }

  /// Tangent of `state`, factorized; a Failure where the equilibrium is not stable.
  std::optional<Failure> factorize_at(RingState& state,
                                      double pressure,
                                      const GroundContact* contact);

  Result<std::vector<Mode>> full_modes(RingState& state,
                                       double pressure,
                                       const GroundContact* contact,
                                       int count,
                                       const std::vector<Mode>& reference);
};

namespace {

/// Force norm of the pressure on the undeformed tire: what the solver's tolerance is relative to.
double pressure_force(const Ring& ring, const Materials& materials, double pressure) {
  Vector24 with, without;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(ring.sector_unknowns());
  std::vector<double> alpha(std::max(1, ring.alphas_per_element()));
  for (int e = 0; e < ring.elements_per_sector(); ++e) {
    std::fill(alpha.begin(), alpha.end(), 0.0);
    pressurized_element(
        ring, materials, e, Matrix38::Zero(), pressure, alpha.data(), with, nullptr);
    std::fill(alpha.begin(), alpha.end(), 0.0);
    pressurized_element(ring, materials, e, Matrix38::Zero(), 0.0, alpha.data(), without, nullptr);
    Vector24 f = with - without;
    ring.turn_to_node_frames(e, f, nullptr);
    for (int k = 0; k < 24; ++k) {
      const int dof = ring.local_dofs(e)[k];
      if (dof >= 0) force[dof % ring.sector_unknowns()] += f[k];
    }
  }
  return force.norm() * std::sqrt(static_cast<double>(ring.sectors()));
}

}  // namespace

FeTire::FeTire(Mesh mesh, Materials materials, SolverSettings settings)
    : impl_(std::make_unique<Impl>(std::move(mesh), std::move(materials), settings)) {}
FeTire::~FeTire() = default;
FeTire::FeTire(FeTire&&) noexcept = default;
FeTire& FeTire::operator=(FeTire&&) noexcept = default;

const Mesh& FeTire::mesh() const { return impl_->ring.mesh(); }
const Materials& FeTire::materials() const { return impl_->materials; }
const SolverCounts& FeTire::counts() const { return impl_->solver.counts(); }
void FeTire::reset_counts() { impl_->solver.counts() = {}; }

void FeTire::set(Materials materials) {
  impl_->materials = std::move(materials);
  impl_->M.reset();
  impl_->solver.forget_factor();
}

Result<Inflated> FeTire::inflate(double pressure) {
  Impl& tire = *impl_;
  if (tire.ring.sectors() > 1) {
    return inflate_sector(tire.ring, tire.materials, pressure, tire.settings);
  }
  return inflate_ring(tire.solver,
                      tire.ring,
                      tire.materials,
                      pressure,
                      pressure_force(tire.ring, tire.materials, pressure));
}

Result<Loaded> FeTire::load(const Inflated& inflated,
                            const std::vector<double>& deflections,
                            const Ground& ground) {
  Impl& tire = *impl_;
  tire.solver.set_reference(pressure_force(tire.ring, tire.materials, inflated.pressure));
  // Start every load case from the same factor, so that its result does not depend on what was
  // solved before.
  tire.solver.forget_factor();
  GroundContact contact(tire.ring, ground);
  RingState state = tire.replicate(inflated);
  Result<std::vector<LoadPoint>> curve = load_steps(
      tire.solver, tire.materials, inflated, deflections, ground.mu > 0.0, contact, state);
  if (!curve) return curve.failure();
  Loaded loaded;
  loaded.inflated = inflated;
  loaded.ground = ground;
  loaded.curve = std::move(*curve);
  loaded.u = tire.ring.expand(state.x);
  loaded.alpha = state.alpha;
  return loaded;
}

Result<std::vector<Mode>> FeTire::modes(const Inflated& inflated, int count) {
  Impl& tire = *impl_;
  if (tire.ring.sectors() > 1) {
    return harmonic_modes(tire.ring, tire.materials, inflated, count);
  }
  return modes_full(inflated, count);
}

Result<std::vector<Mode>> FeTire::modes_full(const Inflated& inflated, int count) {
  RingState state = impl_->replicate(inflated);
  return impl_->full_modes(state, inflated.pressure, nullptr, count, {});
}

Result<std::vector<Mode>> FeTire::modes(const Loaded& loaded, int count) {
  Impl& tire = *impl_;
  GroundContact contact(tire.ring, loaded.ground);
  contact.set_height(-loaded.curve.back().loaded_radius);
  RingState state{tire.ring.compress(loaded.u), loaded.alpha};
  std::vector<Mode> reference;
  if (tire.ring.sectors() > 1) {
    Result<std::vector<Mode>> unloaded =
        harmonic_modes(tire.ring, tire.materials, loaded.inflated, count + count / 2);
    if (!unloaded) return unloaded.failure();
    reference = std::move(*unloaded);
  }
  return tire.full_modes(state, loaded.inflated.pressure, &contact, count, reference);
}

double FeTire::total_mass() const {
  const Impl& tire = *impl_;
  double mass_of_sector = 0.0;
  for (int e = 0; e < tire.ring.elements_per_sector(); ++e) {
    mass_of_sector += mass(tire.ring.shape(e), tire.materials, tire.ring.mesh().elements[e]).sum();
  }
  return mass_of_sector * tire.ring.sectors();
}

std::optional<Failure> FeTire::Impl::factorize_at(RingState& state,
                                                  double pressure,
                                                  const GroundContact* contact) {
  Eigen::VectorXd f;
  solver.assembly().assemble(
      materials, state, pressure, contact, true, f, &solver.tangent(), nullptr);
  if (solver.factorize()) return std::nullopt;
  return Failure{
      "modes: the equilibrium is not stable (its tangent is not positive definite): the tire "
      "buckles; check pressure, thicknesses and moduli"};
}

Result<std::vector<Mode>> FeTire::Impl::full_modes(RingState& state,
                                                   double pressure,
                                                   const GroundContact* contact,
                                                   int count,
                                                   const std::vector<Mode>& reference) {
  if (auto failure = factorize_at(state, pressure, contact)) return *failure;
  const Eigen::MatrixXd start = shape_columns(ring, reference);
  Eigen::MatrixXd shapes;
  Result<std::vector<double>> frequencies =
      ring_frequencies(solver.factor(), mass_matrix(), count, start, shapes);
  if (!frequencies) return frequencies.failure();
  std::vector<Mode> modes(frequencies->size());
  for (std::size_t k = 0; k < modes.size(); ++k) {
    modes[k].frequency = (*frequencies)[k];
    modes[k].shape = ring.expand(shapes.col(static_cast<int>(k)));
    modes[k].phase = phase_of(ring.mesh(), modes[k].shape);
  }
  if (!reference.empty()) name_after(reference, start, mass_matrix(), shapes, modes);
  return modes;
}

}  // namespace latsch::fe_tire
