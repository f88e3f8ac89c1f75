// SPDX-License-Identifier: Apache-2.0
// The patch of a rolling tire, linear about a steady state, for its responses (rolling_response.h,
// rolling_vibration.h): the tire condensed to the nodes below which the ground is, the contact
// (F.3) of harmonic_contact.h, and what moves the tread over the ground. On flat ground.
//
// Vectors are those of the ground's axes, which head as the wheel does in the state.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <memory>
#include <optional>

#include "base/result.h"
#include "models/fe_tire/analysis/condensed_tire.h"
#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/contact/tread_surface.h"
#include "models/fe_tire/ring/ring_elements.h"
#include "models/fe_tire/rolling/harmonic_contact.h"
#include "models/fe_tire/rolling/rolling_case.h"
#include "models/fe_tire/rolling/rolling_history.h"
#include "models/fe_tire/rolling/tread_body.h"
#include "models/fe_tire/rolling/tread_lines.h"
#include "numerics/sparse/factorization.h"
#include "numerics/sparse/symmetric_matrix.h"

namespace latsch::fe_tire {

/// A slip that changes. Units: angle, rad; spin, its relative change; turn, 1/m; camber, rad. Signs
/// are those of RollingCase.
enum class SlipInput { angle, spin, turn, camber };

/// Changes of the ground's force and moment on the tire by a unit of an input, for e^(+i omega t),
/// in the axes of RollingForces; moments about the contact center.
struct SlipResponse {
  Eigen::Vector3cd force;   // N
  Eigen::Vector3cd moment;  // N m
};

/// Returns a x b without conjugation, which Eigen applies to complex vectors.
Eigen::Vector3cd complex_cross(const Eigen::Vector3cd& a, const Eigen::Vector3cd& b);

class LinearPatch {
 public:
  /// Keeps a reference to the elements.
  LinearPatch(const RingElements& elements, TreadShape shape);
  LinearPatch(const LinearPatch&) = delete;
  LinearPatch& operator=(const LinearPatch&) = delete;

  /// Condenses the tire about the state, and finds the derivatives of its friction. `history`: none
  /// if the tire is elastic. Off the ground there are no rows and no points. A Failure says that an
  /// element is inverted or that the tire buckles.
  Status evaluate(const RollingState& state, RollingHistory* history);

  const RollingCase& of() const { return of_; }
  const TreadBody& body() const { return *body_; }
  HarmonicContact contact() const { return {*body_, input_, tractions_}; }
  /// K - Omega^2 W, and the stiffness T of the body's rows with all others eliminated.
  const numerics::SymmetricMatrix& K() const { return K_; }
  const Eigen::MatrixXd& T() const { return T_; }
  const RingElements& elements() const { return elements_; }
  const RingUnknowns& unknowns() const { return unknowns_; }
  const RingAssembly& assembly() const { return assembly_; }
  const TreadSurface& tread() const { return tread_; }
  Eigen::Index points() const { return x_.cols(); }
  bool touches(Eigen::Index point) const { return input_.p[point] > 0.0; }
  /// Places of the points, m, the forces on them, N, and the wheel and contact centers, m.
  const Eigen::Matrix3Xd& places() const { return x_; }
  const Eigen::Matrix3Xd& forces() const { return c_; }
  const Eigen::Vector3d& hub() const { return hub_; }
  const Eigen::Vector3d& center() const { return center_; }

  /// Returns the motion of points relative to the ground by a unit of a slip, if the tire does not
  /// answer.
  PointMotion motion_by(SlipInput slip) const;
  /// Returns the motion of the points if the wheel center moves by `d` (m) and the tire does not
  /// deform.
  PointMotion motion_along(const Eigen::Vector3d& d) const;
  /// Returns how a unit of a slip changes the residual on the body's rows besides the contact, N.
  /// Inertia of the change is not in it.
  Eigen::VectorXcd residual_by(SlipInput slip) const;
  /// Sums the changes of the forces at points if rows move by q and points by `besides`, while the
  /// contact center moves by `center`, m.
  SlipResponse measured(double omega,
                        const Eigen::VectorXcd& q,
                        const PointMotion& besides,
                        const Eigen::Vector3d& center) const;
  /// Returns the motion of the contact center if the wheel center rises over the ground by 1 m.
  Eigen::Vector3d center_by_rise() const;
  /// Returns forces on the body's rows from forces on all unknowns, N, with all others eliminated.
  Eigen::VectorXd condensed(Eigen::VectorXd forces) const;
  /// Returns forces on all unknowns from those on the body's rows, N.
  Eigen::VectorXd at_unknowns(const Eigen::VectorXd& forces) const;
  /// Returns the displacements of the body's rows, ground's axes, from those of all unknowns.
  Eigen::VectorXd at_rows(const Eigen::VectorXd& displacements) const;
  /// Returns a vector of the ground's axes in the wheel frame.
  Eigen::Vector3d to_wheel(const Eigen::Vector3d& v) const { return to_wheel_ * v; }

 private:
  void find_leaning(const Eigen::VectorXd& unknowns, const PosedGround& ground);

  const RingElements& elements_;
  RingUnknowns unknowns_;
  TreadSurface tread_;
  RingAssembly assembly_;
  TreadLines lines_;
  numerics::SymmetricMatrix K_;
  numerics::Factorization factor_;
  CondensedTire condensed_;
  RollingCase of_;
  std::optional<TreadBody> body_;
  Eigen::MatrixXd T_;        // in the ground's axes
  Eigen::VectorXd by_spin_;  // N, change of the residual on rows by a relative change of the spin
  RollingInput input_;
  GripTractions tractions_;
  Eigen::Matrix3Xd x_, c_;
  Eigen::Vector3d hub_, center_;
  Eigen::Matrix3d to_wheel_;
  /// Motion of the points over the ground, m, if the wheel leans by 1 rad about the line through
  /// the contact center along its heading.
  Eigen::Matrix3Xd leaning_;
};

}  // namespace latsch::fe_tire
