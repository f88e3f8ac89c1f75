// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/rolling_response.h"

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <optional>

#include "models/fe_tire/analysis/condensed_tire.h"
#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/motion/spin.h"
#include "models/fe_tire/ring/ring.h"
#include "models/fe_tire/rolling/harmonic_contact.h"
#include "models/fe_tire/rolling/rolling_forces.h"
#include "models/fe_tire/rolling/tread_lines.h"
#include "numerics/sparse/elimination.h"
#include "numerics/sparse/factorization.h"

namespace latsch::fe_tire {
namespace {

/// Height over the ground up to which points of the tread take part, m.
constexpr double kHighest = 1.5e-3;

GripState of_listed(const GripState& all, const std::vector<int>& points) {
  GripState part(static_cast<int>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    part.grip[k] = all.grip[points[k]];
    part.direction.col(i) = all.direction.col(points[k]);
  }
  return part;
}

}  // namespace

struct RollingResponse::Impl {
  Ring ring;
  RingElements elements;
  RingUnknowns unknowns;
  TreadSurface tread;
  RingAssembly assembly;
  TreadLines lines;
  RollingCase of;
  std::optional<TreadBody> body;
  Eigen::MatrixXd T;  // in the ground's axes
  RollingInput input;
  GripTractions tractions;

  Impl(const Mesh& mesh,
       const Materials& materials,
       const SolverSettings& settings,
       const RollingState& state)
      : ring(mesh, settings.element),
        elements(ring, materials),
        unknowns(ring, RingSymmetry::none, {}),
        tread(unknowns, settings.tread_shape(), kTouchingAngle),
        assembly(unknowns),
        lines(tread, ring.mesh()),
        of(state.of) {}
  Status evaluate(const RollingState& state);
};

/// Condenses the tire about the state, and finds the derivatives of its friction.
Status RollingResponse::Impl::evaluate(const RollingState& state) {
  AssembledState at{unknowns.compress(state.u), state.alpha};
  numerics::SymmetricMatrix K(*assembly.pattern());
  Eigen::VectorXd f;
  int worst = 0;
  if (!assembly.assemble(elements, at, state.pressure, f, &K, &worst))
    return Failure{"an element is inverted, " + ring.place(worst)};
  K.add(-of.spin * of.spin, flow_stiffness(assembly, elements));
  numerics::Factorization factor(*assembly.pattern(),
                                 numerics::Precision::full,
                                 std::make_shared<const numerics::Elimination>(
                                     numerics::eliminate(*assembly.pattern(), tread.block_rows())));
  if (!factor.condense(K).definite())
    return Failure{"the tangent of the rolling tire is not positive definite: the tire buckles"};
  const PosedGround ground({}, {.height = of.height, .camber = of.camber});
  const Eigen::Vector2d velocity =
      -of.speed * Eigen::Vector2d(std::cos(of.slip_angle), std::sin(of.slip_angle));
  const GroundMotion motion{velocity, of.turn_slip * of.speed, of.spin};
  const RollingSurface surface(of.curvature, -motion.velocity.normalized());
  body.emplace(
      tread, lines, ground, surface, kNormalPenalty, motion, tread.displacements(at.x), kHighest);
  if (body->rows().empty()) return Failure{"the tread of the rolling tire is off the ground"};
  CondensedTire condensed;
  if (!condensed.set(factor.condensed(), body->rows()))
    return Failure{"the tangent of the tread is not positive definite"};
  body->set(condensed.stiffness(), Eigen::VectorXd::Zero(std::ssize(body->rows())));
  T = body->stiffness();
  input = body->input(Eigen::VectorXd::Zero(body->size()));
  const RollingGrip grip(body->lines(), of.friction, kAlongPenalty);
  tractions = grip.tractions(
      input, of_listed(state.grip, body->points()), RollingGrip::Directions::of_trial, true);
  return {};
}

RollingResponse::RollingResponse(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RollingResponse::RollingResponse(RollingResponse&&) noexcept = default;
RollingResponse::~RollingResponse() = default;

Result<RollingResponse> RollingResponse::about(const Mesh& mesh,
                                               const Materials& materials,
                                               const SolverSettings& settings,
                                               const RollingState& state) {
  if (state.of.curvature != 0.0)
    return Failure{
        "the response of a tire that rolls on a drum is not computed: expected flat "
        "ground"};
  auto impl = std::make_unique<Impl>(mesh, materials, settings, state);
  if (const Status done = impl->evaluate(state); !done) return done.failure();
  return RollingResponse(std::move(impl));
}

SlipResponse RollingResponse::by_slip_angle(double frequency) const {
  const Impl& rolling = *impl_;
  const double omega = 2.0 * std::numbers::pi * frequency, V = rolling.of.speed;
  const HarmonicContact contact(*rolling.body, rolling.input, rolling.tractions);
  const auto points = std::ssize(rolling.body->points());
  // The wheel moves to the side with the velocity V alpha.
  Eigen::Matrix3Xcd moved = Eigen::Matrix3Xcd::Zero(3, points);
  moved.row(1).setConstant(V / std::complex<double>(0.0, omega));
  const Eigen::MatrixXcd Z = rolling.T.cast<std::complex<double>>() - contact.tangent(omega);
  const Eigen::VectorXcd q = Z.partialPivLu().solve(contact.forces_by(omega, {moved}).col(0));
  const Eigen::Matrix3Xcd forces = contact.point_forces(omega, q, moved);
  SlipResponse response{0.0, 0.0, 0.0};
  for (Eigen::Index k = 0; k < points; ++k) {
    response.Fx += forces(0, k);
    response.Fy += forces(1, k);
    const auto place = rolling.body->place(static_cast<int>(k), rolling.input);
    response.Mz += place.x() * forces(1, k) - place.y() * forces(0, k);
  }
  response.relaxation = -V / omega * response.Fy.imag() / response.Fy.real();
  return response;
}

}  // namespace latsch::fe_tire
