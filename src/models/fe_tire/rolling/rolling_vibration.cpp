// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/rolling_vibration.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <utility>

#include "models/fe_tire/contact/contact.h"
#include "models/fe_tire/motion/moving_inertia.h"
#include "models/fe_tire/motion/response_shapes.h"
#include "models/fe_tire/rolling/rolling_forces.h"
#include "models/fe_tire/rolling/rolling_response.h"

namespace latsch::fe_tire {

using Complex = std::complex<double>;

namespace {

using DrivenBy = VibrationInput::Of;

/// Loads of the tire, as columns: inertia of the six rigid motions, M T and Omega G T, that of a
/// spin that changes, Omega G' x for each 1/s of the relative change's rate, and its centrifugal
/// forces; then unit forces on points.
constexpr int kMassLoads = 0, kFlowLoads = 6, kEulerLoad = 12, kCentrifugalLoad = 13,
              kPointLoads = 14;

}  // namespace

struct RollingVibration::Impl {
  std::unique_ptr<LinearPatch> patch;
  double spin = 0.0;
  Eigen::MatrixXd S;                             // T + C_s on the rows
  Eigen::MatrixXd K_r, G_r, M_r;                 // projected on the shapes; G_r with Omega
  Eigen::MatrixXd Phi_B, V;                      // shapes at the rows, and S Phi_B
  Eigen::MatrixXd L_r;                           // work of the loads on the shapes [shapes x loads]
  Eigen::MatrixXd SX;                            // the loads, condensed to the rows
  Eigen::MatrixXd X_B, LX;                       // A^-1 L at the rows, and L' A^-1 L
  Eigen::Matrix<double, 6, 6> rigid_M, rigid_G;  // T' M T, T' Omega G T
  Eigen::Vector<double, 6> euler, centrifugal;   // sums of these loads over all nodes
  Eigen::MatrixXd point_motions;                 // m, of the points by rigid motions [points x 6]

  /// Motions and loads by an input.
  struct Drive {
    PointMotion motion;
    Eigen::VectorXcd residual;                         // N, on the rows
    Eigen::VectorXcd loads;                            // factors of the loads
    Eigen::Vector<Complex, 6> rigid, rigid_rate;       // motion of the wheel, and its velocity
    Complex spin = 0.0;                                // relative change
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  // m, motion of the contact center
    Eigen::Vector3d hub_to_center = Eigen::Vector3d::Zero();  // m, change of the way from the hub
  };

  void find_loads(const RollingState& state,
                  const std::vector<VibrationPoint>& points,
                  Eigen::MatrixXd& loads);
  Status find_shapes(const RollingState& state,
                     const VibrationSettings& settings,
                     const Eigen::MatrixXd& loads);
  Eigen::MatrixXd tractions() const;
  void project(const RollingState& state,
               const Eigen::MatrixXd& shapes,
               const numerics::SymmetricMatrix& A);
  Drive drive(const VibrationInput& input, double omega) const;
};

/// Finds the inertia of rigid motions and of a changing spin at all nodes.
void RollingVibration::Impl::find_loads(const RollingState& state,
                                        const std::vector<VibrationPoint>& points,
                                        Eigen::MatrixXd& loads) {
  const MovingInertia inertia(patch->elements());
  const RingUnknowns& unknowns = patch->unknowns();
  const Mesh& mesh = patch->elements().ring().mesh();
  const int n = mesh.nodes_per_sector();
  const Eigen::Matrix3Xd still = Eigen::Matrix3Xd::Zero(3, state.u.cols());
  const auto base = inertia.forces({state.u, still, still, spin, 0.0});
  loads.setZero(unknowns.size(), kPointLoads + std::ssize(points));
  point_motions.resize(std::ssize(points), 6);
  const auto take = [&](Eigen::Index column, const MovingInertia::Forces& forces) {
    loads.col(column) = unknowns.compress(forces.at_nodes - base.at_nodes);
    Eigen::Vector<double, 6> sum;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d axis = patch->to_wheel(Eigen::Vector3d::Unit(k));
      sum[k] = axis.dot(forces.force - base.force);
      sum[3 + k] = axis.dot(forces.moment - base.moment);
    }
    return sum;
  };
  for (int k = 0; k < 6; ++k) {
    const Eigen::Vector3d axis = patch->to_wheel(Eigen::Vector3d::Unit(k % 3));
    Eigen::Matrix3Xd T(3, state.u.cols());
    for (int s = 0; s < mesh.sectors; ++s) {
      const Eigen::Matrix3d frame = mesh.frame(s);
      for (int a = 0; a < n; ++a) {
        const int node = s * n + a;
        const Eigen::Vector3d x = frame * (mesh.X.col(a) + state.u.col(node));
        const Eigen::Vector3d moved = k < 3 ? axis : Eigen::Vector3d(axis.cross(x));
        for (std::size_t p = 0; p < points.size(); ++p)
          if (points[p].node == node)
            point_motions(static_cast<Eigen::Index>(p), k) = points[p].axis.dot(moved);
        T.col(node) = frame.transpose() * moved;
      }
    }
    rigid_M.col(k) = take(kMassLoads + k, inertia.forces({state.u, still, T, spin, 0.0}));
    rigid_G.col(k) = take(kFlowLoads + k, inertia.forces({state.u, T, still, spin, 0.0}));
  }
  euler = take(kEulerLoad, inertia.forces({state.u, still, still, spin, spin}));
  // Centrifugal forces change by twice the relative change of the spin; those of the sums vanish.
  loads.col(kCentrifugalLoad) = 2.0 * unknowns.compress(base.at_nodes);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = patch->to_wheel(Eigen::Vector3d::Unit(k));
    centrifugal[k] = 2.0 * axis.dot(base.force);
    centrifugal[3 + k] = 2.0 * axis.dot(base.moment);
  }
  for (std::size_t p = 0; p < points.size(); ++p) {
    const int plane = points[p].node / n;
    const auto at = unknowns.of_node(plane, points[p].node % n);
    if (at.first >= 0)
      loads.col(kPointLoads + static_cast<Eigen::Index>(p)).segment<3>(at.first) =
          mesh.frame(plane).transpose() * points[p].axis;
  }
}

/// Returns forces on all unknowns by tractions along x, y and z that vary in the patch as 1, x, y
/// and x^2.
Eigen::MatrixXd RollingVibration::Impl::tractions() const {
  constexpr int kVariations = 4;
  Eigen::MatrixXd all(patch->unknowns().size(), 0);
  if (patch->T().rows() == 0) return all;
  all.resize(Eigen::NoChange, 3 * kVariations);
  double length = 0.0;
  for (Eigen::Index k = 0; k < patch->points(); ++k)
    if (patch->touches(k))
      length = std::max(length, (patch->places().col(k) - patch->center()).head<2>().norm());
  for (int d = 0; d < 3; ++d) {
    for (int v = 0; v < kVariations; ++v) {
      Eigen::Matrix3Xcd forces = Eigen::Matrix3Xcd::Zero(3, patch->points());
      for (Eigen::Index k = 0; k < patch->points(); ++k) {
        if (!patch->touches(k)) continue;
        const Eigen::Vector3d from = (patch->places().col(k) - patch->center()) / length;
        const double by[kVariations] = {1.0, from.x(), from.y(), from.x() * from.x()};
        forces(d, k) = patch->body().area(static_cast<int>(k)) * by[v];
      }
      all.col(kVariations * d + v) = patch->at_unknowns(patch->contact().at_rows(forces).real());
    }
  }
  return all;
}

/// Projects the matrices on the shapes.
void RollingVibration::Impl::project(const RollingState& state,
                                     const Eigen::MatrixXd& shapes,
                                     const numerics::SymmetricMatrix& A) {
  const RingUnknowns& unknowns = patch->unknowns();
  const MovingInertia inertia(patch->elements());
  const Eigen::Index p = shapes.cols();
  Eigen::MatrixXd of(shapes.rows(), p);
  A.multiply(shapes, of);
  K_r = shapes.transpose() * of;
  const Eigen::Matrix3Xd still = Eigen::Matrix3Xd::Zero(3, state.u.cols());
  const Eigen::VectorXd base =
      unknowns.compress(inertia.forces({state.u, still, still, spin, 0.0}).at_nodes);
  Eigen::MatrixXd flow(shapes.rows(), p);
  for (Eigen::Index k = 0; k < p; ++k) {
    const Eigen::Matrix3Xd shape = unknowns.expand(shapes.col(k));
    of.col(k) =
        unknowns.compress(inertia.forces({state.u, still, shape, spin, 0.0}).at_nodes) - base;
    flow.col(k) =
        unknowns.compress(inertia.forces({state.u, shape, still, spin, 0.0}).at_nodes) - base;
  }
  M_r = shapes.transpose() * of;
  G_r = shapes.transpose() * flow;
  M_r = (0.5 * (M_r + M_r.transpose())).eval();
  G_r = (0.5 * (G_r - G_r.transpose())).eval();
  Phi_B.resize(patch->T().rows(), p);
  for (Eigen::Index k = 0; k < p; ++k) Phi_B.col(k) = patch->at_rows(shapes.col(k));
  V = S * Phi_B;
}

Status RollingVibration::Impl::find_shapes(const RollingState& state,
                                           const VibrationSettings& settings,
                                           const Eigen::MatrixXd& loads) {
  const Eigen::Vector3d stiffness(kAlongPenalty, kAlongPenalty, kNormalPenalty);
  numerics::SymmetricMatrix A = patch->K();
  std::vector<TreadContact::Touch> springs;
  Eigen::Matrix3d to_wheel;
  for (int k = 0; k < 3; ++k) to_wheel.col(k) = patch->to_wheel(Eigen::Vector3d::Unit(k));
  for (int k = 0; k < patch->points(); ++k) {
    if (!patch->touches(k)) continue;
    const Eigen::Matrix3d of =
        patch->body().area(k) * to_wheel * stiffness.asDiagonal() * to_wheel.transpose();
    springs.push_back(
        {patch->body().points()[k], Eigen::Vector3d::Zero(), of, Eigen::Matrix3d::Zero()});
  }
  add_stiffness(patch->tread(), springs, patch->assembly().first_cell(), A);
  S = patch->T() + patch->contact().springs(stiffness);
  numerics::Factorization factor(*patch->assembly().pattern());
  if (!factor.factorize(A).definite())
    return Failure{"the tangent of the rolling tire is not positive definite: the tire buckles"};
  const numerics::SymmetricMatrix M = patch->assembly().mass(patch->elements());
  auto modes = modes_up_to(settings.beyond * settings.highest, factor, M);
  if (!modes) return modes.failure();
  Eigen::MatrixXd shapes = *std::move(modes);
  const Eigen::MatrixXd of_patch = tractions();
  Eigen::MatrixXd X(loads.rows(), loads.cols() + of_patch.cols());
  X << loads, of_patch;
  factor.solve_columns(X);
  append_orthogonal(X, M, shapes);
  Eigen::MatrixXd further(X.rows(), X.cols());
  M.multiply(X, further);
  factor.solve_columns(further);
  append_orthogonal(further, M, shapes);
  project(state, shapes, A);
  const Eigen::Index count = loads.cols();
  L_r = shapes.transpose() * loads;
  LX = loads.transpose() * X.leftCols(count);
  X_B.resize(S.rows(), count);
  for (Eigen::Index k = 0; k < count; ++k) X_B.col(k) = patch->at_rows(X.col(k));
  SX = S * X_B;
  return {};
}

RollingVibration::Impl::Drive RollingVibration::Impl::drive(const VibrationInput& input,
                                                            double omega) const {
  const Complex iw(0.0, omega);
  Drive by{PointMotion::none(patch->points()),
           Eigen::VectorXcd::Zero(S.rows()),
           Eigen::VectorXcd::Zero(LX.rows()),
           Eigen::Vector<Complex, 6>::Zero(),
           Eigen::Vector<Complex, 6>::Zero()};
  const RollingCase& of = patch->of();
  switch (input.of) {
    case DrivenBy::angle:
      // The wheel moves to the side with this velocity, and its place does not matter.
      by.motion = patch->motion_by(SlipInput::angle);
      by.rigid_rate[1] = of.speed / std::cos(of.slip_angle);
      break;
    case DrivenBy::spin:
      by.motion = patch->motion_by(SlipInput::spin);
      by.spin = 1.0;
      break;
    case DrivenBy::camber: {
      const double aside = patch->hub().z() / std::pow(std::cos(of.camber), 2);
      by.motion = patch->motion_by(SlipInput::camber);
      by.residual = patch->residual_by(SlipInput::camber);
      by.rigid[3] = 1.0;
      by.rigid[1] = -aside;
      by.hub_to_center = Eigen::Vector3d(0.0, aside, 0.0);
      by.rigid_rate = iw * by.rigid;
      break;
    }
    case DrivenBy::wheel: {
      const Eigen::Vector3d d = Eigen::Vector3d::Unit(input.axis);
      by.motion = patch->motion_along(d);
      by.rigid[input.axis] = 1.0;
      by.rigid_rate = iw * by.rigid;
      by.center = input.axis < 2 ? d : patch->center_by_rise();
      if (input.axis == 2) by.hub_to_center = patch->center_by_rise() - d;
      break;
    }
    case DrivenBy::ground:
      by.motion = patch->motion_along(-Eigen::Vector3d::UnitZ());
      by.center = -patch->center_by_rise();
      by.hub_to_center = -(patch->center_by_rise() - Eigen::Vector3d::UnitZ());
      break;
    case DrivenBy::point:
      by.loads[kPointLoads + input.point] = 1.0;
      break;
  }
  // Inertia loads the tire against the motion.
  by.loads.segment<6>(kMassLoads) = -iw * by.rigid_rate;
  by.loads.segment<6>(kFlowLoads) = -by.rigid_rate;
  by.loads[kEulerLoad] = -iw * by.spin;
  by.loads[kCentrifugalLoad] = -by.spin;
  return by;
}

RollingVibration::RollingVibration(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}
RollingVibration::RollingVibration(RollingVibration&&) noexcept = default;
RollingVibration::~RollingVibration() = default;

int RollingVibration::shapes() const { return static_cast<int>(impl_->K_r.rows()); }

Result<RollingVibration> RollingVibration::about(const FeTire& tire,
                                                 const RollingState& state,
                                                 const VibrationSettings& settings,
                                                 const LossMaterials& losses,
                                                 const Inflated& round) {
  auto patch = RollingResponse::patch_about(tire, state, losses, round);
  if (!patch) return patch.failure();
  auto impl = std::make_unique<Impl>();
  impl->spin = state.of.spin;
  impl->patch = *std::move(patch);
  Eigen::MatrixXd loads;
  impl->find_loads(state, settings.points, loads);
  if (const Status done = impl->find_shapes(state, settings, loads); !done) return done.failure();
  return RollingVibration(std::move(impl));
}

std::vector<VibrationResponse> RollingVibration::at(
    double frequency, const std::vector<VibrationInput>& inputs) const {
  const Impl& tire = *impl_;
  const LinearPatch& patch = *tire.patch;
  const double omega = 2.0 * std::numbers::pi * frequency;
  const Eigen::Index rows = tire.S.rows(), p = tire.K_r.rows(), count = std::ssize(inputs);
  std::vector<Impl::Drive> drives;
  std::vector<PointMotion> motions;
  Eigen::MatrixXcd f(rows, count), loads(tire.LX.rows(), count);
  for (const VibrationInput& input : inputs) {
    drives.push_back(tire.drive(input, omega));
    motions.push_back(drives.back().motion);
    loads.col(std::ssize(drives) - 1) = drives.back().loads;
  }
  // The rows: Z w = V y + f + SX loads, with the static part of the shapes in Z.
  const HarmonicContact contact = patch.contact();
  Eigen::MatrixXcd of_shapes(rows, p), of_inputs(rows, count);
  if (rows > 0) {
    f = contact.forces_by(omega, motions);
    for (Eigen::Index k = 0; k < count; ++k) f.col(k) -= drives[k].residual;
    const Eigen::PartialPivLU<Eigen::MatrixXcd> Z(patch.T().cast<Complex>() -
                                                  contact.tangent(omega));
    of_shapes = Z.solve(tire.V.cast<Complex>());
    of_inputs = Z.solve(f + tire.SX * loads);
  }
  // The shapes: Z_r y = (K_r - Z_r) K_r^-1 Phi' (all forces on the tire on its springs).
  const Eigen::MatrixXcd dynamic =
      (omega * omega) * tire.M_r.cast<Complex>() - Complex(0.0, omega) * tire.G_r.cast<Complex>();
  const Eigen::MatrixXcd N =
      tire.K_r.ldlt().solve(dynamic.transpose().real()).transpose().cast<Complex>() +
      Complex(0.0, 1.0) *
          tire.K_r.ldlt().solve(dynamic.transpose().imag()).transpose().cast<Complex>();
  const Eigen::MatrixXcd to_shapes =
      tire.V.transpose() * of_shapes - tire.Phi_B.transpose() * tire.V;
  const Eigen::MatrixXcd forced = tire.V.transpose() * of_inputs -
                                  (tire.Phi_B.transpose() * tire.SX) * loads + tire.L_r * loads;
  const Eigen::MatrixXcd Z_r = tire.K_r.cast<Complex>() - dynamic - N * to_shapes;
  const Eigen::MatrixXcd y = Z_r.partialPivLu().solve(N * forced);
  const Eigen::MatrixXcd w = of_shapes * y + of_inputs;

  // Displacements of the loads' places: L' v, v = A^-1 (forces on the springs) + Phi y.
  const Eigen::MatrixXcd work = tire.X_B.transpose() * (tire.S * w - tire.V * y - tire.SX * loads) +
                                tire.LX * loads + tire.L_r.transpose() * y;
  const Complex iw(0.0, omega);
  const Eigen::Vector3d arm = patch.center() - patch.hub();
  const Eigen::Vector3d carried = patch.forces().rowwise().sum();
  std::vector<VibrationResponse> found;
  for (Eigen::Index k = 0; k < count; ++k) {
    const Impl::Drive& by = drives[k];
    VibrationResponse one{
        {Eigen::Vector3cd::Zero(), Eigen::Vector3cd::Zero()}, {}, {}, Eigen::VectorXcd()};
    if (rows > 0) one.patch = patch.measured(omega, w.col(k), by.motion, by.center);
    // Momentum of the tire: -G' is G, so that the flow's part changes its sign.
    const Eigen::Vector<Complex, 6> inertia =
        tire.rigid_M * (iw * by.rigid_rate) + tire.rigid_G * by.rigid_rate +
        (iw * by.spin) * tire.euler + by.spin * tire.centrifugal -
        (omega * omega) * work.col(k).segment<6>(kMassLoads) -
        iw * work.col(k).segment<6>(kFlowLoads);
    one.hub_force = one.patch.force - inertia.head<3>();
    one.hub_moment = one.patch.moment + complex_cross(arm.cast<Complex>(), one.patch.force) +
                     complex_cross(by.hub_to_center.cast<Complex>(), carried.cast<Complex>()) -
                     inertia.tail<3>();
    if (inputs[k].of == DrivenBy::point) {
      // The force itself is on the tire, too.
      const auto force = tire.point_motions.row(inputs[k].point).transpose();
      one.hub_force += force.head<3>().cast<Complex>();
      one.hub_moment += force.tail<3>().cast<Complex>();
    }
    one.points = work.col(k).tail(work.rows() - kPointLoads) + tire.point_motions * by.rigid;
    found.push_back(std::move(one));
  }
  return found;
}

}  // namespace latsch::fe_tire
