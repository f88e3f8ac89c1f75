// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/linear_tire.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "numerics/sparse/elimination.h"
#include "numerics/sparse/front_algebra.h"

namespace latsch::fe_tire {
namespace {

// Largest number of nodes for which the elimination order `whole` is reused. For a larger tire,
// computing a new nested dissection costs less than its better order saves, 6 to 20 % of the
// operations.
constexpr int kFewRows = 10'000;

// Largest number of iterations in which touching points change. When an iteration leaves the set of
// touching points unchanged, its solution is exact.
constexpr int kMostContactChanges = 30;
constexpr double kExact = 1e-8;  // tolerance relative to g; the matrix S has single precision
// Shares of the largest depth at which the undeformed tire would penetrate the ground. Points
// deeper than kWithin times this depth are expected to touch, because a deformed tire touches in a
// smaller area than its undeformed outline cuts from the ground. A new condensed tire includes more
// points, those deeper than kWithinReach times this depth minus kNearGround, so that it can be used
// longer.
constexpr double kWithin = 0.35, kWithinReach = 0.2;
constexpr double kNearGround = 0.2e-3;  // m
// An old factorization of the ground's tangent is used as long as its step leaves at most this
// share of the residual.
constexpr double kOfUse = 0.3;
// Smallest share of a step that the line search in all directions tries, and the share of the
// residual that the step must remove.
constexpr double kSmallestShare = 1.0 / 300.0, kDecrease = 0.1;

/// Returns an orthonormal matrix: two directions at right angles to `up`, then `up`, as columns.
Eigen::Matrix3d across_and_up(const Eigen::Vector3d& up) {
  Eigen::Matrix3d Q;
  Q.col(0) = up.unitOrthogonal();
  Q.col(1) = up.cross(Q.col(0));
  Q.col(2) = up;
  return Q;
}

/// Returns the vertical direction in the frame of each node's unknowns. A node and its image under
/// the half turn have the same.
std::vector<Eigen::Vector3d> verticals(const TreadSurface& tread) {
  std::vector<Eigen::Vector3d> up(tread.nodes(), Eigen::Vector3d::UnitZ());
  for (const TreadSurface::Place& place : tread.places()) {
    // Nodes on the axis of the half turn move only along it; the directions at right angles to it
    // are held.
    if (place.node >= 0) up[place.node] = place.T.row(2).normalized();
  }
  return up;
}

/// Returns the contact forces on the heights of the nodes.
Eigen::VectorXd forces_by_heights(const TreadSurface& tread,
                                  const std::vector<TreadContact::Touch>& touches) {
  Eigen::VectorXd c = Eigen::VectorXd::Zero(tread.nodes());
  for (const TreadContact::Touch& touch : touches) {
    const TreadSurface::Point& point = tread.points()[touch.point];
    for (int k = 0; k < point.weights; ++k) {
      const TreadSurface::Weight& weight = tread.weights(point)[k];
      const int node = tread.places()[weight.place].node;
      if (node >= 0) c[node] -= weight.w * touch.force.z();
    }
  }
  return c;
}

/// Returns the derivative of the contact forces with respect to the heights of the nodes. Every
/// touching point is a spring. The points of a cell together add a small block for the nodes of
/// this cell.
Eigen::MatrixXd stiffness_by_heights(const TreadSurface& tread,
                                     const std::vector<TreadContact::Touch>& touches) {
  const auto of_cell = by_cells(tread, touches);
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(tread.nodes(), tread.nodes()), roots, square;
  std::vector<int> row(tread.nodes(), -1);
  for (std::size_t cell = 0; cell < of_cell.size(); ++cell) {
    if (of_cell[cell].empty()) continue;
    const std::vector<int>& nodes = tread.cell_nodes()[cell];
    const int size = static_cast<int>(nodes.size());
    const int springs = static_cast<int>(of_cell[cell].size());
    for (int k = 0; k < size; ++k) row[nodes[k]] = k;
    roots.setZero(size, springs);
    for (int t = 0; t < springs; ++t) {
      const TreadContact::Touch& touch = *of_cell[cell][t];
      const TreadSurface::Point& point = tread.points()[touch.point];
      const double root = std::sqrt(touch.stiffness(2, 2));
      for (int k = 0; k < point.weights; ++k) {
        const TreadSurface::Weight& weight = tread.weights(point)[k];
        const int node = tread.places()[weight.place].node;
        if (node >= 0) roots(row[node], t) += root * weight.w;
      }
    }
    square.resize(size, size);
    numerics::negative_square(size, springs, roots.data(), size, square.data());
    for (int b = 0; b < size; ++b) {
      for (int a = b; a < size; ++a) {
        C(nodes[a], nodes[b]) -= square(a, b);
        if (a != b) C(nodes[b], nodes[a]) -= square(a, b);
      }
    }
  }
  return C;
}

/// Returns the rows of the nodes on which the touching points act, ascending. `first_row` holds a
/// row for every node.
std::vector<int> touched(const TreadSurface& tread,
                         const std::vector<int>& first_row,
                         const std::vector<TreadContact::Touch>& touches) {
  std::vector<int> rows;
  std::vector<bool> is_touched(tread.nodes());
  for (const TreadContact::Touch& touch : touches) {
    for (const int node : tread.nodes_of(tread.points()[touch.point])) is_touched[node] = true;
  }
  for (int node = 0; node < tread.nodes(); ++node) {
    for (int k = 0; is_touched[node] && k < 3; ++k) rows.push_back(first_row[node] + k);
  }
  return rows;
}

/// Adds the force of a touching point to the forces on the nodes' unknowns.
void add_force(const TreadSurface& tread, const TreadContact::Touch& touch, Eigen::VectorXd& c) {
  const TreadSurface::Point& point = tread.points()[touch.point];
  const TreadSurface::Weight* weights = tread.weights(point);
  for (int j = 0; j < point.weights; ++j) {
    const TreadSurface::Place& place = tread.places()[weights[j].place];
    if (place.node < 0) continue;
    c.segment<3>(3 * place.node) -= weights[j].w * (place.T.transpose() * touch.force);
  }
}

/// Adds the stiffness of a touching point to the tangent. `first` holds the first row of each node
/// in the tangent.
void add_tangent(const TreadSurface& tread,
                 const TreadContact::Touch& touch,
                 const std::vector<int>& first,
                 GroundTangent& tangent) {
  const TreadSurface::Point& point = tread.points()[touch.point];
  const TreadSurface::Weight* weights = tread.weights(point);
  const bool slides = !touch.coupling.isZero(0.0);
  if (slides && tangent.coupling.size() == 0)
    tangent.coupling.setZero(tangent.stiffness.rows(), tangent.stiffness.cols());
  for (int j = 0; j < point.weights; ++j) {
    const TreadSurface::Place& place = tread.places()[weights[j].place];
    if (place.node < 0) continue;
    const Eigen::Matrix3d turned = weights[j].w * touch.stiffness * place.T;
    const Eigen::Matrix3d slid = weights[j].w * touch.coupling * place.T;
    for (int i = 0; i < point.weights; ++i) {
      const TreadSurface::Place& other = tread.places()[weights[i].place];
      if (other.node < 0) continue;
      const int row = first[other.node], column = first[place.node];
      tangent.stiffness.block<3, 3>(row, column) += weights[i].w * (other.T.transpose() * turned);
      if (slides) {
        tangent.coupling.block<3, 3>(row, column) += weights[i].w * (other.T.transpose() * slid);
      }
    }
  }
}

}  // namespace

LinearTire::LinearTire(const numerics::SymmetricPattern& pattern,
                       const numerics::Elimination& whole,
                       const TreadSurface& tread)
    : tread_(tread),
      factor_(pattern,
              numerics::Precision::single,
              std::make_shared<const numerics::Elimination>(
                  pattern.block_rows() <= kFewRows
                      ? numerics::eliminate(pattern, tread.block_rows(), whole)
                      : numerics::eliminate(pattern, tread.block_rows()))),
      n_(tread.nodes()) {
  for (const Eigen::Vector3d& up : verticals(tread)) Q_.push_back(across_and_up(up));
}

bool LinearTire::factorize(const numerics::SymmetricMatrix& K, const TreadContact* contact) {
  on_ground_ = contact != nullptr && n_ > 0;
  ahead_.resize(0);
  if (!on_ground_) return factor_.factorize(K).definite();
  if (!factor_.condense(K).definite()) return false;
  kept_ = contact->is_by_height() ? 1 : 3;
  if (kept_ == 1) return condense_to_heights();
  is_reached_.clear();
  return true;
}

bool LinearTire::serves(const TreadContact* contact) const {
  if (contact == nullptr || n_ == 0) return !on_ground_;
  return on_ground_ && kept_ == (contact->is_by_height() ? 1 : 3);
}

/// Transforms the nodes' unknowns to horizontal and vertical components, and eliminates the
/// horizontal ones.
bool LinearTire::condense_to_heights() {
  springs_.reset();
  const Eigen::MatrixXd interface = factor_.condensed();
  A_.resize(3 * n_, 3 * n_);
  const auto place = [this](int node, int k) { return k < 2 ? 2 * node + k : 2 * n_ + node; };
  for (int b = 0; b < n_; ++b) {
    for (int a = 0; a < n_; ++a) {
      const Eigen::Matrix3d block = Q_[a].transpose() * interface.block<3, 3>(3 * a, 3 * b) * Q_[b];
      for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) A_(place(a, i), place(b, j)) = block(i, j);
      }
    }
  }
  const int across = 2 * n_, ld = 3 * n_;
  if (!numerics::cholesky(across, A_.data(), ld)) return false;
  S_.resize(n_, n_);
  numerics::solve_right_transposed(n_, across, A_.data(), ld, A_.data() + across);
  numerics::negative_square(n_, across, A_.data() + across, ld, S_.data());
  S_ += A_.bottomRightCorner(n_, n_);
  S_.triangularView<Eigen::StrictlyUpper>() = S_.transpose();
  return true;
}

/// Forward elimination of a right-hand side v. Returns what remains for the unknowns that are not
/// eliminated.
Eigen::VectorXd LinearTire::reduce(Eigen::VectorXd& v) const {
  factor_.reduce(v);
  if (kept_ == 3) return at_nodes(v);
  Eigen::VectorXd across(2 * n_), heights(n_), coupled(n_);
  for (int a = 0; a < n_; ++a) {
    const Eigen::Vector3d turned = Q_[a].transpose() * v.segment<3>(3 * tread_.block_rows()[a]);
    across.segment<2>(2 * a) = turned.head<2>();
    heights[a] = turned.z();
  }
  const int ld = 3 * n_;
  numerics::solve_lower(2 * n_, 1, A_.data(), ld, across.data(), 2 * n_);
  numerics::multiply(n_, 1, 2 * n_, A_.data() + 2 * n_, ld, across.data(), 2 * n_, coupled.data());
  for (int a = 0; a < n_; ++a) {
    v.segment<2>(3 * tread_.block_rows()[a]) = across.segment<2>(2 * a);
  }
  return heights - coupled;
}

/// Back substitution: computes all unknowns v from those that are not eliminated, w.
void LinearTire::expand(const Eigen::VectorXd& w, Eigen::VectorXd& v) const {
  if (kept_ == 3) {
    for (int a = 0; a < n_; ++a) {
      v.segment<3>(3 * tread_.block_rows()[a]) = w.segment<3>(3 * a);
    }
    factor_.expand(v);
    return;
  }
  Eigen::VectorXd across(2 * n_);
  for (int a = 0; a < n_; ++a) {
    across.segment<2>(2 * a) = v.segment<2>(3 * tread_.block_rows()[a]);
  }
  const int ld = 3 * n_;
  numerics::subtract_transposed(
      2 * n_, 1, n_, A_.data() + 2 * n_, ld, w.data(), across.data(), 2 * n_);
  numerics::solve_lower_transposed(2 * n_, 1, A_.data(), ld, across.data(), 2 * n_);
  for (int a = 0; a < n_; ++a) {
    v.segment<3>(3 * tread_.block_rows()[a]) =
        Q_[a] * Eigen::Vector3d(across[2 * a], across[2 * a + 1], w[a]);
  }
  factor_.expand(v);
}

/// Returns the components of a vector of unknowns that are not eliminated.
Eigen::VectorXd LinearTire::at_nodes(const Eigen::VectorXd& v) const {
  Eigen::VectorXd kept(kept_ * n_);
  for (int a = 0; a < n_; ++a) {
    const Eigen::Vector3d at = v.segment<3>(3 * tread_.block_rows()[a]);
    if (kept_ == 1) {
      kept[a] = Q_[a].col(2).dot(at);
    } else {
      kept.segment<3>(3 * a) = at;
    }
  }
  return kept;
}

void LinearTire::add_at_nodes(double factor, const Eigen::VectorXd& w, Eigen::VectorXd& v) const {
  for (int a = 0; a < n_; ++a) {
    const Eigen::Vector3d turned =
        kept_ == 1 ? Eigen::Vector3d(w[a] * Q_[a].col(2)) : Eigen::Vector3d(w.segment<3>(3 * a));
    v.segment<3>(3 * tread_.block_rows()[a]) += factor * turned;
  }
}

/// Returns u - w.
Eigen::Matrix3Xd LinearTire::moved_back(const Eigen::VectorXd& w) const {
  Eigen::Matrix3Xd u = u_;
  for (int a = 0; a < n_; ++a) {
    if (kept_ == 1) {
      u.col(a) -= w[a] * Q_[a].col(2);
    } else {
      u.col(a) -= w.segment<3>(3 * a);
    }
  }
  return u;
}

/// Returns the ground's forces c(u - w), N, on the unknowns that are not eliminated.
Eigen::VectorXd LinearTire::forces_by_nodes(const TreadContact& contact,
                                            const Eigen::VectorXd& w) const {
  Eigen::VectorXd c = Eigen::VectorXd::Zero(3 * n_);
  for (const TreadContact::Touch& touch : contact.touches(moved_back(w)))
    add_force(tread_, touch, c);
  return c;
}

/// Returns the forces of the points within the ground's reach. They depend only on nodes within
/// reach.
Eigen::VectorXd LinearTire::forces_within_reach(const TreadContact& contact,
                                                const Eigen::VectorXd& w,
                                                GroundTangent* tangent) const {
  Eigen::VectorXd c = Eigen::VectorXd::Zero(3 * n_);
  auto touches = contact.touches(moved_back(beyond_reach_too(w)));
  std::erase_if(touches, [this](const TreadContact::Touch& t) { return !is_reached_[t.point]; });
  for (const TreadContact::Touch& touch : touches) add_force(tread_, touch, c);
  if (tangent) {
    tangent->rows = touched(tread_, first_row_, touches);
    std::vector<int> first(n_, -1);
    for (int node = 0, k = 0; node < n_; ++node) {
      if (k < std::ssize(tangent->rows) && tangent->rows[k] == first_row_[node]) {
        first[node] = k;
        k += 3;
      }
    }
    tangent->stiffness.setZero(std::ssize(tangent->rows), std::ssize(tangent->rows));
    tangent->coupling.resize(0, 0);
    for (const TreadContact::Touch& touch : touches) add_tangent(tread_, touch, first, *tangent);
  }
  return c(by_nodes_.reached());
}

/// Extends w to all nodes with zeros for the nodes beyond the ground's reach.
Eigen::VectorXd LinearTire::beyond_reach_too(const Eigen::VectorXd& w) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(3 * n_);
  all(by_nodes_.reached()) = w;
  return all;
}

/// Solves S w = g + c(u - w) for the heights alone. C_ and L_ become the tangent of the touching
/// points and the factorization; they are reused if the same points touch as last time.
bool LinearTire::touch_by_heights(const TreadContact& contact, const Eigen::VectorXd& g) {
  w_.setZero(g.size());
  for (int change = 0; change < kMostContactChanges; ++change) {
    const std::vector<TreadContact::Touch> touches = contact.touches(moved_back(w_));
    c_ = forces_by_heights(tread_, touches);
    Eigen::VectorXd left = g + c_ - S_ * w_;
    std::vector<std::pair<int, double>> springs;
    springs.reserve(touches.size());
    for (const TreadContact::Touch& touch : touches)
      springs.emplace_back(touch.point, touch.stiffness(2, 2));
    const bool same = springs_ == springs;
    if (change > 0 && same && left.norm() <= kExact * (g.norm() + c_.norm())) return true;
    if (!same) {
      springs_.reset();
      if (!factorize_contact(stiffness_by_heights(tread_, touches))) return false;
      springs_ = std::move(springs);
    }
    solve_contact(left);
    w_ += left;
  }
  c_ = forces_by_heights(tread_, contact.touches(moved_back(w_)));
  // An inexact solution is accepted here, because the residual of all forces is checked afterwards.
  return true;
}

/// Adds points to those that the ground may reach. Returns false if the condensed stiffness of all
/// other nodes is not positive definite.
bool LinearTire::reach(const std::vector<int>& points) {
  is_reached_.resize(tread_.points().size(), 0);
  for (const int point : points) is_reached_[point] = 1;
  first_row_.assign(n_, -1);
  for (std::size_t point = 0; point < is_reached_.size(); ++point) {
    if (!is_reached_[point]) continue;
    for (const int node : tread_.nodes_of(tread_.points()[point])) first_row_[node] = 0;
  }
  std::vector<int> rows;
  for (int node = 0; node < n_; ++node) {
    if (first_row_[node] < 0) continue;
    first_row_[node] = static_cast<int>(rows.size());
    for (int k = 0; k < 3; ++k) rows.push_back(3 * node + k);
  }
  return by_nodes_.set(factor_.condensed(), rows);
}

bool LinearTire::reaches(const std::vector<int>& points) const {
  return !is_reached_.empty() &&
         std::ranges::all_of(points, [this](int point) { return is_reached_[point] != 0; });
}

/// Adds the points that the ground in its pose is likely to reach if the tire is displaced by -w.
bool LinearTire::reach_likely(const TreadContact& contact, const Eigen::VectorXd& w) {
  const Eigen::Matrix3Xd u = moved_back(w);
  const double deepest = contact.deepest(u);
  if (reaches(contact.within(-kWithin * deepest, u))) return true;
  return reach(contact.within(kNearGround - kWithinReach * deepest, u));
}

/// Solves S w = g + c(u - w) in all directions, starting from the given w. The set of points within
/// the ground's reach is extended until no other point touches.
bool LinearTire::touch_by_nodes(const TreadContact& contact,
                                const Eigen::VectorXd& g,
                                Eigen::VectorXd& w) {
  if (!reach_likely(contact, w)) return false;
  for (;;) {
    Eigen::VectorXd all = g, within = by_nodes_.reduce(all);
    Eigen::VectorXd moved = w(by_nodes_.reached());
    if (!touch_within_reach(contact, within, moved)) return false;
    by_nodes_.expand(moved, all);
    if (reaches(contact.within(0.0, moved_back(all)))) {
      w = std::move(all);
      return true;
    }
    if (!reach(contact.within(kNearGround, moved_back(all)))) return false;
  }
}

/// Solves (L.1) for the points within the ground's reach. An old factorization is used while it
/// leaves a small residual. A point that slides may overshoot, so a step with a new factorization
/// is halved if it increases the residual.
bool LinearTire::touch_within_reach(const TreadContact& contact,
                                    const Eigen::VectorXd& g,
                                    Eigen::VectorXd& w) {
  Eigen::VectorXd c = forces_within_reach(contact, w, nullptr);
  Eigen::VectorXd left = g + c - by_nodes_.multiply(w);
  bool is_slow = !by_nodes_.has_factor();
  for (int change = 0; change < kMostContactChanges; ++change) {
    const double norm = left.norm();
    if (change > 0 && norm <= kExact * (g.norm() + c.norm())) break;
    if (is_slow) {
      forces_within_reach(contact, w, &tangent_);
      by_nodes_.factorize(tangent_);
    }
    Eigen::VectorXd step = left;
    by_nodes_.solve(step);
    const Eigen::VectorXd start = w;
    double least = std::numeric_limits<double>::infinity();
    for (double share = 1.0; share > kSmallestShare; share *= 0.5) {
      const Eigen::VectorXd there = start + share * step;
      const Eigen::VectorXd c_there = forces_within_reach(contact, there, nullptr);
      const Eigen::VectorXd left_there = g + c_there - by_nodes_.multiply(there);
      const double now = left_there.norm();
      if (!is_slow && !(now < kOfUse * norm)) break;
      if (now < least) {
        least = now;
        w = there;
        c = c_there;
        left = left_there;
      }
      if (now < (1.0 - kDecrease * share) * norm) break;
    }
    is_slow = !(least < kOfUse * norm);
  }
  forces_within_reach(contact, w, &tangent_);
  // An inexact solution is accepted here, because the residual of all forces is checked afterwards.
  return by_nodes_.is_positive();
}

/// Stores the tangent of the ground. L_ becomes the factorization of the tire together with it.
bool LinearTire::factorize_contact(const Eigen::MatrixXd& stiffness) {
  C_ = stiffness;
  L_ = S_ + C_;
  const int size = static_cast<int>(L_.rows());
  return numerics::cholesky(size, L_.data(), size);
}

void LinearTire::solve_contact(Eigen::VectorXd& v) const {
  const int size = static_cast<int>(L_.rows());
  numerics::solve_lower(size, 1, L_.data(), size, v.data(), size);
  numerics::solve_lower_transposed(size, 1, L_.data(), size, v.data(), size);
}

bool LinearTire::step(const TreadContact* contact,
                      const Eigen::VectorXd& x,
                      const Eigen::VectorXd& f,
                      Eigen::VectorXd& d) {
  d = g_ = f;
  if (!on_ground_) {
    factor_.solve(d);
    return true;
  }
  u_ = tread_.displacements(x);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(kept_ * n_);
  add_at_nodes(-1.0,
               kept_ == 1 ? forces_by_heights(tread_, contact->touches(u_))
                          : forces_by_nodes(*contact, none),
               d);
  g_ = d;
  const Eigen::VectorXd reduced = reduce(d);
  if (kept_ == 1) {
    if (!touch_by_heights(*contact, reduced)) return false;
  } else {
    // After the ground was moved along a path, the first guess is that the next motion is as long
    // as the last one.
    w_ = ahead_.size() > 0 ? ahead_ : none;
    ahead_.resize(0);
    if (!touch_by_nodes(*contact, reduced, w_)) return false;
    c_ = forces_by_nodes(*contact, w_);
  }
  expand(w_, d);
  return true;
}

bool LinearTire::follow(const numerics::SymmetricMatrix& K,
                        TreadContact& contact,
                        const Eigen::VectorXd& x,
                        const Eigen::VectorXd& g,
                        const std::vector<GroundPose>& poses) {
  assert(kept_ == 3);
  u_ = tread_.displacements(x);
  Eigen::VectorXd w = Eigen::VectorXd::Zero(3 * n_), w_before = w;
  if (!reach_likely(contact, w)) return false;
  // `beside` is a correction of g: with it, the factorization of an approximate K gives the
  // solution of (L.1) with the exact K. It is extrapolated from part to part.
  Eigen::VectorXd beside = Eigen::VectorXd::Zero(g.size()), beside_before = beside;
  for (std::size_t part = 0; part < poses.size(); ++part) {
    contact.move(poses[part]);
    const Eigen::VectorXd w_last = w, beside_last = beside;
    w += w - w_before;
    beside += beside - beside_before;
    w_before = w_last;
    beside_before = beside_last;
    for (int round = part == 0 ? 0 : 1; round < 2; ++round) {
      Eigen::VectorXd d = g + beside, Kd(g.size());
      if (!touch_by_nodes(contact, reduce(d), w)) return false;
      expand(w, d);
      K.multiply(d.data(), Kd.data());
      beside += g - Kd;
      add_at_nodes(1.0, forces_by_nodes(contact, w), beside);
    }
    const Eigen::Matrix3Xd there = moved_back(w);
    contact.start(poses[part], there, contact.anchors(there));
  }
  ahead_ = w + (w - w_before);
  return true;
}

Eigen::VectorXd LinearTire::residual(const numerics::SymmetricMatrix& K,
                                     const Eigen::VectorXd& d) const {
  Eigen::VectorXd Kd(d.size());
  K.multiply(d.data(), Kd.data());
  Eigen::VectorXd left = g_ - Kd;
  if (on_ground_) add_at_nodes(1.0, c_, left);
  return left;
}

void LinearTire::multiply(const numerics::SymmetricMatrix& K,
                          const Eigen::VectorXd& v,
                          Eigen::VectorXd& Kv) const {
  K.multiply(v.data(), Kv.data());
  if (!on_ground_) return;
  const Eigen::VectorXd kept = at_nodes(v);
  if (kept_ == 1) {
    add_at_nodes(1.0, C_ * kept, Kv);
    return;
  }
  Eigen::VectorXd by_ground = Eigen::VectorXd::Zero(3 * n_);
  by_ground(by_nodes_.reached()) = product(tangent_, kept(by_nodes_.reached()));
  add_at_nodes(1.0, by_ground, Kv);
}

void LinearTire::precondition(Eigen::VectorXd& v) const {
  if (!on_ground_) {
    factor_.solve(v);
    return;
  }
  Eigen::VectorXd w = reduce(v);
  if (kept_ == 1) {
    solve_contact(w);
  } else {
    Eigen::VectorXd within = by_nodes_.reduce(w);
    by_nodes_.solve(within);
    by_nodes_.expand(within, w);
  }
  expand(w, v);
}

}  // namespace latsch::fe_tire
