// SPDX-License-Identifier: Apache-2.0
#include "oracle_statics.h"

#include <simmath/LinearAlgebra.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace oracle {
namespace {

using namespace SimTK;

constexpr double kEnough = 1e-7;  // N, N m
constexpr int kIterations = 30;
// Step of the differences, m and rad: their error is of order 2 in the step, and their rounding
// noise is inversely proportional to it.
constexpr double kStep = 1e-7;

Vector forces(const Model& model, const State& state) {
  model.system().realize(state, Stage::Dynamics);
  Vector r(6 * model.bodies());
  for (int i = 0; i < model.bodies(); ++i) {
    const SpatialVec wrench = model.wrench(state, i);
    for (int k = 0; k < 3; ++k) {
      r[6 * i + k] = wrench[1][k];
      r[6 * i + 3 + k] = wrench[0][k];
    }
  }
  return r;
}

/// Moves a body by a displacement of its origin and then by a rotation vector, both in the ground's
/// axes.
void move(const Model& model, State& state, int i, const Vec3& travel, const Vec3& rotation) {
  const Transform at = model.body(i).getMobilizerTransform(state);
  const double angle = rotation.norm();
  const Rotation by = angle > 0.0 ? Rotation(angle, UnitVec3(rotation)) : Rotation();
  model.body(i).setQToFitTransform(state, Transform(by * at.R(), at.p() + travel));
}

Matrix jacobian(const Model& model, State state) {
  const int n = 6 * model.bodies();
  const Vector q = state.getQ();
  const auto forces_at = [&](int j, double by) {
    Vec3 travel(0), rotation(0);
    (j % 6 < 3 ? travel : rotation)[j % 3] = by;
    state.updQ() = q;
    model.system().realize(state, Stage::Position);
    move(model, state, j / 6, travel, rotation);
    return forces(model, state);
  };
  Matrix J(n, n);
  for (int j = 0; j < n; ++j)
    J.updCol(j) = (forces_at(j, kStep) - forces_at(j, -kStep)) / (2.0 * kStep);
  return J;
}

/// Returns a start state in which all bodies are lowered until the linear tires carry the load. If
/// the tires only touched the road, a central difference would combine a state with contact and one
/// without.
State start_of(const Model& model) {
  State state = model.at_rest();
  double stiffness = 0.0, down = 0.0;
  for (const TireData& tire : model.data().tires) stiffness += tire.stiffness;
  if (stiffness == 0.0) return state;
  for (const BodyData& body : model.data().bodies) down -= body.mass * model.data().gravity[2];
  for (const LoadData& load : model.data().loads) down -= load.force[2];
  model.system().realize(state, Stage::Position);
  for (int i = 0; i < model.bodies(); ++i) {
    move(model, state, i, Vec3(0, 0, -down / stiffness), Vec3(0));
    model.system().realize(state, Stage::Position);
  }
  return state;
}

}  // namespace

Statics solve_statics(const Model& model) {
  Statics found{start_of(model), 0.0, 0};
  for (double before = Infinity;; before = found.left, ++found.iterations) {
    const Vector r = forces(model, found.state);
    found.left = r.normInf();
    if (found.left <= kEnough && found.left > 0.5 * before)
      return found;  // converged to the limit of rounding
    if (!std::isfinite(found.left) || found.iterations == kIterations)
      throw std::runtime_error("no equilibrium: " + std::to_string(found.left) + " N are left");
    Vector x;
    FactorLU(jacobian(model, found.state)).solve(r, x);
    for (int i = 0; i < model.bodies(); ++i) {
      const Vec3 travel(x[6 * i], x[6 * i + 1], x[6 * i + 2]);
      const Vec3 rotation(x[6 * i + 3], x[6 * i + 4], x[6 * i + 5]);
      model.system().realize(found.state, Stage::Position);
      move(model, found.state, i, -travel, -rotation);
    }
  }
}

}  // namespace oracle
