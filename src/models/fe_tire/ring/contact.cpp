// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/ring/contact.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "models/fe_tire/element/hex8_shape.h"

namespace latsch::fe_tire {
namespace {

// The ground resists sliding before slip as stiffly, by half, as it resists penetration.
constexpr double kTangentialShare = 0.5;

constexpr double kOuter = 1.0;  // zeta of the tread face

/// Outward area vector dx/dxi x dx/deta of a tread face at (xi, eta).
Eigen::Vector3d area_vector(const Matrix34& x, double xi, double eta) {
  const Eigen::Matrix<double, 4, 3> dN =
      parent_gradients(xi, eta, kOuter).rightCols<4>().transpose();
  return (x * dN.col(0)).cross(Eigen::Vector3d(x * dN.col(1)));
}

Eigen::Vector4d face_functions(double xi, double eta) {
  return shape_functions(xi, eta, kOuter).tail<4>();
}

// A footprint is what comes this close to the ground: elements are longer than the patch is sharp,
// so it is sampled finer than the four points that carry the force.
constexpr double kTouch = 2e-5;  // m
constexpr int kSamples = 8;      // along each side of a face

/// Area and extent of the tread that touches the ground.
struct Footprint {
  double area = 0.0;
  Eigen::Vector2d lowest = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d highest = -lowest;

  void add(const Matrix34& face, double ground) {
    for (int i = 0; i < kSamples * kSamples; ++i) {
      const double xi = (2.0 * (i % kSamples) + 1.0) / kSamples - 1.0;
      const double eta = (2.0 * (i / kSamples) + 1.0) / kSamples - 1.0;
      const Eigen::Vector3d at = face * face_functions(xi, eta);
      if (at.z() >= ground + kTouch) continue;
      area += std::abs(area_vector(face, xi, eta).z()) * 4.0 / (kSamples * kSamples);
      lowest = lowest.cwiseMin(at.head<2>());
      highest = highest.cwiseMax(at.head<2>());
    }
  }
  void add_images() {
    area *= 2.0;
    const Eigen::Vector2d far = highest.cwiseMax(-lowest);
    lowest = -far;
    highest = far;
  }
  double extent(int axis) const { return area > 0.0 ? highest[axis] - lowest[axis] : 0.0; }
};

/// Adds the images under the half turn about the vertical axis.
void add_images(ContactPatch& patch) {
  const std::size_t computed = patch.points.size();
  for (std::size_t k = 0; k < computed; ++k) {
    ContactPatch::Point image = patch.points[k];
    image.x = -image.x;
    image.y = -image.y;
    image.shear_x = -image.shear_x;
    image.shear_y = -image.shear_y;
    patch.points.push_back(image);
  }
}

double gauss_xi(int q) { return (q & 1) ? kGauss : -kGauss; }
double gauss_eta(int q) { return (q & 2) ? kGauss : -kGauss; }

}  // namespace

GroundContact::GroundContact(const RingUnknowns& unknowns, const Ground& ground)
    : unknowns_(unknowns), ring_(unknowns.ring()), ground_(ground), faces_(ring_.widths()) {
  const Ring& ring = ring_;
  face_of_element_.assign(ring.elements_per_sector(), -1);
  int of_sector = 0;
  for (int e = 0; e < ring.elements_per_sector(); ++e) {
    if (ring.mesh().elements[e].tread) face_of_element_[e] = of_sector++;
  }
  for (int s = 0; s < unknowns.sectors(); ++s) {
    frames_.push_back(ring.mesh().frame(s));
    std::vector<Face>& faces = faces_[ring.width(s)];
    for (int e = 0; e < ring.elements_per_sector() && static_cast<int>(faces.size()) < of_sector;
         ++e) {
      if (face_of_element_[e] >= 0) faces.push_back(face_of(s, e));
    }
  }
  points_.resize(4 * static_cast<std::size_t>(of_sector) * unknowns.sectors());
}

GroundContact::Face GroundContact::face_of(int sector, int element) const {
  const Matrix34 X = ring_.shape(sector, element).X.rightCols<4>();
  Face face{element, {}, {}};
  for (int q = 0; q < 4; ++q) {
    const double xi = gauss_xi(q), eta = gauss_eta(q);
    face.N[q] = face_functions(xi, eta);
    face.dA[q] = area_vector(X, xi, eta).norm();
  }
  return face;
}

int GroundContact::point_index(int sector, int face, int q) const {
  return 4 * (sector * static_cast<int>(faces(sector).size()) + face) + q;
}

Matrix34 GroundContact::world_face(int sector, int element, const Matrix38& u) const {
  return frames_[sector] * (ring_.shape(sector, element).X + u).rightCols<4>();
}

GroundContact::Traction GroundContact::traction(const Eigen::Vector3d& x,
                                                const Point& point,
                                                bool stuck) const {
  Traction result{-ground_.stiffness * (x.z() - height_),
                  Eigen::Vector2d::Zero(),
                  Eigen::Matrix2d::Zero(),
                  false};  // (C.1)
  if (ground_.mu == 0.0) return result;
  const double stiffness = kTangentialShare * ground_.stiffness;
  if (stuck) {
    result.dt_dx = stiffness * Eigen::Matrix2d::Identity();
    result.sticks = true;
    return result;
  }
  if (!point.anchored) return result;
  const Eigen::Vector2d trial = -stiffness * (x.head<2>() - point.anchor);  // (C.2)
  const double limit = ground_.mu * result.p, size = trial.norm();
  result.sticks = size <= limit;
  if (result.sticks) {
    result.t = trial;
    result.dt_dx = stiffness * Eigen::Matrix2d::Identity();
  } else {
    const Eigen::Vector2d along = trial / size;
    result.t = limit * along;  // (C.3)
    result.dt_dx =
        stiffness * limit / size * (Eigen::Matrix2d::Identity() - along * along.transpose());
  }
  return result;
}

void GroundContact::add(
    int sector, int element, const Matrix38& u, bool stuck, Vector24& f, Matrix24* K) const {
  if (!touches(sector, element, u)) return;
  const int k = face_of_element_[element];
  const Matrix34 x = world_face(sector, element, u);

  const Eigen::Matrix3d& R = frames_[sector];
  const Face& face = faces(sector)[k];
  for (int q = 0; q < 4; ++q) {
    const Eigen::Vector3d at = x * face.N[q];
    if (at.z() >= height_) continue;
    const Traction on = traction(at, points_[point_index(sector, k, q)], stuck);
    const Eigen::Vector3d force =
        R.transpose() * Eigen::Vector3d(on.t.x(), on.t.y(), on.p) * face.dA[q];
    Eigen::Matrix3d C = Eigen::Matrix3d::Zero();
    if (K) {
      C.topLeftCorner<2, 2>() = on.dt_dx;
      C(2, 2) = ground_.stiffness;
      C = R.transpose() * C * R * face.dA[q];
    }
    for (int a = 0; a < 4; ++a) {
      f.segment<3>(12 + 3 * a) -= face.N[q][a] * force;
      if (!K) continue;
      for (int b = 0; b < 4; ++b) {
        K->block<3, 3>(12 + 3 * a, 12 + 3 * b) += face.N[q][a] * face.N[q][b] * C;
      }
    }
  }
}

bool GroundContact::touches(int sector, int element, const Matrix38& u) const {
  return face_of_element_[element] >= 0 &&
         world_face(sector, element, u).row(2).minCoeff() < height_;
}

void GroundContact::add_turned(
    int sector, int element, const Matrix38& u, bool stuck, Vector24& f, Matrix24* K) const {
  if (!touches(sector, element, u)) return;
  Vector24 force = Vector24::Zero();
  Matrix24 stiffness = Matrix24::Zero();
  add(sector, element, u, stuck, force, K ? &stiffness : nullptr);
  ring_.turn_to_node_frames(sector, element, force, K ? &stiffness : nullptr);
  f += force;
  if (K) *K += stiffness;
}

void GroundContact::settle(const Eigen::VectorXd& x) {
  const double stiffness = kTangentialShare * ground_.stiffness;
  for (int s = 0; s < unknowns_.sectors(); ++s) {
    for (int k = 0; k < static_cast<int>(faces(s).size()); ++k) {
      const Matrix34 face =
          world_face(s, faces(s)[k].element, unknowns_.gather(s, faces(s)[k].element, x));
      for (int q = 0; q < 4; ++q) {
        Point& point = points_[point_index(s, k, q)];
        const Eigen::Vector3d at = face * faces(s)[k].N[q];
        if (at.z() >= height_) {
          point = Point();
          continue;
        }
        const Traction on = traction(at, point, false);
        point.slid = point.anchored && !on.sticks;
        point.anchor = at.head<2>() + on.t / stiffness;
        point.anchored = true;
      }
    }
  }
}

ContactPatch GroundContact::patch(const Eigen::VectorXd& x, double* Fz) const {
  ContactPatch patch;
  Footprint footprint;
  double force = 0.0;
  for (int s = 0; s < unknowns_.sectors(); ++s) {
    for (int k = 0; k < static_cast<int>(faces(s).size()); ++k) {
      const Matrix34 face =
          world_face(s, faces(s)[k].element, unknowns_.gather(s, faces(s)[k].element, x));
      if (face.row(2).minCoeff() < height_ + kTouch) footprint.add(face, height_);
      for (int q = 0; q < 4; ++q) {
        const Eigen::Vector3d at = face * faces(s)[k].N[q];
        if (at.z() >= height_) continue;
        // Its anchor has followed: whether it slides, the tractions there would tell by rounding.
        const Point& point = points_[point_index(s, k, q)];
        const Traction on = traction(at, point, false);
        const double area = std::abs(area_vector(face, gauss_xi(q), gauss_eta(q)).z());
        const double stretch = faces(s)[k].dA[q] / area;  // tractions per current, flat area
        patch.points.push_back({at.x(),
                                at.y(),
                                on.p * stretch,
                                on.t.x() * stretch,
                                on.t.y() * stretch,
                                area,
                                ground_.mu > 0.0 && !point.slid});
        force += on.p * faces(s)[k].dA[q];
      }
    }
  }
  if (unknowns_.multiplicity() > 1.0) {
    add_images(patch);
    footprint.add_images();
  }
  patch.area = footprint.area;
  patch.length = footprint.extent(0);
  patch.width = footprint.extent(1);
  if (Fz) *Fz = force * unknowns_.multiplicity();
  return patch;
}

}  // namespace latsch::fe_tire
