// SPDX-License-Identifier: Apache-2.0
// The tire, linear about a state and condensed to the tread nodes below which the ground is, as a
// body that rolls (rolling_contact.h).
//
//   R(q) = T q + r - A^T(p n + t)(x_0 + A q) dA,     q: displacements of the nodes' unknowns
//
// T and r come from CondensedTire and are turned to the ground's axes, in which a point's position
// is a mean of its nodes' with scalar weights. On a drum, positions and tractions are those of the
// surface rolled out (rolling_surface.h) about each point's place at x_0. The pressure is the
// penalty (C.1). A point at the leading edge has the share of its step behind the height 0, with
// its derivative.
//
// A height that follows from a load and a spin that follows from a drive are unknowns behind q:
// the rise of the wheel center, m, and the relative change of the spin. Their equations,
//   Fz - load = 0,   (drive - asked)/(arm) = 0,
// border the Jacobian (tread_tangent.cpp).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "models/fe_tire/contact/ground.h"
#include "models/fe_tire/grip/rolling_contact.h"
#include "models/fe_tire/grip/rolling_surface.h"
#include "models/fe_tire/rolling/tread_lines.h"

namespace latsch::fe_tire {

/// Motion of the ground seen from the wheel center, in the ground's axes.
struct GroundMotion {
  Eigen::Vector2d velocity;  // m/s, below the wheel center
  double turn = 0.0;         // rad/s, about the vertical through the wheel center
  double spin = 0.0;         // rad/s, Omega of the tire
};

class TreadBody : public RollingBody {
 public:
  /// `u`: displacements of the tread's nodes; points higher than `near` (m) over the ground are
  /// left out.
  TreadBody(const TreadSurface& tread,
            const TreadLines& lines,
            const PosedGround& ground,
            const RollingSurface& surface,
            double penalty,
            const GroundMotion& motion,
            const Eigen::Matrix3Xd& u,
            double near);

  /// Rows of the nodes' unknowns (3 a node of the tread) on which the listed points depend,
  /// ascending.
  const std::vector<int>& rows() const { return rows_; }
  /// Points of the tread in the order of the lines.
  const std::vector<int>& points() const { return points_; }
  const RollingLines& lines() const { return lines_; }
  /// States what the points before the listed ones were when their material passed there, for a
  /// tire that is not in a steady state; `touched` is not used.
  void set_upstream(Upstream upstream) { upstream_ = std::move(upstream); }
  /// Sets T and r on rows(), in the axes of the nodes' unknowns.
  void set(Eigen::MatrixXd T, Eigen::VectorXd r);
  /// Returns T in the ground's axes.
  const Eigen::MatrixXd& stiffness() const { return T_; }

  RollingInput input(const Eigen::VectorXd& q) const override;
  Eigen::VectorXd residual(const Eigen::VectorXd& q,
                           const RollingInput& input,
                           const GripTractions& tractions) const override;
  bool solve(const Eigen::VectorXd& q,
             const RollingInput& input,
             const GripTractions& tractions,
             const Eigen::VectorXd& R,
             Eigen::VectorXd& dq) override;
  /// Returns the derivative of the residual. `tractions` has links.
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& q,
                           const RollingInput& input,
                           const GripTractions& tractions) const;
  /// Derivative of the ground's forces on nodes by their displacements.
  struct Part {
    std::vector<int> rows;  // among rows()
    Eigen::MatrixXd C;      // N/m, in the axes of the nodes' unknowns
  };
  /// Returns these derivatives, whose sum is that of the parts: one for all lines that depend on
  /// the same nodes, with the nodes of points that touch. `tractions` has links; neither a load nor
  /// a drive is asked for.
  std::vector<Part> by_nodes(const Eigen::VectorXd& q,
                             const RollingInput& input,
                             const GripTractions& tractions) const;
  double force_scale() const override { return scale_; }
  void set_force_scale(double scale) { scale_ = scale; }
  /// Asks for a load, N, and a moment of the drive, N m. Each that is asked for adds an unknown.
  void ask(std::optional<double> load, std::optional<double> drive);
  /// Number of unknowns: those of rows(), then rise and spin where they are open.
  int size() const;
  /// Returns q with a rise at which points touch, if the rise is open and none does.
  Eigen::VectorXd touching(Eigen::VectorXd q) const;
  /// Rise of the wheel center, m, and relative change of the spin.
  double rise(const Eigen::VectorXd& q) const { return load_ ? q[rise_at()] : 0.0; }
  double spin_change(const Eigen::VectorXd& q) const { return drive_ ? q[spin_at()] : 0.0; }

  /// Returns the displacements of rows() in the axes of the nodes' unknowns.
  Eigen::VectorXd to_nodes(const Eigen::VectorXd& q) const;
  /// Returns a vector on rows() in the axes of the ground.
  Eigen::VectorXd to_ground(const Eigen::VectorXd& at_nodes) const;
  /// Returns the ground's forces at rows(), N, in the same axes.
  Eigen::VectorXd forces(const RollingInput& input, const GripTractions& tractions) const;
  /// Returns the positions of all points of the tread on the surface rolled out at the start, m [3
  /// x points of the tread].
  const Eigen::Matrix3Xd& all_positions() const { return all_; }
  /// Returns the positions of the listed points on the surface rolled out, m [3 x points].
  Eigen::Matrix3Xd positions(const Eigen::VectorXd& q) const;
  double area(int k) const { return areas_[k]; }
  /// Returns the place of point k on the surface, m, and its force, N, in the ground's axes.
  Eigen::Vector3d place(int k, const RollingInput& input) const {
    return surface_.point(input.x.col(k));
  }
  Eigen::Vector3d force(int k, const RollingInput& input, const GripTractions& tractions) const {
    return areas_[k] * (turn_[k].transpose() *
                        Eigen::Vector3d(tractions.t(0, k), tractions.t(1, k), input.p[k]));
  }
  /// Time between successive planes' points, s, at point k.
  double time(int k) const { return lines_.time[k]; }

 private:
  /// Points of a line, the columns of q on which they depend, three a node, and the nodes' weights
  /// [points x nodes].
  struct Section {
    std::vector<int> columns;
    Eigen::MatrixXd w;
  };
  double height_before(Eigen::Index k, const Eigen::Matrix3Xd& x) const;
  static std::pair<int, int> acting(const RollingLines::Line& line, const RollingInput& input);
  Section touched_section(std::size_t first, std::size_t last, const RollingInput& input) const;
  int rise_at() const { return static_cast<int>(rows_.size()); }
  int spin_at() const { return rise_at() + (load_ ? 1 : 0); }
  double drive(const RollingInput& input, const GripTractions& tractions, double rise) const;
  void add_line(const TreadSurface& tread,
                const TreadLines& lines,
                const std::vector<int>& of,
                const Eigen::VectorXd& height,
                double near,
                std::vector<int>& place);
  Eigen::VectorXd forces_in_ground(const RollingInput& input, const GripTractions& tractions) const;
  class LineTangent;
  friend class HarmonicContact;

  RollingSurface surface_;
  GroundMotion motion_;
  double penalty_, scale_ = 1.0;
  std::optional<double> load_ = {}, drive_ = {};
  Eigen::Vector3d hub_, axis_;  // ground's axes
  Eigen::Matrix3d R_;           // turns a vector from the wheel frame to the ground's axes
  RollingLines lines_;
  std::vector<int> points_, rows_;
  std::vector<double> areas_, times_;
  Eigen::Matrix3Xd all_;  // positions of all points, without the offset of (T.1) along the ground
  Upstream upstream_;
  std::vector<Eigen::Vector3d> x_0_;   // those of the listed points
  std::vector<Eigen::Matrix3d> turn_;  // turns the ground's axes to the surface's at a point
  std::vector<Section> sections_;
  std::vector<Eigen::Matrix3d> turns_;  // turns each node's axes to the ground's
  Eigen::MatrixXd T_;
  Eigen::VectorXd r_;
};

}  // namespace latsch::fe_tire
