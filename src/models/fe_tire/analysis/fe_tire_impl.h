// SPDX-License-Identifier: Apache-2.0
// Internals of the tire, shared by its statics and modes (fe_tire.cpp) and their slopes
// (tire_slopes.cpp) only.
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

/// Everything that depends on the mesh, on whether half the ring represents all of it, and on how
/// much of the tread may touch. Even states carry the loading; even and odd ones together give all
/// loaded modes. If the whole ring is used, the `even` members are all there is.
struct Systems {
  RingUnknowns unknowns;
  TreadSurface tread;
  EquilibriumSolver solver;
  std::optional<RingUnknowns> odd_unknowns;
  std::optional<TreadSurface> odd_tread;
  std::optional<RingAssembly> odd;
  double half_angle;  // rad, half angle of the tread that may touch
  // Tangents about `factored`, of even and of odd motions. They have the same pattern.
  numerics::SymmetricMatrix tangent;
  std::optional<numerics::SymmetricMatrix> odd_tangent;
  numerics::Factorization factor;
  std::optional<numerics::Factorization> odd_factor;
  std::optional<TireState> factored;  // none: no state, or one with indefinite tangents
  std::optional<numerics::SymmetricMatrix> mass, odd_mass;  // masses of the materials, once needed
  std::optional<numerics::Davidson> search, odd_search;     // searches that found modes about
                                                            // `factored`

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
  Ring ring;                 // the ring pressed on the ground
  std::optional<Ring> even;  // all sectors equally wide; only if those of `ring` are not
  SolverSettings settings;
  SolverCounts counts;
  /// Called for every intermediate equilibrium on the path, while the solver's factorization
  /// belongs to a nearby state. The final state is returned, not reported here.
  std::function<void(Systems& all, const TireState& state)> on_passing;

  Impl(Mesh mesh, const Materials& materials, const SolverSettings& s)
      : ring(std::move(mesh), s.element), settings(s) {
    if (ring.widths() > 1) even.emplace(ring.mesh().evenly_divided(), s.element);
    set(materials);
  }

  void set(const Materials& materials) {
    elements_.emplace(ring, materials);
    if (even) even_elements_.emplace(*even, materials);
    is_symmetry_known_ = false;
    for (auto& [of, systems] : systems_) {
      systems->forget_tangents();
      systems->mass.reset();
      systems->odd_mass.reset();
      systems->solver.forget_forces();
    }
  }

  const RingElements& elements() const { return *elements_; }

  /// Returns the systems for more than one sector. Their symbolic work is done at the first call,
  /// and again only if new materials make or break the symmetry.
  Systems& systems(bool halved, int window) {
    auto& systems = systems_[{halved, window}];
    if (!systems) {
      systems = std::make_unique<Systems>(
          ring, settings, halved ? mirror() : std::nullopt, half_angle(window), counts);
      ++counts.analyses;
    }
    return *systems;
  }
  /// Returns the permutation of the section's nodes by the half turn, if the half turn is a
  /// symmetry.
  const std::optional<std::vector<int>>& mirror() {
    if (!is_symmetry_known_) mirror_ = find_mirror(ring.mesh(), elements().materials());
    is_symmetry_known_ = true;
    return mirror_;
  }

  /// Ring used for inflation and unloaded modes, where one sector represents all.
  const Ring& even_ring() const { return even ? *even : ring; }
  const RingElements& even_elements() const { return even ? *even_elements_ : *elements_; }

  /// Index of the first window tried. If the result depends on the path (friction), or if a bar
  /// stands out of the ground, the wide window 1 is used from the start and kept.
  static int first_window(const Ground& ground) {
    if (ground.held) return ground.held->window;
    return ground.mu > 0.0 || ground.bar ? 1 : 0;
  }
  /// Index of the window for a path that starts at a state: points that are held belong to one
  /// window.
  static int window_from(const TireState& state) {
    return state.ground.held ? state.ground.held->window : state.window;
  }
  Result<TireState> move(const TireState& from, const GroundPose& pose, const std::string& name);
  Result<std::vector<Mode>> modes_at(const TireState& state, int count);
  /// Factorizes the tangents of even and odd motions about a state with its ground; keeps the
  /// factors if the state is the one factorized last. Returns a Failure if the state is unstable,
  /// that is, if a motion about it releases energy. Newton's method finds such equilibria too.
  Status factorize(Systems& all, const TireState& state);
  /// Assembles only the tangent of even motions, the ground included. Returns a Failure if an
  /// element fails.
  Status assemble(Systems& all, const TireState& state, numerics::SymmetricMatrix& tangent);
  /// Returns a Failure if the tangent about the state is not positive definite.
  Status factorize(const TireState& state,
                   const numerics::SymmetricMatrix& tangent,
                   numerics::Factorization& factor);

 private:
  // Half angles of the tread that may touch, rad to both sides. At a deflection of 8 % of its
  // radius a tire touches flat ground 0.22 rad up, half as far as the ground cuts a circle. If the
  // tread touches beyond the angle, a window wider by the factor kWider is used.
  static constexpr double kHalfAngle = 0.3, kHalfAngleOfWays = 0.4, kWider = 1.5;
  static double half_angle(int window) {
    return window == 0 ? kHalfAngle : kHalfAngleOfWays * std::pow(kWider, window - 1);
  }
  void add_ground(Systems& all,
                  const TreadSurface& tread,
                  const TireState& at,
                  const AssembledState& state,
                  numerics::SymmetricMatrix& tangent);
  std::optional<RingElements> elements_, even_elements_;  // elements of `ring`, of `even`
  std::map<std::pair<bool, int>, std::unique_ptr<Systems>> systems_;
  std::optional<std::vector<int>> mirror_;
  bool is_symmetry_known_ = false;
};

}  // namespace latsch::fe_tire
