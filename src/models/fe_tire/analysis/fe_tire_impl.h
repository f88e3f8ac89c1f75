// SPDX-License-Identifier: Apache-2.0
// Internals of the finite-element tire, for the two files that implement its statics and modes
// (fe_tire.cpp) and its derivatives (tire_slopes.cpp).
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "models/fe_tire/analysis/equilibrium.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/ring/ring.h"
#include "models/fe_tire/ring/ring_elements.h"
#include "models/fe_tire/ring/ring_unknowns.h"
#include "numerics/sparse/davidson.h"

namespace latsch::fe_tire {

/// Everything that depends on the mesh, on whether half of the ring represents all of it, and on
/// how much of the tread may touch. Loaded states are even, that is, symmetric under the half turn.
/// Even and odd motions together give all modes of the loaded tire. If the whole ring is computed,
/// only the `even` members are used.
struct Systems {
  RingUnknowns unknowns;
  TreadSurface tread;
  EquilibriumSolver solver;
  std::optional<RingUnknowns> odd_unknowns;
  std::optional<TreadSurface> odd_tread;
  std::optional<RingAssembly> odd;
  double half_angle;  // rad, half angle of the part of the tread that may touch
  // Tangents about the state `factored` for even and for odd motions. Both have the same sparsity
  // pattern.
  numerics::SymmetricMatrix tangent;
  std::optional<numerics::SymmetricMatrix> odd_tangent;
  numerics::Factorization factor;
  std::optional<numerics::Factorization> odd_factor;
  // Not set if no state was factorized, or if its tangents are indefinite.
  std::optional<TireState> factored;
  // Mass matrices, computed when they are first needed.
  std::optional<numerics::SymmetricMatrix> mass, odd_mass;
  // Eigenvalue searches that found modes about `factored`.
  std::optional<numerics::Davidson> search, odd_search;

  Systems(const Ring& ring,
          const SolverSettings& settings,
          const std::optional<std::vector<int>>& mirror,
          double angle,
          SolverCounts& counts)
      : unknowns(ring,
                 mirror ? RingSymmetry::even : RingSymmetry::none,
                 mirror ? *mirror : std::vector<int>()),
        tread(unknowns, settings.tread_shape(), angle),
        solver(unknowns, tread, settings, counts),
        half_angle(angle),
        tangent(*solver.assembly().pattern()),
        factor(*solver.assembly().pattern(), numerics::Precision::refined, solver.elimination()) {
    if (!mirror) return;
    odd_unknowns.emplace(ring, RingSymmetry::odd, *mirror);
    odd_tread.emplace(*odd_unknowns, settings.tread_shape(), half_angle);
    odd.emplace(*odd_unknowns, solver.assembly().pattern());
    odd_tangent.emplace(*odd->pattern());
    odd_factor.emplace(*odd->pattern(), numerics::Precision::refined, solver.elimination());
  }

  void forget_tangents() {
    factored.reset();
    search.reset();
    odd_search.reset();
  }
  void find_masses(const RingElements& elements) {
    if (!mass) mass = solver.assembly().mass(elements);
    if (odd && !odd_mass) odd_mass = odd->mass(elements);
  }
};

struct FeTire::Impl {
  Ring ring;  // the ring of sectors that is pressed on the ground
  // The ring with equally wide sectors; set only if those of `ring` are not.
  std::optional<Ring> even;
  SolverSettings settings;
  SolverCounts counts;
  /// Called for every intermediate equilibrium on the path, while the solver's factorization
  /// belongs to a nearby state. The final state is returned, not reported here.
  std::function<void(Systems& all, const TireState& state)> on_passing;

  Impl(Mesh mesh, Materials materials, const SolverSettings& s)
      : ring(std::move(mesh), s.element), settings(s) {
    if (ring.widths() > 1) even.emplace(ring.mesh().evenly_divided(), s.element);
    set(std::move(materials));
  }

  void set(Materials materials) {  // a copy, because they may be those of elements_
    if (even) even_elements_.emplace(*even, materials);
    elements_.emplace(ring, std::move(materials));
    is_symmetry_known_ = false;
    for (auto& [of, systems] : systems_) {
      systems->forget_tangents();
      systems->mass.reset();
      systems->odd_mass.reset();
      systems->solver.forget_forces();
    }
  }

  const RingElements& elements() const { return *elements_; }

  /// Returns the systems for more than one sector. The symbolic factorization is done at the first
  /// call, and repeated only if new materials make or break the symmetry.
  Systems& systems(bool halved, int window) {
    auto& systems = systems_[{halved, window}];
    if (!systems) {
      systems = std::make_unique<Systems>(
          ring, settings, halved ? mirror() : std::nullopt, half_angle(window), counts);
      ++counts.analyses;
    }
    return *systems;
  }
  /// Returns the permutation of a section's nodes under the half turn, if the tire is symmetric
  /// under it.
  const std::optional<std::vector<int>>& mirror() {
    if (!is_symmetry_known_) mirror_ = find_mirror(ring.mesh(), elements().materials());
    is_symmetry_known_ = true;
    return mirror_;
  }

  /// Returns the ring for inflation and unloaded modes, in which one sector represents all.
  const Ring& even_ring() const { return even ? *even : ring; }
  const RingElements& even_elements() const { return even ? *even_elements_ : *elements_; }

  /// Returns the index of the first window (part of the tread on which contact is computed) that is
  /// tried. If the result depends on the path (friction), or if a bar stands on the ground, the
  /// wide window 1 is used from the start and kept.
  static int first_window(const Ground& ground) {
    if (ground.held) return ground.held->window;
    return ground.mu > 0.0 || ground.bar ? 1 : 0;
  }
  /// Returns the index of the window (part of the tread on which contact is computed) for a path
  /// that starts at this state. Held points belong to one fixed window.
  static int window_from(const TireState& state) {
    return state.ground.held ? state.ground.held->window : state.window;
  }
  Result<TireState> move(const TireState& from, const GroundPose& pose, const std::string& name);
  Result<std::vector<Mode>> modes_at(const TireState& state, int count);
  /// Factorizes the tangents of even and odd motions about a state with its ground. Keeps the
  /// factorizations if this state was the last one factorized. Returns a Failure if the state is
  /// unstable, that is, if some small motion releases energy. Newton's method may find such
  /// equilibria.
  Status factorize(Systems& all, const TireState& state);
  /// Assembles only the tangent of even motions, the ground included. Returns a Failure if an
  /// element is inverted.
  Status assemble(Systems& all, const TireState& state, numerics::SymmetricMatrix& tangent);
  /// Factorizes the tangent about the state. Returns a Failure if it is not positive definite.
  Status factorize(const TireState& state,
                   const numerics::SymmetricMatrix& tangent,
                   numerics::Factorization& factor);

 private:
  // Half angles of the part of the tread that may touch, rad to both sides of the lowest point. At
  // a deflection of 8 % of its radius a tire touches flat ground up to 0.22 rad, half of the angle
  // at which the ground would cut a rigid circle. If the tread touches beyond this part, a part
  // wider by the factor kWider is used.
  static constexpr double kHalfAngle = 0.3, kHalfAngleOfWays = 0.4, kWider = 1.5;
  static double half_angle(int window) {
    return window == 0 ? kHalfAngle : kHalfAngleOfWays * std::pow(kWider, window - 1);
  }
  void add_ground(Systems& all,
                  const TreadSurface& tread,
                  const TireState& at,
                  const AssembledState& state,
                  numerics::SymmetricMatrix& tangent);
  std::optional<RingElements> elements_, even_elements_;  // elements of `ring` and of `even`
  std::map<std::pair<bool, int>, std::unique_ptr<Systems>> systems_;
  std::optional<std::vector<int>> mirror_;
  bool is_symmetry_known_ = false;
};

}  // namespace latsch::fe_tire
