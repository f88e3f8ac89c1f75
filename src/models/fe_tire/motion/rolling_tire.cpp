// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/motion/rolling_tire.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "models/fe_tire/analysis/condensed_tire.h"
#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/motion/tread_body.h"
#include "numerics/sparse/elimination.h"
#include "numerics/sparse/factorization.h"

namespace latsch::fe_tire {
namespace {

/// Half angle of the tread that may touch, rad: flat ground below a tire pressed by 8 % of its
/// radius reaches to 0.22 rad.
constexpr double kReach = 0.4;
/// Height over the ground up to which points take part in an iteration, m. A larger one costs
/// larger dense matrices, a smaller one more iterations.
constexpr double kNear = 1.5e-3;
/// Penalties, Pa/m: normal as at rest; along the ground stiffer than the tread (G/h is some 1e8
/// Pa/m) by two decades, so its spring in series takes some percent of a slip stiffness. With 1e12
/// the active set does not settle, because the points outnumber the nodes.
constexpr double kNormal = 2e10, kAlong = 1e10;
/// Residual of a state, relative to the ground's load.
constexpr double kAccepted = 1e-7;
constexpr int kMostIterations = 30;
/// Speed of rotation of a locked wheel, relative to rolling: (F.1) needs a flow, however slow.
constexpr double kLocked = 1e-6;

}  // namespace

struct RollingTire::Impl {
  Ring ring;
  RingElements elements;
  RingUnknowns unknowns;
  TreadSurface tread;
  RingAssembly assembly;
  numerics::Factorization factor;
  numerics::SymmetricMatrix K;
  TreadLines lines;

  Impl(const FeTire& tire, ElementKind element)
      : ring(tire.mesh(), element),
        elements(ring, tire.materials()),
        unknowns(ring, RingSymmetry::none, {}),
        tread(unknowns, TreadShape::smooth, kReach),
        assembly(unknowns),
        factor(*assembly.pattern(),
               numerics::Precision::full,
               std::make_shared<const numerics::Elimination>(
                   numerics::eliminate(*assembly.pattern(), tread.block_rows()))),
        K(*assembly.pattern()),
        lines(tread, ring.mesh()) {}

  /// Forces at the tread's nodes, of three rows a node.
  Eigen::VectorXd at_nodes(const Eigen::VectorXd& v) const {
    Eigen::VectorXd at(3 * tread.nodes());
    for (int a = 0; a < tread.nodes(); ++a)
      at.segment<3>(3 * a) = v.segment<3>(3 * tread.block_rows()[a]);
    return at;
  }

  /// One iteration's linear tire below which the ground moves: returns false if it buckles.
  bool condense(const Eigen::VectorXd& g, TreadBody& body, Eigen::VectorXd& eliminated);
  void expand(const Eigen::VectorXd& q, Eigen::VectorXd& eliminated);

  CondensedTire condensed;
  Eigen::VectorXd nodes;  // eliminated right-hand side at the tread's nodes
};

bool RollingTire::Impl::condense(const Eigen::VectorXd& g,
                                 TreadBody& body,
                                 Eigen::VectorXd& eliminated) {
  if (!factor.condense(K).definite()) return false;
  eliminated = g;
  factor.reduce(eliminated);
  nodes = at_nodes(eliminated);
  if (!condensed.set(factor.condensed(), body.rows())) return false;
  Eigen::VectorXd r = condensed.reduce(nodes);
  const Eigen::Index m = r.size();
  Eigen::MatrixXd T(m, m);
  for (Eigen::Index k = 0; k < m; ++k) T.col(k) = condensed.multiply(Eigen::VectorXd::Unit(m, k));
  body.set(std::move(T), std::move(r));
  return true;
}

/// Finds the decrease of all unknowns from the displacements q of the nodes within reach.
void RollingTire::Impl::expand(const Eigen::VectorXd& q, Eigen::VectorXd& eliminated) {
  condensed.expand(-q, nodes);
  for (int a = 0; a < tread.nodes(); ++a)
    eliminated.segment<3>(3 * tread.block_rows()[a]) = nodes.segment<3>(3 * a);
  factor.expand(eliminated);
}

RollingTire::RollingTire(FeTire& tire, ElementKind element)
    : tire_(tire), impl_(std::make_unique<Impl>(tire, element)) {}
RollingTire::~RollingTire() = default;

Result<RollingState> RollingTire::press(const Inflated& inflated, double height) {
  const auto states = tire_.advance(tire_.over(inflated, {}, FeTire::Poses::any),
                                    {FeTire::below(inflated, inflated.radius - height)});
  if (!states) return states.failure();
  const TireState& pressed = states->back();
  RollingState state;
  state.of.height = height;
  state.of.has_friction = false;
  state.pressure = inflated.pressure;
  state.u = pressed.u;
  state.alpha = pressed.alpha;
  state.grip = GripState(static_cast<int>(std::ssize(impl_->tread.points())));
  state.forces.force = tire_.stand(pressed).force;
  return state;
}

namespace {

/// States of the listed points among those of all.
GripState listed(const GripState& all, const std::vector<int>& points) {
  GripState part(static_cast<int>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    part.grip[k] = all.grip[points[k]];
    part.direction.col(static_cast<Eigen::Index>(k)) = all.direction.col(points[k]);
    part.speed[static_cast<Eigen::Index>(k)] = all.speed[points[k]];
  }
  return part;
}

void put_back(const RollingContactState& found, const std::vector<int>& points, GripState& all) {
  std::ranges::fill(all.grip, Grip::none);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    all.grip[points[k]] = found.state.grip[k];
    all.direction.col(points[k]) = found.state.direction.col(i);
    all.speed[points[k]] = found.tractions.w.col(i).norm();
  }
}

}  // namespace

Result<RollingState> RollingTire::roll(const RollingState& from, const RollingCase& of) {
  Impl& tire = *impl_;
  const double rolling = of.speed * std::cos(of.slip_angle) / of.height;
  if (!(of.speed > 0.0) || of.spin < 0.0)
    return Failure{fmt::format(
        "rolling: the wheel has a speed of {:.4g} m/s and turns at {:.4g} rad/s; expected a speed "
        "above 0 and forward rotation",
        of.speed,
        of.spin)};
  const PosedGround ground({}, {.height = of.height, .camber = of.camber});
  const Eigen::Vector2d V =
      of.speed * Eigen::Vector2d(std::cos(of.slip_angle), std::sin(of.slip_angle));
  const GroundMotion motion{-V, of.turn_slip * of.speed, std::max(of.spin, kLocked * rolling)};
  RollingFriction friction = of.friction;
  if (!of.has_friction) friction = {.at_rest = 0.0};
  RollingState state = from;
  state.of = of;
  state.passes = 0;
  AssembledState now{tire.unknowns.compress(from.u), from.alpha};
  const double load = std::max(std::abs(from.forces.force.z()), 1.0);
  Eigen::VectorXd g, d;
  int worst = 0;
  for (int iteration = 0;; ++iteration) {
    if (!tire.assembly.assemble(tire.elements, now, state.pressure, g, &tire.K, &worst))
      return Failure{"rolling: an element is inverted, " + tire.ring.place(worst)};
    TreadBody body(
        tire.tread, tire.lines, ground, kNormal, motion, tire.tread.displacements(now.x), kNear);
    if (body.rows().empty())
      return Failure{
          fmt::format("rolling: the tread is off the ground, {:.4g} mm below the wheel "
                      "center",
                      1e3 * of.height)};
    body.set_force_scale(load);
    const RollingGrip grip(body.lines(), friction, kAlong);
    GripState states = listed(state.grip, body.points());
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(std::ssize(body.rows()));
    if (iteration > 0) {
      // The residual with the states of the last iteration decides.
      const RollingInput input = body.input(zero);
      const GripTractions t = grip.tractions(input, states, RollingGrip::Directions::kept, false);
      Eigen::VectorXd f = g;
      const Eigen::VectorXd c = body.forces(input, t);
      for (std::size_t k = 0; k < body.rows().size(); ++k) {
        const int row = body.rows()[k];
        f[3 * tire.tread.block_rows()[row / 3] + row % 3] -= c[static_cast<Eigen::Index>(k)];
      }
      state.residual = f.norm();
      state.iterations = iteration;
      if (state.residual <= kAccepted * load) {
        measure(body, input, states, t, state);
        state.u = tire.unknowns.expand(now.x);
        state.alpha = now.alpha;
        return state;
      }
      if (iteration >= kMostIterations)
        return Failure{fmt::format(
            "rolling: not in equilibrium after {} iterations; residual {:.3g} N, accepted {:.3g} N",
            iteration,
            state.residual,
            kAccepted * load)};
    }
    if (!tire.condense(g, body, d))
      return Failure{"rolling: the tangent of the tire is not positive definite; it buckles"};
    const auto found = fe_tire::roll(body, grip, zero, states);
    if (!found) return found.failure();
    state.passes += found->passes;
    put_back(*found, body.points(), state.grip);
    tire.expand(found->q, d);
    now.x -= d;
  }
}

void RollingTire::measure(const TreadBody& body,
                          const RollingInput& input,
                          const GripState& states,
                          const GripTractions& t,
                          RollingState& state) {
  const PosedGround ground({}, {.height = state.of.height, .camber = state.of.camber});
  const Eigen::Vector3d hub = ground.in_ground(Eigen::Vector3d::Zero());
  const Eigen::Vector3d axis = ground.in_ground(Eigen::Vector3d::UnitY()) - hub;
  const Eigen::Vector3d below(hub.x(), hub.y(), 0.0);
  state.forces = {};
  state.patch.clear();
  for (Eigen::Index k = 0; k < input.p.size(); ++k) {
    if (!(input.p[k] > 0.0)) continue;
    const double area = body.area(static_cast<int>(k));
    const Eigen::Vector3d force = area * Eigen::Vector3d(t.t(0, k), t.t(1, k), input.p[k]);
    const Eigen::Vector3d at(input.x(0, k), input.x(1, k), -input.p[k] / kNormal);
    state.forces.force += force;
    state.forces.moment += (at - below).cross(force);
    state.forces.spin_moment += axis.dot((at - hub).cross(force));
    state.forces.friction_power -= area * t.t.col(k).dot(t.w.col(k));
    state.patch.push_back({at.x() - hub.x(),
                           at.y() - hub.y(),
                           input.p[k],
                           t.t(0, k),
                           t.t(1, k),
                           t.w(0, k),
                           t.w(1, k),
                           area,
                           states.grip[k] == Grip::sticks});
  }
}

}  // namespace latsch::fe_tire
