// SPDX-License-Identifier: Apache-2.0
// Contact of the tread with rigid ground: penalty in the normal direction, Coulomb friction along
// it.
//
// At every point of the tread's surface (tread_surface.h) with the distance g to the ground, its
// normal n and the reference area dA,
//   normal traction     p = -epsilon g            if g < 0, otherwise none                  (C.1)
//                                              (held points: for any g; other points: none)
//   tangential trial    t = -epsilon_t (1 - n n^T) (x - a)  a: anchor, where it sticks       (C.2)
//   Coulomb             |t| <= mu p; beyond it the point slips: t = mu p t / |t|, a follows (C.3)
// in the ground's axes, so the anchors move with the ground. A point that comes into contact within
// a step gets its anchor where it touched the ground, on the straight path from its position x_0 at
// the step's start:
//   a = x_0 + s (x - x_0),   s = g_0 / (g_0 - g).                                           (C.4)
// This holds only near the step's start: loading.h divides paths into short steps. epsilon and
// epsilon_t are the penalty stiffnesses, mu is the coefficient of friction, x the position.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/contact/contact_patch.h"
#include "models/fe_tire/contact/ground.h"
#include "models/fe_tire/contact/tread_surface.h"
#include "numerics/sparse/symmetric_matrix.h"

namespace latsch::fe_tire {

/// State of friction at a tread point: the point of the ground to which it sticks.
struct Anchor {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // m, in the ground's axes
  bool holds = false;                            // true: the point is in contact
  bool slid = false;  // true: the point slid in the step that led to the last equilibrium
  bool operator==(const Anchor&) const = default;
};

class TreadContact {
 public:
  /// A point in contact, with its force and stiffness in the wheel frame.
  struct Touch {
    int point;              // index of the point
    Eigen::Vector3d force;  // N, force on the tire
    // N/m: symmetric part of minus the derivative of the force by the displacement
    Eigen::Matrix3d stiffness;
    // N/m: remaining part, from sliding friction that changes with the pressure
    Eigen::Matrix3d coupling;
  };

  TreadContact(const TreadSurface& tread, const Ground& ground);

  const TreadSurface& tread() const { return tread_; }
  const Ground& ground() const { return ground_; }
  bool has_friction() const { return ground_.mu > 0.0; }
  /// Returns true if the forces depend only on the heights of the tread's nodes: without friction,
  /// on flat and level ground.
  bool is_by_height() const { return !has_friction() && !ground_.bar && pose_.camber == 0.0; }

  /// Sets the equilibrium from which the next step starts.
  void start(const GroundPose& pose, const Eigen::VectorXd& x, std::vector<Anchor> anchors);
  /// Sets the equilibrium from which the next step starts by the displacements of the tread's nodes
  /// (TreadSurface::displacements).
  void start(const GroundPose& pose, const Eigen::Matrix3Xd& u, std::vector<Anchor> anchors);
  /// Moves the ground. The friction anchors remain those of the start of the step.
  void move(const GroundPose& pose);
  const GroundPose& pose() const { return pose_; }

  /// Returns the points in contact if the tread's nodes are displaced by u
  /// (TreadSurface::displacements).
  std::vector<Touch> touches(const Eigen::Matrix3Xd& u) const;
  /// Returns the points in contact for small motions about the state x. If there is friction, all
  /// of them stick.
  std::vector<Touch> stuck(const Eigen::VectorXd& x) const;
  /// Returns the friction anchors at the end of the step, for the equilibrium x or for
  /// displacements u.
  std::vector<Anchor> anchors(const Eigen::VectorXd& x) const;
  std::vector<Anchor> anchors(const Eigen::Matrix3Xd& u) const;
  /// Returns the largest depth, m, by which a point penetrates the ground; 0 if no point does.
  double deepest(const Eigen::Matrix3Xd& u) const;
  /// Returns the indices of the points that are at most `distance`, m, away from the ground,
  /// ascending. If points are held, returns those.
  std::vector<int> within(double distance, const Eigen::Matrix3Xd& u) const;

  /// Returns the contact patch of the whole ring in the equilibrium x, whose friction anchors are
  /// those of the start.
  ContactPatch patch(const Eigen::VectorXd& x) const;
  /// Force (N) on the tire and moment (N m) about the wheel center, of the whole ring. The axes are
  /// those of the ground without its yaw: z along its normal, x in the heading of the wheel.
  struct Sum {
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = force;
  };
  Sum sum(const Eigen::VectorXd& x) const;
  /// Returns true if a part of the tread on which contact is not computed penetrates the ground.
  bool misses(const Eigen::VectorXd& x) const;

 private:
  /// Returns true if a point at the distance g from the ground is in contact.
  bool touches_at(int point, double g) const {
    return is_held_.empty() ? g < 0.0 : is_held_[point] != 0;
  }
  struct Traction {
    double p;           // Pa, normal traction per reference area
    Eigen::Vector3d t;  // Pa, tangential traction per reference area, in the ground's axes
    // Minus the symmetric part of the derivative of t with respect to the position x.
    Eigen::Matrix3d dt;
    Eigen::Vector3d coupling;  // minus the derivative of the traction t along the normal
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
  // For every point of the tread: true if it is held; empty if no point is.
  std::vector<char> is_held_;
  std::vector<Anchor> anchors_;
  // Positions of the points at the start, in the ground's axes; used only with friction.
  Eigen::Matrix3Xd start_;
  std::vector<double> start_g_;
};

/// Groups touching points by the cells of `tread`. All points of a cell depend on the same nodes.
std::vector<std::vector<const TreadContact::Touch*>> by_cells(
    const TreadSurface& tread, const std::vector<TreadContact::Touch>& touches);
/// Subtracts the ground's forces on the tire from f, which holds internal forces in the numbering
/// of `tread`.
void add_forces(const TreadSurface& tread,
                const std::vector<TreadContact::Touch>& touches,
                Eigen::VectorXd& f);
/// Adds the symmetric part of the contact stiffness to K, in the numbering of `tread` (even or odd
/// motions). The cells of the tread are the elements of K's pattern from `first_cell` on.
void add_stiffness(const TreadSurface& tread,
                   const std::vector<TreadContact::Touch>& touches,
                   int first_cell,
                   numerics::SymmetricMatrix& K);

}  // namespace latsch::fe_tire
