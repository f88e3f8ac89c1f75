// SPDX-License-Identifier: Apache-2.0
// Rigid flat ground under the tread: penalty in the normal direction, Coulomb friction in the
// plane.
//
// At every Gauss point (2x2) of a tread face, with the height g of the point over the ground and dA
// its reference area,
//   normal traction     p = -epsilon g            where g < 0, otherwise none               (C.1)
//   tangential trial    t = -epsilon_t (x_t - a)  from the anchor a the point sticks to     (C.2)
//   Coulomb             |t| <= mu p; beyond it the point slips: t = mu p t / |t|, a follows (C.3)
// Per reference area the normal part has the potential 1/2 epsilon g^2, so its tangent is exact and
// symmetric; in slip the unsymmetric coupling of t with p is left out of the tangent (not out of
// the force), which keeps it positive. A point that comes down within a load step is free to slide
// until the end of that step; there it gets its anchor: the motion before first touch must not load
// it. Fine steps make that error small.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/element/pressure.h"
#include "models/fe_tire/ring/fe_tire.h"
#include "models/fe_tire/ring/ring_unknowns.h"

namespace latsch::fe_tire {

class GroundContact {
 public:
  struct Face {
    int element;
    std::array<Eigen::Vector4d, 4> N;  // shape functions at the 4 Gauss points
    std::array<double, 4> dA;          // reference area, m^2
  };

  GroundContact(const RingUnknowns& unknowns, const Ground& ground);

  const Ground& ground() const { return ground_; }
  /// Tread faces of a sector, in the order of its elements.
  const std::vector<Face>& faces(int sector) const { return faces_[ring_.width(sector)]; }

  /// Height of the ground in the wheel frame, m (negative: below the wheel center).
  void set_height(double z) { height_ = z; }
  double height() const { return height_; }

  /// Adds forces (internal-force sign: minus what the ground does to the tire) and tangent of a
  /// tread element of displacement u to f and K, in its sector's frame. All points in contact stick
  /// where `stuck`.
  void add(int sector, int element, const Matrix38& u, bool stuck, Vector24& f, Matrix24* K) const;

  /// The same for f and K in the frames of their nodes.
  void add_turned(
      int sector, int element, const Matrix38& u, bool stuck, Vector24& f, Matrix24* K) const;

  /// Takes the state x as an equilibrium: anchors follow, new points in contact get theirs.
  void settle(const Eigen::VectorXd& x);

  /// The contact patch (of the whole ring) and the vertical force on the tire [N] in state x.
  ContactPatch patch(const Eigen::VectorXd& x, double* Fz) const;

 private:
  struct Point {
    Eigen::Vector2d anchor = Eigen::Vector2d::Zero();
    bool anchored = false;
    bool slid = false;  // in the step that ended with the last equilibrium
  };
  struct Traction {
    double p;               // normal, Pa per reference area
    Eigen::Vector2d t;      // tangential
    Eigen::Matrix2d dt_dx;  // minus the symmetric tangent of t
    bool sticks;
  };

  Traction traction(const Eigen::Vector3d& x, const Point& point, bool stuck) const;
  Matrix34 world_face(int sector, int element, const Matrix38& u) const;
  Face face_of(int sector, int element) const;
  bool touches(int sector, int element, const Matrix38& u) const;
  int point_index(int sector, int face, int q) const;

  const RingUnknowns& unknowns_;
  const Ring& ring_;
  Ground ground_;
  double height_ = 0.0;
  std::vector<std::vector<Face>> faces_;  // tread faces of a sector, by its width
  std::vector<int> face_of_element_;      // -1: no tread face
  std::vector<Eigen::Matrix3d> frames_;
  std::vector<Point> points_;
};

}  // namespace latsch::fe_tire
