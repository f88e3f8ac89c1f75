// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/ring/fe_tire.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/fe_tire/description/tire_description.h"
#include "models/fe_tire/ring/contact.h"
#include "models/fe_tire/ring/equilibrium.h"
#include "models/fe_tire/ring/inflation.h"
#include "models/fe_tire/ring/loading.h"
#include "models/fe_tire/ring/mode_label.h"
#include "models/fe_tire/ring/modes.h"
#include "models/fe_tire/ring/ring.h"
#include "models/fe_tire/ring/ring_elements.h"
#include "models/fe_tire/ring/ring_unknowns.h"
#include "models/fe_tire/ring/sector.h"

namespace latsch::fe_tire {

/// All that depends on the mesh and on whether the half turn is a symmetry. Even states carry the
/// loading; even and odd ones together all loaded modes. Without the symmetry `even` is the whole
/// ring and `odd` is empty.
struct Systems {
  RingUnknowns unknowns;
  EquilibriumSolver solver;
  std::optional<RingUnknowns> odd_unknowns;
  std::optional<RingAssembly> odd;
  // Of tangents for modes, even and odd ones in turn: they have the same pattern.
  numerics::SymmetricMatrix tangent;
  numerics::Factorization factor;

  Systems(const Ring& ring,
          const SolverSettings& settings,
          const std::optional<std::vector<int>>& mirror)
      : unknowns(ring,
                 mirror ? RingSymmetry::even : RingSymmetry::none,
                 mirror ? *mirror : std::vector<int>()),
        solver(unknowns, settings),
        tangent(*solver.assembly().pattern()),
        factor(*solver.assembly().pattern(),
               numerics::Precision::full,
               solver.factor().elimination()) {
    if (!mirror) return;
    odd_unknowns.emplace(ring, RingSymmetry::odd, *mirror);
    odd.emplace(*odd_unknowns, solver.assembly().pattern());
  }
};

struct FeTire::Impl {
  Ring ring;                 // pressed on the ground
  std::optional<Ring> even;  // all sectors equally wide, where those of `ring` are not
  SolverSettings settings;

  Impl(Mesh mesh, const Materials& materials, const SolverSettings& s)
      : ring(std::move(mesh), s.element), settings(s) {
    if (ring.widths() > 1) even.emplace(ring.mesh().evenly_divided(), s.element);
    set(materials);
  }

  void set(const Materials& materials) {
    elements_.emplace(ring, materials);
    if (even) even_elements_.emplace(*even, materials);
    is_symmetry_known_ = false;
  }

  const RingElements& elements() const { return *elements_; }

  /// Symbolic work, for whoever needs more than one sector; done again only where new materials
  /// make or break the symmetry.
  Systems& systems() {
    if (is_symmetry_known_) return *systems_;
    const auto mirror = find_mirror(ring.mesh(), elements().materials());
    if (!systems_ || systems_->odd.has_value() != mirror.has_value()) {
      SolverCounts before = counts();
      systems_ = std::make_unique<Systems>(ring, settings, mirror);
      ++before.analyses;
      systems_->solver.counts() = before;
    }
    is_symmetry_known_ = true;
    return *systems_;
  }

  SolverCounts counts() const { return systems_ ? systems_->solver.counts() : SolverCounts{}; }
  void reset_counts() {
    if (systems_) systems_->solver.counts() = {};
  }

  /// What inflation and unloaded modes see: one sector stands for the ring.
  const Ring& even_ring() const { return even ? *even : ring; }
  const RingElements& even_elements() const { return even ? *even_elements_ : *elements_; }

  /// The inflated state in all sectors that are assembled.
  RingState replicate(const Inflated& inflated) {
    const RingUnknowns& unknowns = systems().unknowns;
    const int S = ring.sectors();
    return {unknowns.compress(inflated.u.replicate(1, S)),
            inflated.alpha.replicate(unknowns.sectors(), 1)};
  }

  Result<std::vector<Mode>> modes_at(const Loaded& loaded, int count);
  Result<std::vector<Mode>> modes_of(const RingAssembly& assembly, const Loaded& loaded, int count);
  std::optional<Failure> factorize_tangent(const RingAssembly& assembly, const Loaded& loaded);
  std::optional<Failure> instability(const Loaded& loaded);

 private:
  std::optional<RingElements> elements_, even_elements_;  // of `ring`, of `even`
  std::unique_ptr<Systems> systems_;
  bool is_symmetry_known_ = false;
};

namespace {

/// Force norm of the pressure on the undeformed tire: what the solver's tolerance is relative to.
double pressure_force(const RingElements& elements, double pressure) {
  const Ring& ring = elements.ring();
  Eigen::VectorXd alpha =
      Eigen::VectorXd::Zero(ring.alphas_per_element() * ring.elements_per_sector());
  const Eigen::VectorXd x = Eigen::VectorXd::Zero(ring.sector_unknowns());
  Eigen::VectorXd with, without;
  assemble_sector(elements, x, pressure, alpha, with, nullptr, nullptr);
  assemble_sector(elements, x, 0.0, alpha, without, nullptr, nullptr);
  return (with - without).norm() * std::sqrt(static_cast<double>(ring.sectors()));
}

Failure unstable(const std::string& where) {
  return Failure{where +
                 ": the equilibrium is not stable (its tangent is not positive definite): the tire "
                 "buckles; check pressure, thicknesses and moduli"};
}

}  // namespace

FeTire::FeTire(Mesh mesh, Materials materials, SolverSettings settings)
    : impl_(std::make_unique<Impl>(std::move(mesh), materials, settings)) {}
FeTire::FeTire(const TireDescription& description)
    : FeTire(
          build_mesh(description), build_materials(description), {.element = description.element}) {
}
FeTire::~FeTire() = default;
FeTire::FeTire(FeTire&&) noexcept = default;
FeTire& FeTire::operator=(FeTire&&) noexcept = default;

const Mesh& FeTire::mesh() const { return impl_->ring.mesh(); }
const Materials& FeTire::materials() const { return impl_->elements().materials(); }
SolverCounts FeTire::counts() const { return impl_->counts(); }
void FeTire::reset_counts() { impl_->reset_counts(); }

void FeTire::set(Materials materials) { impl_->set(materials); }

Result<Inflated> FeTire::inflate(double pressure) {
  Impl& tire = *impl_;
  if (tire.ring.sectors() > 1) {
    return inflate_sector(tire.even_elements(), pressure, tire.settings);
  }
  return inflate_ring(
      tire.systems().solver, tire.elements(), pressure, pressure_force(tire.elements(), pressure));
}

Result<Loaded> FeTire::load(const Inflated& inflated,
                            const std::vector<double>& deflections,
                            const Ground& ground) {
  Impl& tire = *impl_;
  EquilibriumSolver& solver = tire.systems().solver;
  solver.set_reference(pressure_force(tire.even_elements(), inflated.pressure));
  // Start every load case from scratch, so that its result does not depend on what was solved
  // before.
  solver.forget_factor();
  GroundContact contact(tire.systems().unknowns, ground);
  RingState state = tire.replicate(inflated);
  Result<std::vector<LoadPoint>> curve =
      load_steps(solver, tire.elements(), inflated, deflections, ground.mu > 0.0, contact, state);
  if (!curve) return curve.failure();
  Loaded loaded;
  loaded.inflated = inflated;
  loaded.ground = ground;
  loaded.curve = std::move(*curve);
  loaded.u = tire.systems().unknowns.expand(state.x);
  loaded.alpha = std::move(state.alpha);
  if (auto failure = tire.instability(loaded)) return *failure;
  return loaded;
}

Result<std::vector<Mode>> FeTire::modes(const Inflated& inflated, int count) {
  Impl& tire = *impl_;
  if (tire.ring.sectors() > 1) {
    return harmonic_modes(tire.even_elements(), tire.ring.mesh(), inflated, count);
  }
  return modes_full(inflated, count);
}

Result<std::vector<Mode>> FeTire::modes_full(const Inflated& inflated, int count) {
  Impl& tire = *impl_;
  const RingUnknowns whole(tire.even_ring(), RingSymmetry::none, {});
  const RingAssembly assembly(whole);
  RingState state = assembly.zero_state();
  state.x = whole.compress(inflated.u.replicate(1, tire.ring.sectors()));
  state.alpha = inflated.alpha.replicate(tire.ring.sectors(), 1);
  Eigen::VectorXd f;
  numerics::SymmetricMatrix K(*assembly.pattern());
  int worst = 0;
  if (!assembly.assemble(tire.even_elements(), state, inflated.pressure, nullptr, f, &K, &worst)) {
    return no_tangent(whole.ring(), worst);
  }
  numerics::Factorization factor(*assembly.pattern());
  if (!factor.factorize(K).definite()) return unstable("modes");
  return ring_modes(assembly, factor, assembly.mass(tire.even_elements()), count);
}

Result<std::vector<Mode>> FeTire::modes(const Loaded& loaded, int count) {
  Impl& tire = *impl_;
  Result<std::vector<Mode>> modes = tire.modes_at(loaded, count);
  if (!modes) return modes;
  for (Mode& mode : *modes) mode.phase = phase_of(tire.ring.mesh(), mode.shape);
  if (tire.ring.sectors() > 1) {
    // Half as many again: some of the unloaded modes that the loaded ones resemble lie higher.
    const auto unloaded =
        harmonic_modes(tire.even_elements(), tire.ring.mesh(), loaded.inflated, count + count / 2);
    if (!unloaded) return unloaded.failure();
    name_after(*unloaded, nodal_masses(tire.elements()), *modes);
  }
  return modes;
}

double FeTire::total_mass() const { return nodal_masses(impl_->even_elements()).sum(); }

/// Modes of even and odd states together, the lowest `count`. Each kind is asked for somewhat more
/// than its half; where one may hold more of the lowest than it was asked for, again.
Result<std::vector<Mode>> FeTire::Impl::modes_at(const Loaded& loaded, int count) {
  const RingAssembly& even = systems().solver.assembly();
  if (!systems().odd) return modes_of(even, loaded, count);
  for (int each = count / 2 + 3;; each = std::min(count, 2 * each)) {
    auto modes = modes_of(even, loaded, each);
    if (!modes) return modes;
    auto odd = modes_of(*systems().odd, loaded, each);
    if (!odd) return odd;
    const double sure = std::min(modes->back().frequency, odd->back().frequency);
    modes->insert(modes->end(), odd->begin(), odd->end());
    std::stable_sort(modes->begin(), modes->end(), [](const Mode& a, const Mode& b) {
      return a.frequency < b.frequency;
    });
    modes->resize(std::min<std::size_t>(modes->size(), count));
    if (each >= count || modes->back().frequency <= sure) return modes;
  }
}

Result<std::vector<Mode>> FeTire::Impl::modes_of(const RingAssembly& assembly,
                                                 const Loaded& loaded,
                                                 int count) {
  if (auto failure = factorize_tangent(assembly, loaded)) return *failure;
  return ring_modes(assembly, systems().factor, assembly.mass(elements()), count);
}

/// The last equilibrium is one that the tire keeps: every motion about it, even or odd, takes
/// energy. Newton's method finds others just as well.
std::optional<Failure> FeTire::Impl::instability(const Loaded& loaded) {
  if (loaded.curve.empty()) return std::nullopt;
  if (auto failure = factorize_tangent(systems().solver.assembly(), loaded)) return failure;
  return systems().odd ? factorize_tangent(*systems().odd, loaded) : std::nullopt;
}

/// The factor of the tangent that motions of this kind see at the last equilibrium.
std::optional<Failure> FeTire::Impl::factorize_tangent(const RingAssembly& assembly,
                                                       const Loaded& loaded) {
  // The state is even; odd unknowns hold only what may vibrate about it. So elements see the state
  // of the even numbering, and the tangent is gathered in the numbering asked for.
  Systems& all = systems();
  RingState state{all.unknowns.compress(loaded.u), loaded.alpha};
  if (state.alpha.size() != all.solver.assembly().zero_state().alpha.size()) {
    return Failure{
        "modes: the tire was loaded with other materials (or another symmetry of them); "
        "load it again"};
  }
  GroundContact contact(all.unknowns, loaded.ground);
  contact.set_height(-loaded.curve.back().loaded_radius);
  int worst = 0;
  if (!all.solver.assembly().assemble_tangent(elements(),
                                              state,
                                              loaded.inflated.pressure,
                                              &contact,
                                              assembly.unknowns(),
                                              all.tangent,
                                              &worst)) {
    return no_tangent(all.unknowns.ring(), worst);
  }
  ++all.solver.counts().factorizations;
  if (all.factor.factorize(all.tangent).definite()) return std::nullopt;
  return unstable(fmt::format("deflection {:.4g} mm", loaded.curve.back().deflection * 1e3));
}

}  // namespace latsch::fe_tire
