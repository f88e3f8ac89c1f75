// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/fe_tire.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/fe_tire/analysis/fe_tire_impl.h"
#include "models/fe_tire/analysis/inflation.h"
#include "models/fe_tire/analysis/loading.h"
#include "models/fe_tire/analysis/mode_label.h"
#include "models/fe_tire/analysis/modes.h"
#include "models/fe_tire/description/tire_description.h"
#include "models/fe_tire/ring/sector.h"

namespace latsch::fe_tire {

namespace {

/// Returns the norm of the pressure forces on the undeformed tire, to which the solver's tolerance
/// is relative.
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

constexpr int kMostWindows = 4;

/// Describes a pose of the ground in words: "deflection 25 mm", and its other values if they are
/// not zero.
std::string in_words(const GroundPose& pose, const Inflated& inflated) {
  std::string text = fmt::format("deflection {:.4g} mm", (inflated.radius - pose.height) * 1e3);
  const auto add = [&text](const char* name, double value, const char* unit) {
    if (value != 0.0) text += fmt::format(", {} {:.4g} {}", name, value, unit);
  };
  constexpr double kDegree = 180.0 / std::numbers::pi;
  add("x", pose.x * 1e3, "mm");
  add("y", pose.y * 1e3, "mm");
  add("camber", pose.camber * kDegree, "deg");
  add("yaw", pose.yaw * kDegree, "deg");
  return text;
}

/// Returns a Failure if nodes that the rim holds would lie below the ground.
Status check_above_rim(const Mesh& mesh, const GroundPose& pose, const std::string& name) {
  double rim = 0.0;
  for (const int node : mesh.clamped)
    rim = std::max(rim, std::hypot(mesh.X(0, node), mesh.X(2, node)));
  if (pose.height > rim) return {};
  return Failure{
      fmt::format("{}: the ground would be {:.4g} mm from the wheel center and the rim holds the "
                  "tire up to {:.4g} mm from it",
                  name,
                  1e3 * pose.height,
                  1e3 * rim)};
}

/// Returns the Failure for held points on ground with friction or a bar, where points cannot be
/// held.
Failure held_elsewhere(const std::string& name) {
  return Failure{name +
                 ": points are held to ground with friction or a bar; expected flat ground without "
                 "friction, or no points held"};
}

Failure of_other_materials() {
  return Failure{
      "the state is that of a tire with other materials, which was symmetric under the half "
      "turn; load it again"};
}

Failure unstable(const std::string& where) {
  return Failure{where +
                 ": the equilibrium is not stable (its tangent is not positive definite): the tire "
                 "buckles; check pressure, thicknesses and moduli"};
}

/// Returns true if both states have the same tangent, for a tire whose materials are unchanged.
bool same_tangent(const TireState& a, const TireState& b) {
  return a.pose == b.pose && a.ground == b.ground && a.inflated->pressure == b.inflated->pressure &&
         a.u == b.u && a.alpha == b.alpha && a.anchors == b.anchors;
}

}  // namespace

FeTire::FeTire(Mesh mesh, Materials materials, SolverSettings settings)
    : impl_(std::make_unique<Impl>(std::move(mesh), std::move(materials), settings)) {}
FeTire::FeTire(const TireDescription& description)
    : FeTire(
          build_mesh(description), build_materials(description), {.element = description.element}) {
}
FeTire::~FeTire() = default;
FeTire::FeTire(FeTire&&) noexcept = default;
FeTire& FeTire::operator=(FeTire&&) noexcept = default;

const Mesh& FeTire::mesh() const { return impl_->ring.mesh(); }
const Materials& FeTire::materials() const { return impl_->elements().materials(); }
SolverCounts FeTire::counts() const { return impl_->counts; }
void FeTire::reset_counts() { impl_->counts = {}; }

void FeTire::set(Materials materials) { impl_->set(std::move(materials)); }

Result<Inflated> FeTire::inflate(double pressure) {
  Impl& tire = *impl_;
  if (tire.ring.sectors() > 1) {
    return inflate_sector(tire.even_elements(), pressure, tire.settings);
  }
  return inflate_ring(tire.systems(false, 0).solver,
                      tire.elements(),
                      pressure,
                      pressure_force(tire.elements(), pressure));
}

Result<Inflated> FeTire::inflate(double pressure, const Eigen::Matrix3Xd& near) {
  Impl& tire = *impl_;
  if (tire.ring.sectors() == 1) return inflate(pressure);
  return inflate_sector(tire.even_elements(), pressure, tire.settings, &near);
}

TireState FeTire::over(const Inflated& inflated, const Ground& ground, Poses poses) {
  Impl& tire = *impl_;
  const int S = tire.ring.sectors();
  TireState state;
  state.inflated = std::make_shared<const Inflated>(inflated);
  state.ground = ground;
  state.pose = below(inflated, 0.0);
  state.is_halved = poses == Poses::below && tire.mirror().has_value();
  state.window = Impl::first_window(ground);
  state.u = inflated.u.replicate(1, S);
  state.alpha = inflated.alpha.replicate(state.is_halved ? S / 2 : S, 1);
  return state;
}

Result<std::vector<TireState>> FeTire::advance(const TireState& from,
                                               const std::vector<GroundPose>& poses) {
  Impl& tire = *impl_;
  std::vector<TireState> states;
  for (const GroundPose& pose : poses) {
    if (const Status done = check_above_rim(mesh(), pose, in_words(pose, *from.inflated)); !done)
      return done.failure();
  }
  for (std::size_t k = 0; k < poses.size(); ++k) {
    // The factorization must stem from this path, not from an earlier computation, so that results
    // are reproducible.
    const TireState& last = states.empty() ? from : states.back();
    if (k == 0) tire.systems(last.is_halved, Impl::window_from(last)).solver.forget_factor();
    const std::string name = fmt::format("load step {} of {} ({} at {:.4g} bar)",
                                         k + 1,
                                         poses.size(),
                                         in_words(poses[k], *from.inflated),
                                         from.inflated->pressure / 1e5);
    Result<TireState> next = tire.move(last, poses[k], name);
    if (!next) return next.failure();
    states.push_back(std::move(*next));
    if (tire.on_passing && k + 1 < poses.size())
      tire.on_passing(tire.systems(states.back().is_halved, states.back().window), states.back());
  }
  if (states.empty()) return states;
  const TireState& last = states.back();
  Systems& all = tire.systems(last.is_halved, last.window);
  all.solver.release();  // makes room for the factorizations of the last state
  if (const Status done = tire.factorize(all, last); !done) return done.failure();
  return states;
}

Result<std::vector<TireState>> FeTire::press(const Inflated& inflated,
                                             const Ground& ground,
                                             const std::vector<double>& deflections) {
  std::vector<GroundPose> poses;
  poses.reserve(deflections.size());
  for (const double deflection : deflections) poses.push_back(below(inflated, deflection));
  return advance(over(inflated, ground), poses);
}

/// Moves the ground to a pose and finds the equilibrium. If the tread touches outside of the window
/// in which contact is computed, the step is repeated with a wider window.
Result<TireState> FeTire::Impl::move(const TireState& from,
                                     const GroundPose& pose,
                                     const std::string& name) {
  if (from.is_halved && !pose.is_below())
    return Failure{name + ": the state is half a ring, whose ground stays below the wheel center"};
  if (from.is_halved && !mirror()) return of_other_materials();
  if (from.ground.held && (from.ground.mu > 0.0 || from.ground.bar)) return held_elsewhere(name);
  const int first = window_from(from);
  for (int window = first;; ++window) {
    Systems& all = systems(from.is_halved, window);
    if (from.ground.held && !all.tread.has_points(from.ground.held->points))
      return Failure{name + ": the points held to the ground are not those of this tire's tread"};
    if (window > first) all.solver.forget_factor();
    all.solver.set_reference(pressure_force(even_elements(), from.inflated->pressure));
    TreadContact contact(all.tread, from.ground);
    Placed placed{from.pose, {all.unknowns.compress(from.u), from.alpha}, from.anchors};
    const Status moved =
        move_ground(all.solver, elements(), from.inflated->pressure, contact, pose, name, placed);
    if (!moved) return moved.failure();
    if (contact.misses(placed.state.x) && from.anchors.empty() && window < kMostWindows) continue;
    TireState state = from;
    state.pose = pose;
    state.window = window;
    state.u = all.unknowns.expand(placed.state.x);
    state.alpha = std::move(placed.state.alpha);
    state.anchors = std::move(placed.anchors);
    return state;
  }
}

Standing FeTire::stand(const TireState& state) {
  Systems& all = impl_->systems(state.is_halved, state.window);
  TreadContact contact(all.tread, state.ground);
  const Eigen::VectorXd x = all.unknowns.compress(state.u);
  contact.start(state.pose, x, state.anchors);
  const TreadContact::Sum sum = contact.sum(x);
  return {state.deflection(), state.pose.height, sum.force, sum.moment, contact.patch(x)};
}

TouchingPoints FeTire::touching(const TireState& state) {
  Systems& all = impl_->systems(state.is_halved, state.window);
  TreadContact contact(all.tread, state.ground);
  const Eigen::VectorXd x = all.unknowns.compress(state.u);
  contact.start(state.pose, x, state.anchors);
  return {state.window, contact.within(0.0, all.tread.displacements(x))};
}

Result<std::vector<Mode>> FeTire::modes(const Inflated& inflated, int count) {
  Impl& tire = *impl_;
  if (tire.ring.sectors() > 1) {
    return harmonic_modes(
        tire.even_elements(), tire.ring.mesh(), inflated, count, tire.settings.mode_tolerance);
  }
  return modes_full(inflated, count);
}

Result<std::vector<Mode>> FeTire::modes_full(const Inflated& inflated, int count) {
  Impl& tire = *impl_;
  const RingUnknowns whole(tire.even_ring(), RingSymmetry::none, {});
  const RingAssembly assembly(whole);
  AssembledState state = assembly.zero_state();
  state.x = whole.compress(inflated.u.replicate(1, tire.ring.sectors()));
  state.alpha = inflated.alpha.replicate(tire.ring.sectors(), 1);
  Eigen::VectorXd f;
  numerics::SymmetricMatrix K(*assembly.pattern());
  int worst = 0;
  if (!assembly.assemble(tire.even_elements(), state, inflated.pressure, f, &K, &worst)) {
    return no_tangent(whole.ring(), worst);
  }
  numerics::Factorization factor(*assembly.pattern());
  if (!factor.factorize(K).definite()) return unstable("modes");
  return ring_modes(
      assembly, factor, assembly.mass(tire.even_elements()), count, tire.settings.mode_tolerance);
}

Result<std::vector<Mode>> FeTire::modes(const TireState& state, int count) {
  Impl& tire = *impl_;
  Result<std::vector<Mode>> modes = tire.modes_at(state, count);
  if (!modes) return modes;
  for (Mode& mode : *modes) mode.phase = phase_of(tire.ring.mesh(), mode.shape);
  if (tire.ring.sectors() > 1) {
    // More unloaded modes than loaded ones are computed, by half, because some unloaded modes that
    // resemble the loaded ones have higher frequencies.
    const auto unloaded = harmonic_modes(tire.even_elements(),
                                         tire.ring.mesh(),
                                         *state.inflated,
                                         count + count / 2,
                                         tire.settings.mode_tolerance);
    if (!unloaded) return unloaded.failure();
    name_after(*unloaded, nodal_masses(tire.elements()), *modes);
  }
  return modes;
}

double FeTire::total_mass() const { return nodal_masses(impl_->even_elements()).sum(); }
MassProperties FeTire::mass_properties(const Inflated& inflated) const {
  return fe_tire::mass_properties(impl_->even_elements(), inflated.u);
}

/// Computes the `count` lowest of the even and odd modes together. First, somewhat more than half
/// of this number of each kind are found approximately. Those that are among the `count` lowest are
/// then computed accurately. If these include all modes of one kind, the search is repeated with
/// more of this kind.
Result<std::vector<Mode>> FeTire::Impl::modes_at(const TireState& state, int count) {
  constexpr int kSpare = 3;
  if (state.is_halved && !mirror()) return of_other_materials();
  Systems& all = systems(state.is_halved, state.window);
  if (const Status done = factorize(all, state); !done) return done.failure();
  all.find_masses(elements());
  std::vector<LoadedModes> kinds;
  kinds.emplace_back(all.solver.assembly(), all.tangent, all.factor, *all.mass, settings);
  if (all.odd)
    kinds.emplace_back(*all.odd, *all.odd_tangent, *all.odd_factor, *all.odd_mass, settings);
  const int share = count / static_cast<int>(kinds.size());
  for (int each = share + kSpare;; each *= 2) {
    std::vector<std::vector<double>> near;
    std::vector<double> together;
    for (LoadedModes& kind : kinds) {
      auto frequencies = kind.approach(each, kSpare);
      if (!frequencies) return frequencies.failure();
      near.push_back(*std::move(frequencies));
      together.insert(together.end(), near.back().begin(), near.back().end());
    }
    std::ranges::sort(together);
    const std::size_t last = std::min<std::size_t>(together.size(), count) - 1;
    const double highest = (1.0 + LoadedModes::kNearby) * together[last];
    std::vector<Mode> modes;
    bool may_be_more = false;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const auto among = std::ranges::upper_bound(near[k], highest) - near[k].begin();
      may_be_more = may_be_more || (among == each && among < count);
      if (may_be_more) break;
      const auto found = kinds[k].find(static_cast<int>(among));
      if (!found) return found;
      modes.insert(modes.end(), found->begin(), found->end());
    }
    if (may_be_more) continue;
    std::ranges::stable_sort(modes, {}, &Mode::frequency);
    modes.resize(std::min<std::size_t>(modes.size(), count));
    const auto keep = [](LoadedModes& kind, std::optional<numerics::Davidson>& search) {
      search.reset();
      if (auto found = std::move(kind).search()) search.emplace(*std::move(found));
    };
    keep(kinds.front(), all.search);
    if (all.odd) keep(kinds.back(), all.odd_search);
    return modes;
  }
}

Status FeTire::Impl::factorize(Systems& all, const TireState& at) {
  if (all.factored && same_tangent(*all.factored, at)) return {};
  all.forget_tangents();
  AssembledState state{all.unknowns.compress(at.u), at.alpha};
  std::vector<RingAssembly::Vibration> tangents{{&all.unknowns, &all.tangent}};
  if (all.odd) tangents.push_back({&*all.odd_unknowns, &*all.odd_tangent});
  int worst = 0;
  if (!all.solver.assembly().assemble_tangents(
          elements(), state, at.inflated->pressure, tangents, &worst)) {
    return no_tangent(all.unknowns.ring(), worst);
  }
  add_ground(all, all.tread, at, state, all.tangent);
  if (const Status done = factorize(at, all.tangent, all.factor); !done) return done;
  if (all.odd) {
    add_ground(all, *all.odd_tread, at, state, *all.odd_tangent);
    if (const Status done = factorize(at, *all.odd_tangent, *all.odd_factor); !done) return done;
  }
  all.factored = at;
  return {};
}

Status FeTire::Impl::assemble(Systems& all,
                              const TireState& at,
                              numerics::SymmetricMatrix& tangent) {
  AssembledState state{all.unknowns.compress(at.u), at.alpha};
  int worst = 0;
  if (!all.solver.assembly().assemble_tangent(
          elements(), state, at.inflated->pressure, all.unknowns, tangent, &worst)) {
    return no_tangent(all.unknowns.ring(), worst);
  }
  add_ground(all, all.tread, at, state, tangent);
  return {};
}

Status FeTire::Impl::factorize(const TireState& at,
                               const numerics::SymmetricMatrix& tangent,
                               numerics::Factorization& factor) {
  ++counts.factorizations;
  if (!factor.factorize(tangent).definite()) return unstable(in_words(at.pose, *at.inflated));
  return {};
}

/// Adds the ground's stiffness to the tangent. The state is symmetric ("even"); odd unknowns
/// describe only vibrations about it. Elements and ground are therefore evaluated in the even
/// numbering, and the tangent is assembled in the requested one.
void FeTire::Impl::add_ground(Systems& all,
                              const TreadSurface& tread,
                              const TireState& at,
                              const AssembledState& state,
                              numerics::SymmetricMatrix& tangent) {
  TreadContact contact(all.tread, at.ground);
  contact.start(at.pose, state.x, at.anchors);
  add_stiffness(tread, contact.stuck(state.x), all.solver.assembly().first_cell(), tangent);
}

}  // namespace latsch::fe_tire
