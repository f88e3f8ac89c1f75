// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/contact/contact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "models/fe_tire/contact/footprint.h"
#include "numerics/dense/dense_products.h"

namespace latsch::fe_tire {
namespace {

// Tangential penalty before slip, as a share of the normal penalty. With a larger share points move
// less before they slip.
constexpr double kTangentialShare = 0.5;

}  // namespace

TreadContact::TreadContact(const TreadSurface& tread, const Ground& ground)
    : tread_(tread), ground_(ground), posed_(ground, {}) {
  if (!ground.held) return;
  assert(!has_friction() && !ground.bar);
  is_held_.resize(tread.points().size(), 0);
  for (const int point : ground.held->points) {
    assert(point < std::ssize(is_held_));
    is_held_[point] = 1;
  }
}

void TreadContact::start(const GroundPose& pose,
                         const Eigen::VectorXd& x,
                         std::vector<Anchor> anchors) {
  start(pose, tread_.displacements(x), std::move(anchors));
}

void TreadContact::start(const GroundPose& pose,
                         const Eigen::Matrix3Xd& u,
                         std::vector<Anchor> anchors) {
  move(pose);
  anchors_ = std::move(anchors);
  if (!has_friction()) return;
  anchors_.resize(tread_.points().size());
  start_.resize(3, tread_.points().size());
  start_g_.resize(tread_.points().size());
  const Eigen::Matrix3Xd points = tread_.points_at(tread_.positions(u));
  for (std::size_t k = 0; k < tread_.points().size(); ++k) {
    start_.col(k) = posed_.in_ground(points.col(k));
    start_g_[k] = posed_.distance(start_.col(k)).g;
  }
}

void TreadContact::move(const GroundPose& pose) {
  pose_ = pose;
  posed_ = PosedGround(ground_, pose);
}

/// Computes the anchor of a point by (C.4). `share` is the derivative of the point's distance from
/// its anchor with respect to the point's motion.
Anchor TreadContact::anchor_of(int point, const Eigen::Vector3d& q, double g, double* share) const {
  *share = 1.0;
  if (anchors_[point].holds) return anchors_[point];
  const double g_0 = std::max(start_g_[point], 0.0);
  const double s = g_0 > 0.0 ? g_0 / (g_0 - g) : 0.0;
  *share = 1.0 - s;
  return {start_.col(point) + s * (q - start_.col(point)), true, false};
}

TreadContact::Traction TreadContact::traction(const Eigen::Vector3d& q,
                                              const PosedGround::Distance& at,
                                              const Anchor& anchor,
                                              double share) const {
  Traction on{-ground_.stiffness * at.g,
              Eigen::Vector3d::Zero(),
              Eigen::Matrix3d::Zero(),
              Eigen::Vector3d::Zero(),
              false};  // (C.1)
  if (!has_friction()) return on;
  const double stiffness = kTangentialShare * ground_.stiffness;
  const Eigen::Matrix3d along = Eigen::Matrix3d::Identity() - at.n * at.n.transpose();
  const Eigen::Vector3d trial = -stiffness * (along * (q - anchor.at));  // (C.2)
  const double limit = ground_.mu * on.p, size = trial.norm();
  on.sticks = size <= limit;
  if (on.sticks) {
    on.t = trial;
    on.dt = share * stiffness * along;
  } else {
    const Eigen::Vector3d way = trial / size;
    on.t = limit * way;  // (C.3)
    on.dt = share * stiffness * limit / size * (along - way * way.transpose());
    on.coupling = ground_.mu * ground_.stiffness * way;
  }
  return on;
}

TreadContact::Touch TreadContact::touch_of(int point,
                                           const PosedGround::Distance& at,
                                           const Traction& on) const {
  const double dA = tread_.points()[point].dA;
  const Eigen::Matrix3d D = ground_.stiffness * at.n * at.n.transpose() + on.dt;
  const auto turned = [&](const Eigen::Matrix3d& matrix) {
    Eigen::Matrix3d result;
    for (int k = 0; k < 3; ++k) result.col(k) = posed_.to_wheel(matrix.col(k));
    const Eigen::Matrix3d transposed = result.transpose();
    for (int k = 0; k < 3; ++k) result.row(k) = posed_.to_wheel(transposed.col(k)).transpose();
    return Eigen::Matrix3d(result * dA);
  };
  Touch touch{point, posed_.to_wheel(on.p * at.n + on.t) * dA, turned(D), Eigen::Matrix3d::Zero()};
  if (!on.coupling.isZero(0.0)) touch.coupling = turned(on.coupling * at.n.transpose());
  return touch;
}

std::vector<TreadContact::Touch> TreadContact::touches(const Eigen::Matrix3Xd& u) const {
  const Eigen::Matrix3Xd points = tread_.points_at(tread_.positions(u));
  std::vector<Touch> touches;
  for (int k = 0; k < static_cast<int>(tread_.points().size()); ++k) {
    const Eigen::Vector3d q = posed_.in_ground(points.col(k));
    const PosedGround::Distance at = posed_.distance(q);
    if (!touches_at(k, at.g)) continue;
    double share = 1.0;
    const Anchor anchor = has_friction() ? anchor_of(k, q, at.g, &share) : Anchor();
    touches.push_back(touch_of(k, at, traction(q, at, anchor, share)));
  }
  return touches;
}

std::vector<TreadContact::Touch> TreadContact::stuck(const Eigen::VectorXd& x) const {
  const Eigen::Matrix3Xd points = tread_.points_at(tread_.positions(tread_.displacements(x)));
  std::vector<Touch> touches;
  for (int k = 0; k < static_cast<int>(tread_.points().size()); ++k) {
    const Eigen::Vector3d q = posed_.in_ground(points.col(k));
    const PosedGround::Distance at = posed_.distance(q);
    if (!touches_at(k, at.g)) continue;
    touches.push_back(touch_of(k, at, traction(q, at, {q, true, false}, 1.0)));
  }
  return touches;
}

double TreadContact::deepest(const Eigen::Matrix3Xd& u) const {
  const Eigen::Matrix3Xd points = tread_.points_at(tread_.positions(u));
  double depth = 0.0;
  for (Eigen::Index k = 0; k < points.cols(); ++k)
    depth = std::max(depth, -posed_.distance(posed_.in_ground(points.col(k))).g);
  return depth;
}

std::vector<int> TreadContact::within(double distance, const Eigen::Matrix3Xd& u) const {
  const Eigen::Matrix3Xd points = tread_.points_at(tread_.positions(u));
  std::vector<int> near;
  for (int k = 0; k < static_cast<int>(tread_.points().size()); ++k) {
    const Eigen::Vector3d q = posed_.in_ground(points.col(k));
    const double g = posed_.distance(q).g;
    if (ground_.held ? touches_at(k, g) : g < distance) near.push_back(k);
  }
  return near;
}

std::vector<Anchor> TreadContact::anchors(const Eigen::VectorXd& x) const {
  return anchors(tread_.displacements(x));
}

std::vector<Anchor> TreadContact::anchors(const Eigen::Matrix3Xd& u) const {
  if (!has_friction()) return {};
  const double stiffness = kTangentialShare * ground_.stiffness;
  const Eigen::Matrix3Xd points = tread_.points_at(tread_.positions(u));
  std::vector<Anchor> anchors(tread_.points().size());
  for (int k = 0; k < static_cast<int>(anchors.size()); ++k) {
    const Eigen::Vector3d q = posed_.in_ground(points.col(k));
    const PosedGround::Distance at = posed_.distance(q);
    if (!touches_at(k, at.g)) continue;
    double share = 1.0;
    const Traction on = traction(q, at, anchor_of(k, q, at.g, &share), share);
    anchors[k] = {q + on.t / stiffness, true, !on.sticks};
  }
  return anchors;
}

ContactPatch TreadContact::patch(const Eigen::VectorXd& x) const {
  ContactPatch patch;
  double rest = 0.0;
  const Eigen::Matrix3Xd positions = tread_.positions(tread_.displacements(x));
  const PosedGround level(ground_, {pose_.height, 0.0, 0.0, pose_.camber, 0.0});
  const auto& samples = tread_.samples();
  Eigen::Matrix3Xd over(3, samples.size());
  Eigen::VectorXd area(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Eigen::Vector3d p = tread_.at(samples[k], positions);
    over.col(k) = level.in_ground(p);
    over(2, k) = posed_.distance(posed_.in_ground(p)).g;
    area[k] = tread_.area(samples[k], positions);
  }
  const Eigen::Matrix3Xd points = tread_.points_at(positions);
  for (int k = 0; k < static_cast<int>(tread_.points().size()); ++k) {
    const Eigen::Vector3d p = points.col(k);
    const Eigen::Vector3d q = posed_.in_ground(p);
    const PosedGround::Distance at = posed_.distance(q);
    if (!touches_at(k, at.g)) continue;
    // If the point slides, its anchor has moved along with it. Whether the point slides is
    // therefore read from the anchor; tractions computed from this anchor would be decided by
    // rounding.
    const Anchor anchor = has_friction() ? anchors_[k] : Anchor();
    const Traction on = traction(q, at, anchor, 1.0);
    const Eigen::Vector3d shear =
        level.in_ground(posed_.to_wheel(on.t)) - level.in_ground(Eigen::Vector3d::Zero());
    const Eigen::Vector3d here = level.in_ground(p);
    // A point that is its own image under the half turn is listed once, with twice its area.
    const TreadSurface::Point& point = tread_.points()[k];
    rest = std::max(rest, point.offset.norm());
    patch.points.push_back({here.x(),
                            here.y(),
                            on.p,
                            shear.x(),
                            shear.y(),
                            (point.is_own_image ? 2.0 : 1.0) * point.dA,
                            point.around,
                            has_friction() && !anchor.slid});
    if (tread_.multiplicity() == 1.0 || point.is_own_image) continue;
    ContactPatch::Point image = patch.points.back();
    for (double* value : {&image.x, &image.y, &image.shear_x, &image.shear_y}) *value = -*value;
    patch.points.push_back(image);
  }
  const FootprintSize size = footprint_size(tread_, over, area, rest);
  patch.length = size.length;
  patch.width = size.width;
  patch.area = size.area;
  return patch;
}

TreadContact::Sum TreadContact::sum(const Eigen::VectorXd& x) const {
  const Eigen::Matrix3Xd points = tread_.points_at(tread_.positions(tread_.displacements(x)));
  Sum sum;
  const PosedGround level(ground_, {pose_.height, 0.0, 0.0, pose_.camber, 0.0});
  const Eigen::Vector3d center = level.in_ground(Eigen::Vector3d::Zero());
  for (int k = 0; k < static_cast<int>(tread_.points().size()); ++k) {
    const Eigen::Vector3d p = points.col(k);
    const Eigen::Vector3d q = posed_.in_ground(p);
    const PosedGround::Distance at = posed_.distance(q);
    if (!touches_at(k, at.g)) continue;
    const Traction on = traction(q, at, has_friction() ? anchors_[k] : Anchor(), 1.0);
    const Eigen::Vector3d force =
        (level.in_ground(posed_.to_wheel(on.p * at.n + on.t)) - center) * tread_.points()[k].dA;
    const Eigen::Vector3d moment = (level.in_ground(p) - center).cross(force);
    sum.force += force;
    sum.moment += moment;
    if (tread_.multiplicity() == 1.0) continue;
    sum.force += Eigen::Vector3d(-force.x(), -force.y(), force.z());
    sum.moment += Eigen::Vector3d(-moment.x(), -moment.y(), moment.z());
  }
  return sum;
}

bool TreadContact::misses(const Eigen::VectorXd& x) const {
  if (ground_.held) return false;
  const Eigen::Matrix3Xd beyond = tread_.beyond(x);
  for (Eigen::Index k = 0; k < beyond.cols(); ++k) {
    if (posed_.distance(posed_.in_ground(beyond.col(k))).g < 0.0) return true;
  }
  return false;
}

std::vector<std::vector<const TreadContact::Touch*>> by_cells(
    const TreadSurface& tread, const std::vector<TreadContact::Touch>& touches) {
  std::vector<std::vector<const TreadContact::Touch*>> of_cell(tread.cell_nodes().size());
  for (const TreadContact::Touch& touch : touches)
    of_cell[tread.points()[touch.point].cell].push_back(&touch);
  return of_cell;
}

void add_forces(const TreadSurface& tread,
                const std::vector<TreadContact::Touch>& touches,
                Eigen::VectorXd& f) {
  for (const TreadContact::Touch& touch : touches) {
    const TreadSurface::Point& point = tread.points()[touch.point];
    for (int k = 0; k < point.weights; ++k) {
      const TreadSurface::Weight& weight = tread.weights(point)[k];
      const TreadSurface::Place& place = tread.places()[weight.place];
      if (place.node < 0) continue;
      f.segment<3>(3 * tread.block_rows()[place.node]) -=
          weight.w * (place.T.transpose() * touch.force);
    }
  }
}

void add_stiffness(const TreadSurface& tread,
                   const std::vector<TreadContact::Touch>& touches,
                   int first_cell,
                   numerics::SymmetricMatrix& K) {
  const auto of_cell = by_cells(tread, touches);
  std::vector<int> row(tread.nodes(), -1);
  for (std::size_t cell = 0; cell < of_cell.size(); ++cell) {
    if (of_cell[cell].empty()) continue;
    const std::vector<int>& nodes = tread.cell_nodes()[cell];
    for (std::size_t k = 0; k < nodes.size(); ++k) row[nodes[k]] = static_cast<int>(k);
    const Eigen::Index size = 3 * std::ssize(nodes), directions = 3 * std::ssize(of_cell[cell]);
    // Motions of the points per unknown, and the forces that these motions cause.
    Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(size, directions), forces(directions, size);
    for (std::size_t t = 0; t < of_cell[cell].size(); ++t) {
      const TreadContact::Touch& touch = *of_cell[cell][t];
      const TreadSurface::Point& point = tread.points()[touch.point];
      auto motion = motions.middleCols<3>(3 * static_cast<Eigen::Index>(t));
      for (int k = 0; k < point.weights; ++k) {
        const TreadSurface::Weight& weight = tread.weights(point)[k];
        const TreadSurface::Place& place = tread.places()[weight.place];
        if (place.node >= 0)
          motion.middleRows<3>(3 * row[place.node]) += weight.w * place.T.transpose();
      }
      forces.middleRows<3>(3 * static_cast<Eigen::Index>(t)).noalias() =
          touch.stiffness * motion.transpose();
    }
    Eigen::MatrixXd of_points(size, size);
    numerics::add_product<double>(1.0, motions, forces, 0.0, of_points);
    K.add_element(first_cell + static_cast<int>(cell), of_points.data());
  }
}

}  // namespace latsch::fe_tire
