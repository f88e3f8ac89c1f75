// SPDX-License-Identifier: Apache-2.0
// Contact of the tread with rigid ground: penalty in the normal direction, Coulomb friction along
// it.
//
// At every point of the tread's surface (tread_surface.h) with the distance g to the ground, its
// normal n and the reference area dA,
//   normal traction     p = -epsilon g            if g < 0, otherwise none                  (C.1)
//                                                 (held points: for any g; others none)
//   tangential trial    t = -epsilon_t (1 - n n^T) (x - a)  from the anchor a it sticks to   (C.2)
//   Coulomb             |t| <= mu p; beyond it the point slips: t = mu p t / |t|, a follows (C.3)
// in the ground's axes, so the ground carries the anchors along. A point that comes down within a
// step is anchored where it touched, on the straight path from its position x_0 at the step's
// start,
//   a = x_0 + s (x - x_0),   s = g_0 / (g_0 - g).                                           (C.4)
// This holds only near the step's start: loading.h divides paths into short steps.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/contact/contact_patch.h"
#include "models/fe_tire/contact/ground.h"
#include "models/fe_tire/contact/tread_surface.h"
#include "numerics/sparse/symmetric_matrix.h"

namespace latsch::fe_tire {

/// The contact history of a tread point.
struct Anchor {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // m, ground's axes
  bool holds = false;                            // in contact
  bool slid = false;                             // slid in the step that ended with the last
                                                 // equilibrium
  bool operator==(const Anchor&) const = default;
};

class TreadContact {
 public:
  /// A point in contact, wheel frame.
  struct Touch {
    int point;                  // N, on the tire
    Eigen::Vector3d force;      // N, on the tire
    Eigen::Matrix3d stiffness;  // N/m: minus the change of the force, its symmetric part
    Eigen::Matrix3d coupling;   // N/m: the remainder, from sliding friction that depends on
                                // pressure
  };

  TreadContact(const TreadSurface& tread, const Ground& ground);

  const TreadSurface& tread() const { return tread_; }
  const Ground& ground() const { return ground_; }
  bool has_friction() const { return ground_.mu > 0.0; }
  /// True if forces depend only on the heights of the tread's nodes over flat, level ground.
  bool is_by_height() const { return !has_friction() && !ground_.bar && pose_.camber == 0.0; }

  /// Sets the equilibrium from which the next steps start.
  void start(const GroundPose& pose, const Eigen::VectorXd& x, std::vector<Anchor> anchors);
  /// Sets the starting equilibrium by displacements of the tread's nodes
  /// (TreadSurface::displacements).
  void start(const GroundPose& pose, const Eigen::Matrix3Xd& u, std::vector<Anchor> anchors);
  /// Moves the ground; anchors remain those of the start.
  void move(const GroundPose& pose);
  const GroundPose& pose() const { return pose_; }

  /// Returns the points in contact with the tread's nodes displaced by u
  /// (TreadSurface::displacements).
  std::vector<Touch> touches(const Eigen::Matrix3Xd& u) const;
  /// Returns the points in contact, all sticking if there is friction, for small motions about x.
  std::vector<Touch> stuck(const Eigen::VectorXd& x) const;
  /// Returns the anchors of the equilibrium x, or displacements u, with which the step ended.
  std::vector<Anchor> anchors(const Eigen::VectorXd& x) const;
  std::vector<Anchor> anchors(const Eigen::Matrix3Xd& u) const;
  /// Returns the largest depth of a point in the ground, m; 0 if none is in it.
  double deepest(const Eigen::Matrix3Xd& u) const;
  /// Returns the points that are no farther from the ground than `distance`, m, ascending. On held
  /// ground these are the points that touch.
  std::vector<int> within(double distance, const Eigen::Matrix3Xd& u) const;

  /// Returns the contact patch (of the whole ring) in the state x, an equilibrium whose anchors are
  /// those of the start.
  ContactPatch patch(const Eigen::VectorXd& x) const;
  /// Force (N) on the tire and moment about the wheel center (N m) of the whole ring, in the
  /// ground's axes without its yaw: z along its normal, x in the wheel's heading.
  struct Sum {
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = force;
  };
  Sum sum(const Eigen::VectorXd& x) const;
  /// True if a part of the tread outside the surface is in the ground.
  bool misses(const Eigen::VectorXd& x) const;

 private:
  /// True if a point at the distance g touches.
  bool touches_at(int point, double g) const {
    return is_held_.empty() ? g < 0.0 : is_held_[point] != 0;
  }
  struct Traction {
    double p;                  // Pa per reference area
    Eigen::Vector3d t;         // Pa per reference area, ground's axes
    Eigen::Matrix3d dt;        // minus the symmetric derivative of t with respect to x
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
  std::vector<char> is_held_;  // for every point of the tread; empty if none is held
  std::vector<Anchor> anchors_;
  Eigen::Matrix3Xd start_;  // positions of the points, ground's axes; only with friction
  std::vector<double> start_g_;
};

/// Groups touches by the cells of `tread`, whose points depend on the same nodes.
std::vector<std::vector<const TreadContact::Touch*>> by_cells(
    const TreadSurface& tread, const std::vector<TreadContact::Touch>& touches);
/// Adds minus the ground's forces on the tire to f, which holds internal forces in the numbering of
/// `tread`.
void add_forces(const TreadSurface& tread,
                const std::vector<TreadContact::Touch>& touches,
                Eigen::VectorXd& f);
/// Adds the symmetric tangent in the numbering of `tread` (of even or odd motions). Its cells are
/// the elements of K's pattern from `first_cell` on.
void add_stiffness(const TreadSurface& tread,
                   const std::vector<TreadContact::Touch>& touches,
                   int first_cell,
                   numerics::SymmetricMatrix& K);

}  // namespace latsch::fe_tire
