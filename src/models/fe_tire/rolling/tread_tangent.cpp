// SPDX-License-Identifier: Apache-2.0
// The Jacobian of a tread that rolls, and the solution of its equations (tread_body.h).
//
// The forces of a line's points depend on the nodes by the points' positions alone:
//   dF = B dx,   dx = w dq,   so   dF/dq = B w
// B follows point by point, and one matrix product a direction gives the derivatives of a line.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "models/fe_tire/rolling/tread_body.h"
#include "numerics/dense/dense_products.h"
#include "numerics/dense/lu.h"
#include "numerics/sparse/front_algebra.h"

namespace latsch::fe_tire {
namespace {

/// Relative residual of a refined solution, and most refinements. A matrix that needs more is
/// factorized in double precision.
constexpr double kRefined = 1e-11;
constexpr int kMostRefinements = 6;
/// Largest rise, m, and change of the spin of one step: a tire that slides as a whole has no
/// useful slope.
constexpr double kMostRise = 2e-3, kMostTurn = 0.02;

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

void subtract_at(const std::vector<int>& rows,
                 const Eigen::Ref<const Eigen::VectorXd>& part,
                 Eigen::Ref<Eigen::VectorXd> of) {
  for (std::size_t a = 0; a < rows.size(); ++a) of[rows[a]] -= part[static_cast<Eigen::Index>(a)];
}

}  // namespace

/// Derivatives of the forces on a line's points, and of load and drive, by the points' positions.
/// Rows are the unknowns of the line's nodes, then load and drive where they are asked for. G_i,
/// the derivative of all forces with respect to the traction at point i, follows from that at
/// i + 1, against the flow:
///   G_i = L_i + G_{i+1} by_before_{i+1},   dF = sum_i G_i [by_step (dx_i - dx_{i-1}) + ...]
/// Successive points that stick leave nothing of G_{i+1} in the derivative by x_i.
class TreadBody::LineTangent {
 public:
  LineTangent(const TreadBody& body,
              const RollingInput& input,
              const GripTractions& tractions,
              const Eigen::Matrix3Xd& x,
              double rise,
              double faster)
      : body_(body), input_(input), tractions_(tractions), x_(x), rise_(rise), faster_(faster) {}

  /// Finds the derivatives of a line.
  void find(const Section& section, const RollingLines::Line& line) {
    section_ = &section;
    line_ = line;
    nodes_ = section.w.cols();
    const Eigen::Index rows = load_row() + (body_.load_ ? 1 : 0) + (body_.drive_ ? 1 : 0);
    for (Eigen::MatrixXd& B : B_) B.setZero(rows, line.last - line.first);
    G_.setZero(rows, 2);
    shared_.setZero();
    by_rise_.setZero(rows);
    by_spin_.setZero(rows);
    const auto [first, last] = acting(line, input_);
    first_ = first;
    count_ = std::max(0, last - first_);
    for (int k = last - 1; k >= first_; --k) step(k);
    if (body_.load_) by_rise_ += B_[2].rowwise().sum();
  }

  /// Computes T <- beta T + the derivatives by the section's columns [rows x columns].
  void add_by_nodes(double beta, Eigen::MatrixXd& T) const {
    const auto w = section_->w.middleRows(first_ - line_.first, count_);
    for (int c = 0; c < 3; ++c) {
      using EveryThird = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
      EveryThird by(T.col(c).data(), T.rows(), nodes_, Eigen::OuterStride<>(3 * T.rows()));
      const auto B = B_[c].middleCols(first_ - line_.first, count_);
      numerics::add_product<double>(1.0, B, w, beta, by);
    }
  }
  /// Derivatives by the rise of the wheel center and by the change of the spin, where these are
  /// unknowns.
  const Eigen::VectorXd& by_rise() const { return by_rise_; }
  const Eigen::VectorXd& by_spin() const { return by_spin_; }
  Eigen::Index load_row() const { return 3 * nodes_; }
  Eigen::Index drive_row() const { return load_row() + (body_.load_ ? 1 : 0); }

 private:
  /// Derivatives by the position of a point, in the axes of the surface: those that act by G_{i+1},
  /// 2 x 3.
  using Behind = Eigen::Matrix<double, 2, 3>;

  void step(int k) {
    const bool follows = k + 1 < line_.last && input_.p[k + 1] > 0.0;
    const GripLink none, &next = follows ? tractions_.links[k + 1] : none;
    Behind behind;
    behind << -next.now * next.by_step, shared_;
    shared_.setZero();
    if (!(input_.p[k] > 0.0)) {
      act_behind(k, behind);
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
    act_behind(k, behind);
    const Eigen::Matrix3d& turn = body_.turn_[k];
    Eigen::Matrix3d force;
    force << area * own, 0.0, 0.0, area * stiff;
    force = (turn.transpose() * force * turn).eval();
    act_locally(k, force);
    const Eigen::Vector3d arm = moment_arm(k);
    if (body_.drive_) add_drive(k, force, arm);
    G_ = (G_ * next.by_before).eval();
    const Eigen::Matrix<double, 3, 2> along = area * turn.topRows<2>().transpose();
    for (Eigen::Index a = 0; a < nodes_; ++a) G_.middleRows<3>(3 * a) += weight(k, a) * along;
    // On a drum tractions carry a part of the load.
    if (body_.load_) G_.row(load_row()) -= along.row(2);
    if (!body_.drive_) return;
    G_.row(drive_row()) += (arm.transpose() * along) / body_.hub_.z();
    by_spin_ += G_ * (link.by_step * input_.V_g.col(k) * (body_.lines_.time[k] / faster_));
  }

  double weight(int k, Eigen::Index node) const { return section_->w(k - line_.first, node); }

  /// Adds the derivatives of a point's own force by its position, and of the load.
  void act_locally(int k, const Eigen::Matrix3d& force) {
    for (int c = 0; c < 3; ++c) {
      auto column = B_[c].col(k - line_.first);
      for (Eigen::Index a = 0; a < nodes_; ++a)
        column.segment<3>(3 * a) += weight(k, a) * force.col(c);
      if (body_.load_) column[load_row()] -= force(2, c);
    }
  }

  void act_behind(int k, const Behind& behind) {
    if (behind.isZero(0.0)) return;
    const Behind by = behind * body_.turn_[k];
    for (int c = 0; c < 3; ++c) B_[c].col(k - line_.first) += G_ * by.col(c);
  }

  /// Returns axis x arm; the moment of the drive is -force . (axis x arm).
  Eigen::Vector3d moment_arm(int k) const {
    const Eigen::Vector3d hub = body_.hub_ + Eigen::Vector3d(0.0, 0.0, rise_);
    return body_.axis_.cross(body_.place(k, input_) - hub);
  }

  /// Adds the derivatives of the drive's moment with respect to the position of a point.
  /// `by_position` contains the derivatives of the point's force with respect to this position.
  void add_drive(int k, const Eigen::Matrix3d& by_position, const Eigen::Vector3d& arm) {
    const double height = body_.hub_.z();
    Eigen::RowVector3d by = arm.transpose() * by_position / height;
    // The place of the force moves along the surface, and its arm grows with the height.
    const Eigen::Vector3d turned = body_.force(k, input_, tractions_).cross(body_.axis_) / height;
    const auto along = body_.turn_[k].topRows<2>();
    by += (along * turned).transpose() * along;
    for (int c = 0; c < 3; ++c) B_[c](drive_row(), k - line_.first) += by[c];
    by_rise_[drive_row()] -= turned.z();
  }

  const TreadBody& body_;
  const RollingInput& input_;
  const GripTractions& tractions_;
  const Eigen::Matrix3Xd& x_;
  double rise_, faster_;
  const Section* section_ = nullptr;
  RollingLines::Line line_{0, 0};
  Eigen::Index nodes_ = 0;
  int first_ = 0, count_ = 0;  // points of the line that act
  std::array<Eigen::MatrixXd, 3> B_;
  Eigen::VectorXd by_rise_, by_spin_;
  Eigen::MatrixX2d G_;
  Eigen::Vector2d shared_ = Eigen::Vector2d::Zero();  // derivative of the next share by this z
};

/// Returns the points of a line that act, [first, last): points before and behind those that touch
/// cause no force; the one before the first is where its step begins.
std::pair<int, int> TreadBody::acting(const RollingLines::Line& line, const RollingInput& input) {
  int first = line.last, last = line.first;
  for (int k = line.first; k < line.last; ++k) {
    if (!(input.p[k] > 0.0)) continue;
    first = std::min(first, std::max(k - 1, line.first));
    last = k + 1;
  }
  return {first, last};
}

/// Returns the nodes on which the acting points of lines `first` to `last` - 1 depend, which have
/// the same columns. Weights are left out.
TreadBody::Section TreadBody::touched_section(std::size_t first,
                                              std::size_t last,
                                              const RollingInput& input) const {
  const Section& whole = sections_[first];
  std::vector<char> is_touched(whole.columns.size() / 3, 0);
  for (std::size_t s = first; s < last; ++s) {
    const auto [begin, end] = acting(lines_.lines[s], input);
    for (int k = begin; k < end; ++k)
      for (std::size_t a = 0; a < is_touched.size(); ++a)
        if (sections_[s].w(k - lines_.lines[s].first, static_cast<Eigen::Index>(a)) != 0.0)
          is_touched[a] = 1;
  }
  Section touched;
  for (std::size_t a = 0; a < is_touched.size(); ++a)
    if (is_touched[a] != 0)
      touched.columns.insert(touched.columns.end(),
                             whole.columns.begin() + 3 * static_cast<std::ptrdiff_t>(a),
                             whole.columns.begin() + 3 * static_cast<std::ptrdiff_t>(a) + 3);
  return touched;
}

std::vector<TreadBody::Part> TreadBody::by_nodes(const Eigen::VectorXd& q,
                                                 const RollingInput& input,
                                                 const GripTractions& tractions) const {
  assert(!load_ && !drive_);
  const Eigen::Matrix3Xd x = positions(q);
  LineTangent tangent(*this, input, tractions, x, 0.0, 1.0);
  std::vector<Part> parts;
  std::size_t last = 0;
  for (std::size_t first = 0; first < sections_.size(); first = last) {
    const std::vector<int>& columns = sections_[first].columns;
    while (last < sections_.size() && sections_[last].columns == columns) ++last;
    Section touched = touched_section(first, last, input);
    if (touched.columns.empty()) continue;
    std::vector<Eigen::Index> nodes;  // among those of the section
    for (std::size_t at = 0, a = 0; a < touched.columns.size(); a += 3) {
      while (columns[at] != touched.columns[a]) at += 3;
      nodes.push_back(static_cast<Eigen::Index>(at / 3));
    }
    const auto size = std::ssize(touched.columns);
    Part part{touched.columns, Eigen::MatrixXd::Zero(size, size)};
    for (std::size_t s = first; s < last; ++s) {
      touched.w = sections_[s].w(Eigen::all, nodes);
      tangent.find(touched, lines_.lines[s]);
      tangent.add_by_nodes(1.0, part.C);
    }
    for (Eigen::Index b = 0; b < size; b += 3)
      for (Eigen::Index a = 0; a < size; a += 3)
        part.C.block<3, 3>(a, b) = (turns_[part.rows[a] / 3].transpose() *
                                    part.C.block<3, 3>(a, b) * turns_[part.rows[b] / 3])
                                       .eval();
    parts.push_back(std::move(part));
  }
  return parts;
}

Eigen::MatrixXd TreadBody::jacobian(const Eigen::VectorXd& q,
                                    const RollingInput& input,
                                    const GripTractions& tractions) const {
  const auto m = std::ssize(rows_);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(size(), size());
  J.topLeftCorner(m, m) = T_;
  const Eigen::Matrix3Xd x = positions(q);
  LineTangent tangent(*this, input, tractions, x, rise(q), 1.0 + spin_change(q));
  Eigen::MatrixXd by_nodes;  // [rows of the tangent x unknowns of the section]
  std::vector<int> rows;
  for (std::size_t s = 0; s < sections_.size(); ++s) {
    const Section& section = sections_[s];
    tangent.find(section, lines_.lines[s]);
    const bool is_first = s == 0 || section.columns != sections_[s - 1].columns;
    if (is_first) {
      rows = section.columns;
      if (load_) rows.push_back(rise_at());
      if (drive_) rows.push_back(spin_at());
      by_nodes.resize(std::ssize(rows), std::ssize(section.columns));
    }
    tangent.add_by_nodes(is_first ? 0.0 : 1.0, by_nodes);
    if (load_) subtract_at(rows, tangent.by_rise(), J.col(rise_at()));
    if (drive_) subtract_at(rows, tangent.by_spin(), J.col(spin_at()));
    // Neighboring lines mostly depend on the same nodes.
    if (s + 1 < sections_.size() && sections_[s + 1].columns == section.columns) continue;
    for (Eigen::Index b = 0; b < by_nodes.cols(); ++b)
      subtract_at(rows, by_nodes.col(b), J.col(section.columns[b]));
  }
  return J;
}

bool TreadBody::solve(const Eigen::VectorXd& q,
                      const RollingInput& input,
                      const GripTractions& tractions,
                      const Eigen::VectorXd& R,
                      Eigen::VectorXd& dq) {
  if (!solve_refined(jacobian(q, input, tractions), R, dq)) return false;
  double share = 1.0;
  if (load_) share = std::min(share, kMostRise / std::abs(dq[rise_at()]));
  if (drive_) share = std::min(share, kMostTurn / std::abs(dq[spin_at()]));
  if (share < 1.0) dq *= share;
  return true;
}

}  // namespace latsch::fe_tire
