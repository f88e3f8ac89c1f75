// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/tread_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace latsch::fe_tire {
namespace {

/// Depth to which the lowest point is pressed if none touches, m: its pressure is then that of a
/// tire.
constexpr double kTouch = 1e-5;

/// Returns the nodes on which points `first` to `last` of a line depend, ascending, and sets their
/// places in this list.
std::vector<int> nodes_of(const TreadSurface& tread,
                          const std::vector<int>& line,
                          int first,
                          int last,
                          std::vector<int>& place) {
  std::vector<int> nodes;
  int cell = -1;
  for (int k = first; k <= last; ++k) {
    const TreadSurface::Point& point = tread.points()[line[k]];
    if (point.cell == cell) continue;
    cell = point.cell;
    const std::vector<int>& of_cell = tread.cell_nodes()[cell];
    nodes.insert(nodes.end(), of_cell.begin(), of_cell.end());
  }
  std::ranges::sort(nodes);
  nodes.erase(std::ranges::unique(nodes).begin(), nodes.end());
  for (std::size_t a = 0; a < nodes.size(); ++a) place[nodes[a]] = static_cast<int>(a);
  return nodes;
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
  std::vector<int> place(tread.nodes(), -1);
  for (const std::vector<int>& line : lines.lines)
    add_line(tread, lines, line, height, near, place);
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

/// Adds the part of a line that is near the ground, and the point before it. `place` is memory for
/// the places of nodes in a section.
void TreadBody::add_line(const TreadSurface& tread,
                         const TreadLines& lines,
                         const std::vector<int>& of,
                         const Eigen::VectorXd& height,
                         double near,
                         std::vector<int>& place) {
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
  const std::vector<int> nodes = nodes_of(tread, of, first, last, place);
  for (const int node : nodes)
    for (int k = 0; k < 3; ++k) section.columns.push_back(3 * node + k);
  section.w.setZero(last - first + 1, std::ssize(nodes));
  for (int k = first; k <= last; ++k) {
    const TreadSurface::Point& point = tread.points()[of[k]];
    for (int w = 0; w < point.weights; ++w) {
      const TreadSurface::Weight& weight = tread.weights(point)[w];
      const int node = tread.places()[weight.place].node;
      if (node >= 0) section.w(k - first, place[node]) += weight.w;
    }
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
  r_ = to_ground(r_);
}

Eigen::VectorXd TreadBody::to_nodes(const Eigen::VectorXd& q) const {
  Eigen::VectorXd at(std::ssize(rows_));
  for (int a = 0; a < std::ssize(turns_); ++a)
    at.segment<3>(3 * a) = turns_[a].transpose() * q.segment<3>(3 * a);
  return at;
}

Eigen::VectorXd TreadBody::to_ground(const Eigen::VectorXd& at_nodes) const {
  Eigen::VectorXd turned(std::ssize(rows_));
  for (int a = 0; a < std::ssize(turns_); ++a)
    turned.segment<3>(3 * a) = turns_[a] * at_nodes.segment<3>(3 * a);
  return turned;
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
    const auto by_nodes = moved.reshaped(3, moved.size() / 3);
    const Eigen::Matrix3Xd by = by_nodes * sections_[s].w.transpose();
    for (int k = line.first; k < line.last; ++k)
      x.col(k) = x_0_[k] + turn_[k] * (up + by.col(k - line.first));
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
    Eigen::Matrix3Xd on_points = Eigen::Matrix3Xd::Zero(3, line.last - line.first);
    for (int k = line.first; k < line.last; ++k)
      if (input.p[k] > 0.0) on_points.col(k - line.first) = force(k, input, tractions);
    const Eigen::Matrix3Xd on = on_points * sections_[s].w;
    sum(sections_[s].columns) += on.reshaped();
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

}  // namespace latsch::fe_tire
