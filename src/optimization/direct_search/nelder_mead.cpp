// SPDX-License-Identifier: Apache-2.0
#include "optimization/direct_search/nelder_mead.h"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>

#include "optimization/problem/feasible_region.h"
#include "optimization/problem/infinity.h"
#include "optimization/problem/option_check.h"
#include "optimization/problem/pending_points.h"
#include "optimization/problem/point_vector.h"
#include "optimization/region/tangent_cone.h"

namespace latsch {
namespace {

struct Vertex {
  Eigen::VectorXd u;
  DesignPoint point;
  double f = kInfinity;
};

enum class SimplexPhase { simplex, reflection, expansion, contraction, ended };

void check(const NelderMeadOptions& options) {
  OptionCheck("Nelder-Mead").lengths(options.initial_step, options.step_tolerance, 0.5);
}

}  // namespace

struct NelderMead::State {
  DesignSpace space;
  FeasibleRegion region;
  NelderMeadOptions options;
  double beta, gamma, delta;

  SimplexPhase phase = SimplexPhase::simplex;
  std::vector<Vertex> known;     // vertices, best first once all are known
  PendingPoints<Vertex> wanted;  // vertices of the simplex, or the one trial point
  Eigen::VectorXd centroid;
  Vertex reflected;

  State(const DesignSpace& s, const NelderMeadOptions& o) : space(s), region(s), options(o) {
    const double n = std::max(2, space.size());
    beta = 1.0 + 2.0 / n;
    gamma = 0.75 - 0.5 / n;
    delta = 1.0 - 1.0 / n;
    const Eigen::VectorXd start = to_vector(space.to_unit(space.initial()));
    wanted.push_back(at(start));
    const Eigen::MatrixXd all = directions();
    for (const auto& direction : all.colwise()) wanted.push_back(beside(start, direction));
  }

  /// Returns the directions from the first vertex of the initial simplex to all others: the
  /// coordinate axes or, with equality constraints, a basis of the directions along these.
  Eigen::MatrixXd directions() const {
    if (region.E().rows() == 0) return Eigen::MatrixXd::Identity(space.size(), space.size());
    return tangent_cone(Eigen::MatrixXd(space.size(), 0), region.E().transpose()).lines;
  }

  /// Returns the vertex on that side of `start`, along the direction, where the constraints leave
  /// more room.
  Vertex beside(const Eigen::VectorXd& start, const Eigen::VectorXd& direction) const {
    const Vertex up = at(start + options.initial_step * direction);
    const Vertex down = at(start - options.initial_step * direction);
    return (down.u - start).norm() > 1.01 * (up.u - start).norm() ? down : up;
  }

  Vertex at(const Eigen::VectorXd& u) const {
    const Eigen::VectorXd inside = region.nearest(u);
    return {inside, space.from_unit({inside.begin(), inside.end()})};
  }

  const Vertex& best() const { return known.front(); }
  Vertex& worst() { return known.back(); }
  double second_worst() const { return known.size() > 1 ? known[known.size() - 2].f : best().f; }

  /// Chooses the next reflection, or ends the search. The values of all vertices are known then.
  void reflect() {
    const auto less = [](const Vertex& a, const Vertex& b) { return a.f < b.f; };
    std::stable_sort(known.begin(), known.end(), less);
    const bool is_small = std::all_of(known.begin(), known.end(), [&](const Vertex& v) {
      return (v.u - best().u).lpNorm<Eigen::Infinity>() < options.step_tolerance;
    });
    phase = is_small || best().f == kInfinity ? SimplexPhase::ended : SimplexPhase::reflection;
    if (phase == SimplexPhase::ended) return;
    centroid = Eigen::VectorXd::Zero(space.size());
    for (std::size_t i = 0; i + 1 < known.size(); ++i) centroid += known[i].u;
    centroid /= static_cast<double>(known.size() - 1);
    wanted = {at(centroid + (centroid - worst().u))};
  }

  void replace_worst(const Vertex& vertex) {
    worst() = vertex;
    reflect();
  }

  void take_reflection(const Vertex& r) {
    reflected = r;
    if (r.f < best().f) {
      phase = SimplexPhase::expansion;
      wanted = {at(centroid + beta * (r.u - centroid))};
    } else if (r.f < second_worst()) {
      replace_worst(r);
    } else {
      phase = SimplexPhase::contraction;
      const double side = r.f < worst().f ? 1.0 : -1.0;
      wanted = {at(centroid + side * gamma * (centroid - worst().u))};
    }
  }

  void shrink() {
    phase = SimplexPhase::simplex;
    wanted.clear();
    for (std::size_t i = 1; i < known.size(); ++i) {
      wanted.push_back(at(best().u + delta * (known[i].u - best().u)));
    }
    known.resize(1);
  }

  void take(const Vertex& tried) {
    switch (phase) {
      case SimplexPhase::simplex:
        known.push_back(tried);
        if (wanted.empty()) reflect();
        return;
      case SimplexPhase::reflection:
        return take_reflection(tried);
      case SimplexPhase::expansion:
        return replace_worst(tried.f < reflected.f ? tried : reflected);
      case SimplexPhase::contraction:
        return tried.f < std::min(reflected.f, worst().f) ? replace_worst(tried) : shrink();
      case SimplexPhase::ended:
        return;
    }
  }
};

NelderMead::NelderMead(const DesignSpace& space, const NelderMeadOptions& options) {
  check(options);
  state_ = std::make_unique<State>(space, options);
}

NelderMead::~NelderMead() = default;

std::vector<DesignPoint> NelderMead::propose(int count) const {
  assert(count >= 1);
  Plan plan(count);
  plan.add(state_->wanted);
  if (state_->phase == SimplexPhase::reflection) {  // expansion or contraction may follow
    const Eigen::VectorXd away = state_->centroid - state_->worst().u;
    plan.add(state_->at(state_->centroid - state_->gamma * away).point);
    plan.add(state_->at(state_->centroid + state_->beta * away).point);
    plan.add(state_->at(state_->centroid + state_->gamma * away).point);
  }
  return plan.points();
}

void NelderMead::observe(const DesignPoint& point, const Result<Score>& outcome) {
  std::optional<Vertex> tried = state_->wanted.take(point);
  if (!tried) return;
  tried->f = outcome ? outcome->value : kInfinity;
  state_->take(*tried);
}

bool NelderMead::converged() const { return state_->wanted.empty(); }

}  // namespace latsch
