// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/tread_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "numerics/dense/lu.h"
#include "numerics/sparse/front_algebra.h"

namespace latsch::fe_tire {
namespace {

/// Relative residual of a refined solution, and most refinements. A matrix that needs more is
/// factorized in double precision.
constexpr double kRefined = 1e-11;
constexpr int kMostRefinements = 6;
/// Largest rise, m, and change of the spin of one step: a tire that slides as a whole tells no
/// slope.
constexpr double kMostRise = 2e-3, kMostTurn = 0.02;
/// Depth to which the lowest point is pressed if none touches, m: its pressure is then that of a
/// tire.
constexpr double kTouch = 1e-5;

/// Solves J x = R by a factorization in single precision, which is several times as fast, and
/// residuals in double precision.
bool solve_refined(const Eigen::MatrixXd& J, const Eigen::VectorXd& R, Eigen::VectorXd& x) {
  const int n = static_cast<int>(J.rows());
  const double scale = std::max(J.cwiseAbs().maxCoeff(), 1e-300);
  Eigen::MatrixXf LU = (J / scale).cast<float>();
  std::vector<int> rows(static_cast<std::size_t>(n));
  numerics::factorize_lu(n, LU.data(), rows.data());
  Eigen::VectorXd r = R;
  x = Eigen::VectorXd::Zero(n);
  for (int pass = 0; pass <= kMostRefinements; ++pass) {
    const double size = r.cwiseAbs().maxCoeff();
    if (size <= kRefined * R.cwiseAbs().maxCoeff()) return true;
    if (!std::isfinite(size)) break;
    Eigen::VectorXf step = (r / size).cast<float>();
    numerics::solve_lu(n, LU.data(), rows.data(), step.data());
    x += (size / scale) * step.cast<double>();
    r = R - J * x;
  }
  numerics::Lu lu;
  lu.factorize(J);
  Eigen::MatrixXd right = R;
  lu.solve(right);
  x = right;
  return x.allFinite();
}

}  // namespace

TreadBody::TreadBody(const TreadSurface& tread,
                     const TreadLines& lines,
                     const PosedGround& ground,
                     const RollingSurface& surface,
                     double penalty,
                     const GroundMotion& motion,
                     const Eigen::Matrix3Xd& u,
                     double near)
    : surface_(surface),
      motion_(motion),
      penalty_(penalty),
      hub_(ground.in_ground(Eigen::Vector3d::Zero())) {
  for (int k = 0; k < 3; ++k) R_.col(k) = ground.in_ground(Eigen::Vector3d::Unit(k)) - hub_;
  axis_ = R_.col(1);
  const Eigen::Matrix3Xd at = tread.points_at(tread.positions(u));
  const auto count = std::ssize(tread.points());
  std::vector<RollingSurface::Place> all;
  Eigen::VectorXd height(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    all.push_back(surface.place(ground.in_ground(at.col(k))));
    height[k] = all.back().x.z();
  }
  for (const std::vector<int>& line : lines.lines) add_line(tread, lines, line, height, near);
  // Points along the ground follow the mean itself: the offset stands for the arc that the ground
  // flattens, and would creep as it does.
  all_.resize(3, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto& [x, turn] = all[k];
    const Eigen::Vector3d offset = turn * (R_ * tread.points()[k].offset);
    all_.col(k) = x - Eigen::Vector3d(offset.x(), offset.y(), 0.0);
  }
  for (const int point : points_) {
    x_0_.emplace_back(all_.col(point));
    turn_.push_back(all[point].turn);
  }
  lines_.time = Eigen::Map<const Eigen::VectorXd>(times_.data(), std::ssize(times_));
  std::vector<int> column(3 * static_cast<std::size_t>(tread.nodes()), -1);
  for (std::size_t k = 0; k < rows_.size(); ++k) column[rows_[k]] = static_cast<int>(k);
  for (Section& section : sections_) {
    for (int& c : section.columns) c = column[c];
  }
  turns_.resize(rows_.size() / 3);
  for (const TreadSurface::Place& place : tread.places())
    if (place.node >= 0 && column[3 * place.node] >= 0)
      turns_[column[3 * place.node] / 3] = R_ * place.T;
}

/// Adds the part of a line that is near the ground, and the point before it.
void TreadBody::add_line(const TreadSurface& tread,
                         const TreadLines& lines,
                         const std::vector<int>& of,
                         const Eigen::VectorXd& height,
                         double near) {
  int first = -1, last = -1;
  for (int k = 0; k < std::ssize(of); ++k) {
    if (height[of[k]] >= near) continue;
    if (first < 0) first = k;
    last = k;
  }
  if (first < 0) return;
  first = std::max(0, first - 1);
  RollingLines::Line line{static_cast<int>(points_.size()), 0};
  Section section;
  std::map<int, int> local;  // row -> column
  for (int k = first; k <= last; ++k) {
    const TreadSurface::Point& point = tread.points()[of[k]];
    for (const int node : tread.nodes_of(point)) local.emplace(node, 0);
  }
  for (auto& [node, c] : local) {
    c = static_cast<int>(section.columns.size());
    for (int k = 0; k < 3; ++k) section.columns.push_back(3 * node + k);
  }
  for (int k = first; k <= last; ++k) {
    const TreadSurface::Point& point = tread.points()[of[k]];
    std::map<int, double> by;  // column of a node's first unknown -> weight
    for (int w = 0; w < point.weights; ++w) {
      const TreadSurface::Weight& weight = tread.weights(point)[w];
      const TreadSurface::Place& place = tread.places()[weight.place];
      if (place.node >= 0) by[local[place.node]] += weight.w;
    }
    PointNodes nodes;
    for (const auto& [at, w] : by) {
      nodes.at.push_back(at);
      nodes.w.push_back(w);
    }
    section.points.push_back(std::move(nodes));
    points_.push_back(of[k]);
    areas_.push_back(point.dA);
    times_.push_back(k == first ? 0.0
                                : (lines.theta[of[k - 1]] - lines.theta[of[k]]) / motion_.spin);
  }
  line.last = static_cast<int>(points_.size());
  lines_.lines.push_back(line);
  std::vector<int> rows = section.columns, all;
  std::ranges::set_union(rows_, rows, std::back_inserter(all));
  rows_ = std::move(all);
  sections_.push_back(std::move(section));
}

void TreadBody::set(Eigen::MatrixXd T, Eigen::VectorXd r) {
  T_ = std::move(T);
  r_ = std::move(r);
  const int nodes = static_cast<int>(turns_.size());
  for (int b = 0; b < nodes; ++b)
    for (int a = 0; a < nodes; ++a)
      T_.block<3, 3>(3 * a, 3 * b) =
          (turns_[a] * T_.block<3, 3>(3 * a, 3 * b) * turns_[b].transpose()).eval();
  for (int a = 0; a < nodes; ++a) r_.segment<3>(3 * a) = (turns_[a] * r_.segment<3>(3 * a)).eval();
}

Eigen::VectorXd TreadBody::to_nodes(const Eigen::VectorXd& q) const {
  Eigen::VectorXd at(std::ssize(rows_));
  for (int a = 0; a < std::ssize(turns_); ++a)
    at.segment<3>(3 * a) = turns_[a].transpose() * q.segment<3>(3 * a);
  return at;
}

void TreadBody::ask(std::optional<double> load, std::optional<double> drive) {
  load_ = load;
  drive_ = drive;
}

int TreadBody::size() const { return spin_at() + (drive_ ? 1 : 0); }

Eigen::Matrix3Xd TreadBody::positions(const Eigen::VectorXd& q) const {
  Eigen::Matrix3Xd x(3, std::ssize(points_));
  const Eigen::Vector3d up(0.0, 0.0, rise(q));
  for (std::size_t s = 0; s < sections_.size(); ++s) {
    const RollingLines::Line& line = lines_.lines[s];
    const Eigen::VectorXd moved = q(sections_[s].columns);
    for (int k = line.first; k < line.last; ++k) {
      const PointNodes& point = sections_[s].points[k - line.first];
      Eigen::Vector3d by = up;
      for (std::size_t n = 0; n < point.at.size(); ++n)
        by += point.w[n] * moved.segment<3>(point.at[n]);
      x.col(k) = x_0_[k] + turn_[k] * by;
    }
  }
  return x;
}

RollingInput TreadBody::input(const Eigen::VectorXd& q) const {
  const Eigen::Matrix3Xd x = positions(q);
  const Eigen::Index n = x.cols();
  RollingInput input{x.topRows<2>(),
                     (-penalty_ * x.row(2).transpose()).cwiseMax(0.0),
                     Eigen::VectorXd::Ones(n),
                     Eigen::Matrix2Xd(2, n),
                     upstream_};
  if (upstream_.is_past()) input.upstream.touched.assign(n, 0);
  // The lines' times are those of the spin at the start; what (F.1) needs is V_g Delta t.
  const double faster = 1.0 + spin_change(q);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Vector2d from = x.col(k).head<2>() - hub_.head<2>();
    input.V_g.col(k) =
        (motion_.velocity + motion_.turn * Eigen::Vector2d(-from.y(), from.x())) / faster;
    if (k == 0) continue;
    const double before = height_before(k, x);
    if (upstream_.is_past()) input.upstream.touched[k] = before < 0.0 ? 1 : 0;
    if (x(2, k) < 0.0 && before >= 0.0) input.share[k] = x(2, k) / (x(2, k) - before);
  }
  return input;
}

/// Returns the height of point k - 1 over the ground when the material of point k was there, m.
double TreadBody::height_before(Eigen::Index k, const Eigen::Matrix3Xd& x) const {
  if (!upstream_.is_past()) return x(2, k - 1);
  return upstream_.now[k] * x(2, k - 1) + upstream_.x(2, k);
}

Eigen::VectorXd TreadBody::touching(Eigen::VectorXd q) const {
  if (!load_) return q;
  const double lowest = positions(q).row(2).minCoeff();
  if (!(lowest < 0.0)) q[rise_at()] -= lowest + kTouch;
  return q;
}

Eigen::VectorXd TreadBody::forces(const RollingInput& input, const GripTractions& tractions) const {
  return to_nodes(forces_in_ground(input, tractions));
}

Eigen::VectorXd TreadBody::forces_in_ground(const RollingInput& input,
                                            const GripTractions& tractions) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(std::ssize(rows_));
  for (std::size_t s = 0; s < sections_.size(); ++s) {
    const RollingLines::Line& line = lines_.lines[s];
    Eigen::VectorXd on = Eigen::VectorXd::Zero(std::ssize(sections_[s].columns));
    for (int k = line.first; k < line.last; ++k) {
      if (!(input.p[k] > 0.0)) continue;
      const PointNodes& point = sections_[s].points[k - line.first];
      const Eigen::Vector3d force = this->force(k, input, tractions);
      for (std::size_t n = 0; n < point.at.size(); ++n)
        on.segment<3>(point.at[n]) += point.w[n] * force;
    }
    sum(sections_[s].columns) += on;
  }
  return sum;
}

/// Returns the moment of the drive about the spin axis, N m.
double TreadBody::drive(const RollingInput& input,
                        const GripTractions& tractions,
                        double rise) const {
  double sum = 0.0;
  const Eigen::Vector3d hub = hub_ + Eigen::Vector3d(0.0, 0.0, rise);
  for (int k = 0; k < input.p.size(); ++k) {
    if (!(input.p[k] > 0.0)) continue;
    sum -= axis_.dot((place(k, input) - hub).cross(force(k, input, tractions)));
  }
  return sum;
}

Eigen::VectorXd TreadBody::residual(const Eigen::VectorXd& q,
                                    const RollingInput& input,
                                    const GripTractions& tractions) const {
  const auto m = std::ssize(rows_);
  Eigen::VectorXd R(size());
  R.head(m) = T_ * q.head(m) + r_ - forces_in_ground(input, tractions);
  if (load_) {
    double Fz = 0.0;
    for (int k = 0; k < input.p.size(); ++k)
      if (input.p[k] > 0.0) Fz += force(k, input, tractions).z();
    R[rise_at()] = Fz - *load_;
  }
  if (drive_) R[spin_at()] = (drive(input, tractions, rise(q)) - *drive_) / hub_.z();
  return R;
}

/// Subtracts the derivatives of the forces on a line's points, and of load and drive, from the
/// Jacobian. G_i, the derivative of all forces with respect to the traction at point i, follows
/// from that at i + 1, against the flow:
///   G_i = L_i + G_{i+1} by_before_{i+1},   dF = sum_i G_i [by_step (dx_i - dx_{i-1}) + ...]
/// Successive points that stick leave nothing of G_{i+1} in the derivative by x_i, so that most
/// points act on their own columns alone.
class TreadBody::LineJacobian {
 public:
  LineJacobian(const TreadBody& body,
               const Section& section,
               const RollingLines::Line& line,
               const RollingInput& input,
               const GripTractions& tractions,
               const Eigen::Matrix3Xd& x,
               double rise,
               double faster,
               Eigen::MatrixXd& J)
      : body_(body),
        section_(section),
        line_(line),
        input_(input),
        tractions_(tractions),
        x_(x),
        rise_(rise),
        faster_(faster),
        J_(J),
        rows_(section.columns) {
    // On a drum tractions carry a part of the load.
    has_load_row_ = body.load_ && !body.surface_.is_flat();
    if (has_load_row_) rows_.push_back(body.rise_at());
    if (body.drive_) rows_.push_back(body.spin_at());
    tangent_.setZero(std::ssize(rows_), std::ssize(section.columns));
    is_dense_.assign(section.columns.size(), false);
    by_rise_.setZero(std::ssize(rows_));
    by_spin_.setZero(std::ssize(rows_));
    G_.setZero(std::ssize(rows_), 2);
  }

  void subtract() {
    for (int k = line_.last - 1; k >= line_.first; --k) step(k);
    for (Eigen::Index b = 0; b < tangent_.cols(); ++b) {
      if (!is_dense_[b]) continue;
      double* column = J_.col(section_.columns[b]).data();
      for (Eigen::Index a = 0; a < tangent_.rows(); ++a) column[rows_[a]] -= tangent_(a, b);
    }
    for (Eigen::Index a = 0; a < tangent_.rows(); ++a) {
      if (body_.load_) J_(rows_[a], body_.rise_at()) -= by_rise_[a];
      if (body_.drive_) J_(rows_[a], body_.spin_at()) -= by_spin_[a];
    }
  }

 private:
  /// Derivatives by the position of a point, in the axes of the surface: those that act by G_{i+1},
  /// 2 x 3.
  using Behind = Eigen::Matrix<double, 2, 3>;

  void step(int k) {
    const PointNodes& point = section_.points[k - line_.first];
    const bool follows = k + 1 < line_.last && input_.p[k + 1] > 0.0;
    const GripLink none, &next = follows ? tractions_.links[k + 1] : none;
    Behind behind;
    behind << -next.now * next.by_step, shared_;
    shared_.setZero();
    if (!(input_.p[k] > 0.0)) {
      act_behind(k, point, behind);
      G_.setZero();
      return;
    }
    const GripLink& link = tractions_.links[k];
    const double area = body_.areas_[k], stiff = -body_.penalty_;
    // Derivatives of the point's own traction by its position.
    Behind own;
    own << link.by_step, stiff * link.by_p;
    if (k > line_.first && !input_.carries(k)) {
      const double here = x_(2, k), there = body_.height_before(k, x_), drop = here - there;
      own.col(2) -= there / (drop * drop) * link.by_share;
      shared_ = link.now * here / (drop * drop) * link.by_share;
    }
    behind += next.by_before * own;
    act_behind(k, point, behind);
    const Eigen::Matrix3d& turn = body_.turn_[k];
    Eigen::Matrix3d force;
    force << area * own, 0.0, 0.0, area * stiff;
    force = (turn.transpose() * force * turn).eval();
    act_locally(point, force);
    const Eigen::Vector3d moment = moment_arm(k);
    if (body_.drive_) add_drive(k, point, force, moment);
    G_ = (G_ * next.by_before).eval();
    for (std::size_t a = 0; a < point.at.size(); ++a)
      G_.middleRows<3>(point.at[a]) += area * point.w[a] * turn.topRows<2>().transpose();
    if (has_load_row_)
      G_.row(std::ssize(section_.columns)) -= area * turn.block<2, 1>(0, 2).transpose();
    if (!body_.drive_) return;
    G_.row(G_.rows() - 1) += area / body_.hub_.z() * (turn.topRows<2>() * moment).transpose();
    by_spin_ += G_ * (link.by_step * input_.V_g.col(k) * (body_.lines_.time[k] / faster_));
  }

  /// Subtracts the derivatives of a point's own force by its position, and adds those of the load.
  void act_locally(const PointNodes& point, const Eigen::Matrix3d& force) {
    for (std::size_t b = 0; b < point.at.size(); ++b) {
      const int first = section_.columns[point.at[b]];
      for (int c = 0; c < 3; ++c) {
        const Eigen::Vector3d by = point.w[b] * force.col(c);
        double* column = J_.col(first + c).data();
        for (std::size_t a = 0; a < point.at.size(); ++a) {
          double* at = column + section_.columns[point.at[a]];
          for (int row = 0; row < 3; ++row) at[row] -= point.w[a] * by[row];
        }
      }
      if (!body_.load_) continue;
      by_rise_.segment<3>(point.at[b]) += point.w[b] * force.col(2);
      for (int c = 0; c < 3; ++c) J_(body_.rise_at(), first + c) += force(2, c) * point.w[b];
    }
    if (body_.load_) J_(body_.rise_at(), body_.rise_at()) += force(2, 2);
  }

  /// Returns axis x arm; the moment of the drive is -force . (axis x arm).
  Eigen::Vector3d moment_arm(int k) const {
    const Eigen::Vector3d hub = body_.hub_ + Eigen::Vector3d(0.0, 0.0, rise_);
    return body_.axis_.cross(body_.place(k, input_) - hub);
  }

  void act_behind(int k, const PointNodes& point, const Behind& behind) {
    if (behind.isZero(0.0)) return;
    const Eigen::MatrixX3d by = G_ * (behind * body_.turn_[k]).eval();
    for (std::size_t b = 0; b < point.at.size(); ++b) {
      for (int c = 0; c < 3; ++c) {
        tangent_.col(point.at[b] + c) += point.w[b] * by.col(c);
        is_dense_[point.at[b] + c] = true;
      }
    }
    if (body_.load_) by_rise_ += by.col(2);
  }

  /// Adds the derivatives of the drive's moment by the position of a point, of which `by_position`
  /// are those of its own force.
  void add_drive(int k,
                 const PointNodes& point,
                 const Eigen::Matrix3d& by_position,
                 const Eigen::Vector3d& arm) {
    const double height = body_.hub_.z();
    Eigen::RowVector3d by = arm.transpose() * by_position / height;
    // The place of the force moves along the surface, and its arm grows with the height.
    const Eigen::Vector3d turned = body_.force(k, input_, tractions_).cross(body_.axis_) / height;
    const auto along = body_.turn_[k].topRows<2>();
    by += (along * turned).transpose() * along;
    for (std::size_t b = 0; b < point.at.size(); ++b)
      for (int c = 0; c < 3; ++c)
        J_(body_.spin_at(), section_.columns[point.at[b]] + c) -= point.w[b] * by[c];
    by_rise_[tangent_.rows() - 1] += by[2] - turned.z();
  }

  const TreadBody& body_;
  const Section& section_;
  const RollingLines::Line& line_;
  const RollingInput& input_;
  const GripTractions& tractions_;
  const Eigen::Matrix3Xd& x_;
  double rise_, faster_;
  Eigen::MatrixXd& J_;
  std::vector<int> rows_;
  bool has_load_row_ = false;
  Eigen::MatrixXd tangent_;  // derivatives that act by G_{i+1}; other columns are 0
  std::vector<bool> is_dense_;
  Eigen::VectorXd by_rise_, by_spin_;
  Eigen::MatrixX2d G_;
  Eigen::Vector2d shared_ = Eigen::Vector2d::Zero();  // derivative of the next share by this z
};

bool TreadBody::solve(const Eigen::VectorXd& q,
                      const RollingInput& input,
                      const GripTractions& tractions,
                      const Eigen::VectorXd& R,
                      Eigen::VectorXd& dq) {
  const auto m = std::ssize(rows_);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(size(), size());
  J.topLeftCorner(m, m) = T_;
  const Eigen::Matrix3Xd x = positions(q);
  for (std::size_t s = 0; s < sections_.size(); ++s)
    LineJacobian(
        *this, sections_[s], lines_.lines[s], input, tractions, x, rise(q), 1.0 + spin_change(q), J)
        .subtract();
  if (!solve_refined(J, R, dq)) return false;
  double share = 1.0;
  if (load_) share = std::min(share, kMostRise / std::abs(dq[rise_at()]));
  if (drive_) share = std::min(share, kMostTurn / std::abs(dq[spin_at()]));
  if (share < 1.0) dq *= share;
  return true;
}

}  // namespace latsch::fe_tire
