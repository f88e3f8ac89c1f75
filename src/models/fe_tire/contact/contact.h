// SPDX-License-Identifier: Apache-2.0
// Tread on rigid ground: penalty in the normal direction, Coulomb friction along the ground.
//
// At every point of the tread's surface (tread_surface.h) with the distance g to the ground, its
// normal n and the reference area dA,
//   normal traction     p = -epsilon g            where g < 0, otherwise none               (C.1)
//                                                 (where points are held: of these, of any g)
//   tangential trial    t = -epsilon_t (1 - n n^T) (x - a)  from the anchor a it sticks to   (C.2)
//   Coulomb             |t| <= mu p; beyond it the point slips: t = mu p t / |t|, a follows (C.3)
// in the ground's axes: the ground carries the anchors along. A point that comes down within a step
// is anchored where it touched, on the straight way from where it was at the step's start,
//   a = x_0 + s (x - x_0),   s = g_0 / (g_0 - g),                                           (C.4)
// which holds it near where the step began: loading.h divides ways into short ones.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/contact/contact_patch.h"
#include "models/fe_tire/contact/ground.h"
#include "models/fe_tire/contact/tread_surface.h"
#include "numerics/sparse/symmetric_matrix.h"

namespace latsch::fe_tire {

/// What a point of the tread remembers of the ground.
struct Anchor {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // m, ground's axes
  bool holds = false;                            // in contact
  bool slid = false;                             // in the step that ended with the last equilibrium
  bool operator==(const Anchor&) const = default;
};

class TreadContact {
 public:
  /// A point in contact, wheel frame.
  struct Touch {
    int point;                  // of the surface
    Eigen::Vector3d force;      // N, on the tire
    Eigen::Matrix3d stiffness;  // N/m: minus the change of the force, its symmetric part
    Eigen::Matrix3d coupling;   // N/m: what is left of it, of sliding friction with pressure
  };

  TreadContact(const TreadSurface& tread, const Ground& ground);

  const TreadSurface& tread() const { return tread_; }
  const Ground& ground() const { return ground_; }
  bool has_friction() const { return ground_.mu > 0.0; }
  /// Whether forces depend on the heights of the tread's nodes over flat, level ground alone.
  bool is_by_height() const { return !has_friction() && !ground_.bar && pose_.camber == 0.0; }

  /// The equilibrium that the next steps start from.
  void start(const GroundPose& pose, const Eigen::VectorXd& x, std::vector<Anchor> anchors);
  /// The same of displacements of the tread's nodes (TreadSurface::displacements).
  void start(const GroundPose& pose, const Eigen::Matrix3Xd& u, std::vector<Anchor> anchors);
  /// The ground moves on; anchors stay those of the start.
  void move(const GroundPose& pose);
  const GroundPose& pose() const { return pose_; }

  /// Points in contact while the tread's nodes are displaced by u (TreadSurface::displacements).
  std::vector<Touch> touches(const Eigen::Matrix3Xd& u) const;
  /// The same points, all of them sticking where there is friction: for small motions about x.
  std::vector<Touch> stuck(const Eigen::VectorXd& x) const;
  /// Anchors of the equilibrium x, or of displacements u, that the step has ended with.
  std::vector<Anchor> anchors(const Eigen::VectorXd& x) const;
  std::vector<Anchor> anchors(const Eigen::Matrix3Xd& u) const;
  /// How deep in the ground the deepest point is, m; 0 where none is.
  double deepest(const Eigen::Matrix3Xd& u) const;
  /// Points that are no farther from the ground than `distance`, m, ascending; on held ground those
  /// that touch.
  std::vector<int> within(double distance, const Eigen::Matrix3Xd& u) const;

  /// The contact patch (of the whole ring) in the state x, an equilibrium whose anchors are those
  /// of the start.
  ContactPatch patch(const Eigen::VectorXd& x) const;
  /// Force (N) and moment about the wheel center (N m) on the tire there, of the whole ring, in the
  /// ground's axes but its yaw: z along its normal, x where the wheel heads.
  struct Sum {
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = force;
  };
  Sum sum(const Eigen::VectorXd& x) const;
  /// Whether a part of the tread that is no part of the surface is in the ground.
  bool misses(const Eigen::VectorXd& x) const;

 private:
  /// Whether a point at the distance g does.
  bool touches_at(int point, double g) const {
    return is_held_.empty() ? g < 0.0 : is_held_[point] != 0;
  }
  struct Traction {
    double p;                  // Pa per reference area
    Eigen::Vector3d t;         // ground's axes, likewise
    Eigen::Matrix3d dt;        // minus the symmetric tangent of t by x
    Eigen::Vector3d coupling;  // minus the derivative of t along the normal
    bool sticks;
  };
  Traction traction(const Eigen::Vector3d& q,
                    const PosedGround::Distance& at,
                    const Anchor& anchor,
                    double share) const;
  Anchor anchor_of(int point, const Eigen::Vector3d& q, double g, double* share) const;
  Touch touch_of(int point, const PosedGround::Distance& at, const Traction& on) const;

  const TreadSurface& tread_;
  Ground ground_;
  GroundPose pose_;
  PosedGround posed_;
  std::vector<char> is_held_;  // every point of the tread; empty where none is held
  std::vector<Anchor> anchors_;
  Eigen::Matrix3Xd start_;  // of the points, ground's axes; with friction
  std::vector<double> start_g_;
};

/// Of every cell of `tread`, whose points move by the same nodes.
std::vector<std::vector<const TreadContact::Touch*>> by_cells(
    const TreadSurface& tread, const std::vector<TreadContact::Touch>& touches);
/// f of the unknowns of `tread`, internal sign: minus what the ground does to the tire.
void add_forces(const TreadSurface& tread,
                const std::vector<TreadContact::Touch>& touches,
                Eigen::VectorXd& f);
/// The symmetric tangent, in the numbering of `tread` (of even or odd motions); its cells are the
/// elements of K's pattern from `first_cell` on.
void add_stiffness(const TreadSurface& tread,
                   const std::vector<TreadContact::Touch>& touches,
                   int first_cell,
                   numerics::SymmetricMatrix& K);

}  // namespace latsch::fe_tire
