// SPDX-License-Identifier: Apache-2.0
// What a tire is made of inside: shared by its statics, its modes (fe_tire.cpp) and their slopes
// (tire_slopes.cpp), and by nobody else.
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

/// All that depends on the mesh, on whether half the ring stands for all of it, and on how much of
/// the tread may touch. Even states carry the loading; even and odd ones together all loaded modes.
/// Of the whole ring `even` is all there is.
struct Systems {
  RingUnknowns unknowns;
  TreadSurface tread;
  EquilibriumSolver solver;
  std::optional<RingUnknowns> odd_unknowns;
  std::optional<TreadSurface> odd_tread;
  std::optional<RingAssembly> odd;
  double half_angle;  // rad, of the tread that may touch
  // Of tangents about `factored`, of even and odd motions: they have the same pattern.
  numerics::SymmetricMatrix tangent;
  std::optional<numerics::SymmetricMatrix> odd_tangent;
  numerics::Factorization factor;
  std::optional<numerics::Factorization> odd_factor;
  std::optional<TireState> factored;  // none: no state, or one whose tangents are not definite
  std::optional<numerics::SymmetricMatrix> mass, odd_mass;  // of the materials, where asked for
  std::optional<numerics::Davidson> search, odd_search;     // how modes about `factored` were found

  Systems(const Ring& ring,
          const SolverSettings& settings,
          const std::optional<std::vector<int>>& mirror,
          double angle)
      : unknowns(ring,
                 mirror ? RingSymmetry::even : RingSymmetry::none,
                 mirror ? *mirror : std::vector<int>()),
        tread(unknowns, settings.tread_shape(), angle),
        solver(unknowns, tread, settings),
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
  Ring ring;                 // pressed on the ground
  std::optional<Ring> even;  // all sectors equally wide, where those of `ring` are not
  SolverSettings settings;
  SolverCounts counts;
  /// Is told every state that a way passes, but the last, while the solver is near it.
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

  /// Symbolic work, for whoever needs more than one sector; done again only where new materials
  /// make or break the symmetry.
  Systems& systems(bool halved, int window) {
    auto& systems = systems_[{halved, window}];
    if (!systems) {
      systems = std::make_unique<Systems>(
          ring, settings, halved ? mirror() : std::nullopt, half_angle(window));
      systems->solver.count_in(counts);
      ++counts.analyses;
    }
    return *systems;
  }
  /// What the half turn makes of the section's nodes, where it is a symmetry.
  const std::optional<std::vector<int>>& mirror() {
    if (!is_symmetry_known_) mirror_ = find_mirror(ring.mesh(), elements().materials());
    is_symmetry_known_ = true;
    return mirror_;
  }

  /// What inflation and unloaded modes see: one sector stands for the ring.
  const Ring& even_ring() const { return even ? *even : ring; }
  const RingElements& even_elements() const { return even ? *even_elements_ : *elements_; }

  /// Where the way is part of the answer the window stays as it is, and a bar stands out.
  static int first_window(const Ground& ground) {
    if (ground.held) return ground.held->window;
    return ground.mu > 0.0 || ground.bar ? 1 : 0;
  }
  /// Of what goes on from a state: the points that are held are those of one window.
  static int window_from(const TireState& state) {
    return state.ground.held ? state.ground.held->window : state.window;
  }
  Result<TireState> move(const TireState& from, const GroundPose& pose, const std::string& name);
  Result<std::vector<Mode>> modes_at(const TireState& state, int count);
  /// The factors of the tangents about a state with its ground, of even and odd motions; those of
  /// the state before, where it is the same. A Failure where the tire does not keep that state: a
  /// motion about it gives energy. Newton's method finds such equilibria just as well.
  std::optional<Failure> factorize(Systems& all, const TireState& state);
  /// The tangent of even motions alone, the ground included, wherever it is wanted; a Failure where
  /// there is none.
  std::optional<Failure> assemble(Systems& all,
                                  const TireState& state,
                                  numerics::SymmetricMatrix& tangent);
  /// A Failure where that tangent about the state is not definite.
  std::optional<Failure> factorize(const TireState& state,
                                   const numerics::SymmetricMatrix& tangent,
                                   numerics::Factorization& factor);

 private:
  // rad to both sides. A tire touches flat ground 0.22 rad up at 8 % of its radius, half as far as
  // a circle is cut there. What is touched beyond needs a wider window.
  static constexpr double kHalfAngle = 0.3, kHalfAngleOfWays = 0.4, kWider = 1.5;
  static double half_angle(int window) {
    return window == 0 ? kHalfAngle : kHalfAngleOfWays * std::pow(kWider, window - 1);
  }
  void add_ground(Systems& all,
                  const TreadSurface& tread,
                  const TireState& at,
                  const RingState& state,
                  numerics::SymmetricMatrix& tangent);
  std::optional<RingElements> elements_, even_elements_;  // of `ring`, of `even`
  std::map<std::pair<bool, int>, std::unique_ptr<Systems>> systems_;
  std::optional<std::vector<int>> mirror_;
  bool is_symmetry_known_ = false;
};

}  // namespace latsch::fe_tire
