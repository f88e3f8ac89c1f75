// SPDX-License-Identifier: Apache-2.0
#include "passage_energy.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/grip/passing_bar.h"
#include "models/fe_tire/motion/moving_inertia.h"
#include "models/fe_tire/motion/spin.h"
#include "models/fe_tire/passage/rolling_transient.h"
#include "models/fe_tire/rolling/rolling_forces.h"
#include "models/fe_tire/rolling/rolling_tire.h"
#include "models/fe_tire/rolling/tread_lines.h"

namespace latsch::verification {
namespace {

using namespace latsch::fe_tire;

/// Half angle of the tread beyond which the patch and the cleat do not reach, rad.
constexpr double kReach = 0.35;

template <class Value>
Value value_or_throw(Result<Value> result) {
  if (!result) throw std::runtime_error(result.failure().reason);
  return *std::move(result);
}

/// H of (V.7) of a tire, with assemblies of its own.
class Energy {
 public:
  Energy(const TireDescription& tire, double pressure, double height, double spin)
      : ring_(build_mesh(tire), tire.element),
        elements_(ring_, build_materials(tire)),
        unknowns_(ring_, RingSymmetry::none, {}),
        assembly_(unknowns_),
        tread_(unknowns_, SolverSettings{.element = tire.element}.tread_shape(), kTouchingAngle),
        inertia_(elements_),
        pressure_(pressure),
        height_(height),
        spin_(spin) {}

  /// Returns H less that of the displacements `from` at rest, J.
  double above(const Eigen::Matrix3Xd& from,
               const Eigen::Matrix3Xd& u,
               const Eigen::Matrix3Xd& rates) {
    // Five points of Gauss on [0, 1].
    static constexpr std::array<double, 5> kAt = {
        0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842, 0.953089922969332};
    static constexpr std::array<double, 5> kShare = {0.118463442528095,
                                                     0.239314335249683,
                                                     0.284444444444444,
                                                     0.239314335249683,
                                                     0.118463442528095};
    const Eigen::VectorXd step = unknowns_.compress(u - from);
    double work = 0.0;
    for (std::size_t k = 0; k < kAt.size(); ++k) {
      const Eigen::Matrix3Xd at = from + kAt[k] * (u - from);
      AssembledState state = assembly_.zero_state();
      state.x = unknowns_.compress(at);
      Eigen::VectorXd f;
      int worst = 0;
      if (!assembly_.assemble(elements_, state, pressure_, f, nullptr, &worst))
        throw std::runtime_error("an element is inverted on the way between two states");
      f -= spin_ * spin_ * flow_forces(unknowns_, elements_, at);
      work += kShare[k] * f.dot(step);
    }
    return work + 0.5 * inertia_.twice_kinetic(rates) + pressed(u) - pressed(from);
  }

 private:
  /// Returns the energy of the ground's penalty, J.
  double pressed(const Eigen::Matrix3Xd& u) const {
    const Eigen::VectorXd x = unknowns_.compress(u);
    const Eigen::Matrix3Xd at = tread_.points_at(tread_.positions(tread_.displacements(x)));
    double energy = 0.0;
    for (Eigen::Index k = 0; k < at.cols(); ++k) {
      const double depth = std::max(0.0, -(at(2, k) + height_));
      energy += 0.5 * kNormalPenalty * depth * depth * tread_.points()[k].dA;
    }
    return energy;
  }

  Ring ring_;
  RingElements elements_;
  RingUnknowns unknowns_;
  RingAssembly assembly_;
  TreadSurface tread_;
  MovingInertia inertia_;
  double pressure_, height_, spin_;
};

}  // namespace

PassageEnergy energy_after_cleat(const TireDescription& description, const EnergyPassage& passage) {
  FeTire tire(description);
  const Inflated inflated = value_or_throw(tire.inflate(description.pressure));
  const auto pressed = value_or_throw(tire.advance(tire.over(inflated, {}, FeTire::Poses::any),
                                                   {FeTire::below(inflated, passage.deflection)}));
  RollingTire rolling(tire);
  RollingCase of = rolling.start(pressed.back()).of;
  of.speed = passage.speed;
  of.spin = passage.speed / of.height;
  of.friction.at_rest = 0.0;
  const RollingState steady = value_or_throw(rolling.roll(rolling.start(pressed.back()), of));
  RollingTransient transient(tire);
  const double smooth = inflated.radius * tire.mesh().angle(1);
  const double length = passage.length;
  const GroundWithBar bar({.height = passage.height, .length = length, .smooth = smooth});
  value_or_throw(
      transient.start(steady, {.step = passage.step, .rho = passage.rho, .enough = 1e-7}));
  Energy energy(description, description.pressure, steady.of.height, steady.of.spin);
  const double reach = std::sin(kReach) * inflated.radius + 0.5 * length + smooth;
  const long leaves = std::lround(2.0 * reach / passage.speed / passage.step);
  const long steps = leaves + std::lround(passage.after / passage.step);
  PassageEnergy record;
  for (long k = 1; k <= steps; ++k) {
    const double way = passage.speed * passage.step * static_cast<double>(k);
    value_or_throw(
        transient.advance({.of = steady.of, .ground = &bar, .place = {.way = {way - reach, 0.0}}}));
    if (k > leaves)
      record.H.push_back(energy.above(steady.u, transient.displacements(), transient.rates()));
  }
  return record;
}

double drift(const PassageEnergy& record) {
  const std::size_t half = record.H.size() / 2;
  double first = 0.0, second = 0.0;
  for (std::size_t k = 0; k < half; ++k) {
    first += record.H[k];
    second += record.H[half + k];
  }
  return (second - first) / (0.5 * (first + second));
}

}  // namespace latsch::verification
