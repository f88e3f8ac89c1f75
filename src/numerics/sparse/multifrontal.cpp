// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/multifrontal.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "numerics/dense/large_array.h"
#include "numerics/sparse/columns_together.h"
#include "numerics/sparse/front_algebra.h"

namespace latsch::numerics {
namespace {

constexpr int kColumnsTogether = 32;  // right-hand sides

/// Successive rows of a front's update matrix that are added to successive rows of the target.
struct Run {
  int start, target, length;
};

/// Sizes and positions of a front, in unknowns. They follow from the pattern alone, before the
/// matrix has values.
struct FrontPlan {
  int first, pivots, rows;
  int parent;
  size_t panel;  // start of the front's columns in the array of the factor
  // Index of its first entry of the matrix; entries end at that of the next front.
  size_t first_entry;
  int stack;                   // index of the stack that holds its update matrix
  std::vector<Run> in_vector;  // rows below the pivots, in the order of elimination
  std::vector<Run> in_parent;  // rows below the pivots, in the parent's front

  int below() const { return rows - pivots; }
};

/// A block of the matrix (column-major) and the index of its first number in the panel of the
/// front.
struct Entry {
  int source;
  bool transposed;
  size_t target;
};

std::vector<Run> runs(const std::vector<int>& places, int block) {
  std::vector<Run> result;
  for (int i = 0; i < static_cast<int>(places.size()); ++i) {
    if (i > 0 && places[i] == places[i - 1] + 1) {
      result.back().length += block;
    } else {
      result.push_back({i * block, places[i] * block, block});
    }
  }
  return result;
}

template <class Real>
class Multifrontal final : public Factorization::Impl {
 public:
  Multifrontal(const SymmetricPattern& pattern, const std::shared_ptr<const Elimination>& order);
  FactorStatus factorize(const SymmetricMatrix& A, bool but_interface) override;
  void solve(Eigen::Ref<Eigen::MatrixXd> X, double enough) override;
  Eigen::MatrixXd condensed() const override;
  void reduce(Eigen::Ref<Eigen::VectorXd> x) override;
  void expand(Eigen::Ref<Eigen::VectorXd> x) override;
  void release() override {
    ready = false;
    factor_.reset();
  }

 private:
  FactorStatus eliminate_all(const SymmetricMatrix& A, bool but_interface);
  void plan(const Elimination& order);
  void list_entries(const SymmetricPattern& pattern, const Elimination& order);
  void enter(const SymmetricMatrix& A, int front);
  void add_update(const FrontPlan& child, const Real* update, bool to_panel, Real* own);
  void take_updates(int front);
  bool eliminate_front(int front);
  void forward(const FrontPlan& front, int columns);
  void backward(const FrontPlan& front, int columns);
  void make_room(int columns);
  void solve_together(Eigen::Ref<Eigen::MatrixXd> X);
  double take(const Eigen::Ref<const Eigen::VectorXd>& x, int column);
  void give(int column, double scale, Eigen::Ref<Eigen::VectorXd> x) const;
  /// Returns the number of fronts without that of the interface.
  size_t inside() const { return fronts_.size() - (elimination->interface > 0 ? 1 : 0); }

  Real* panel(const FrontPlan& front) { return factor_.get() + front.panel; }
  const Real* update_of(int front) const {
    return stacks_[fronts_[front].stack].get() + stacked_[front];
  }

  int size_, block_;
  std::vector<int> position_;  // position of every unknown in the order
  std::vector<FrontPlan> fronts_;
  std::vector<std::vector<int>> children_;
  std::vector<Entry> entries_;
  size_t panels_ = 0;  // number of values of the factor
  LargeArray<Real> factor_;
  // Update matrices that have not been added to their parents yet, the last on top. One stack holds
  // the updates of fronts at an even distance from the root of the elimination tree, the other
  // stack those at an odd distance, so that a front's update is written to one stack while its
  // children's updates are read from the other. The stacks exist only during factorization.
  std::array<LargeArray<Real>, 2> stacks_;
  std::array<size_t, 2> highest_{};
  std::array<size_t, 2> top_{};
  std::vector<size_t> stacked_;  // start of each front's update on its stack
  // Right-hand sides, and their rows below the pivots of one front.
  std::vector<Real> vector_, below_;
};

template <class Real>
Multifrontal<Real>::Multifrontal(const SymmetricPattern& pattern,
                                 const std::shared_ptr<const Elimination>& order)
    : size_(pattern.size()), block_(pattern.block_size()), position_(size_) {
  elimination = order;
  for (int i = 0; i < size_; ++i) {
    position_[i] = elimination->position[i / block_] * block_ + i % block_;
  }
  plan(*elimination);
  list_entries(pattern, *elimination);
}

template <class Real>
void Multifrontal<Real>::plan(const Elimination& order) {
  const std::vector<Front>& fronts = order.fronts;
  children_.resize(fronts.size());
  std::vector<int> stack_of(fronts.size());
  for (size_t s = fronts.size(); s-- > 0;) {
    stack_of[s] = fronts[s].parent < 0 ? 0 : 1 - stack_of[fronts[s].parent];
  }
  size_t panels = 0;
  std::array<size_t, 2> heights{}, highest{};
  for (int s = 0; s < static_cast<int>(fronts.size()); ++s) {
    const Front& front = fronts[s];
    FrontPlan plan{front.first * block_,
                   front.columns * block_,
                   front.rows() * block_,
                   front.parent,
                   panels,
                   0,
                   stack_of[s],
                   runs(front.below, block_),
                   {}};
    if (front.parent >= 0) {
      children_[front.parent].push_back(s);
      const Front& parent = fronts[front.parent];
      std::vector<int> places;
      for (int row : front.below) {
        const int pivot = row - parent.first;
        const auto found = std::lower_bound(parent.below.begin(), parent.below.end(), row);
        places.push_back(pivot < parent.columns
                             ? pivot
                             : parent.columns + static_cast<int>(found - parent.below.begin()));
      }
      plan.in_parent = runs(places, block_);
    }
    panels += static_cast<size_t>(plan.pivots) * plan.rows;
    size_t& height = heights[plan.stack];
    height += static_cast<size_t>(plan.below()) * plan.below();
    highest[plan.stack] = std::max(highest[plan.stack], height);
    for (int child : children_[s]) {
      heights[1 - plan.stack] -=
          static_cast<size_t>(fronts_[child].below()) * fronts_[child].below();
    }
    fronts_.push_back(std::move(plan));
  }
  panels_ = panels;
  highest_ = highest;
  stacked_.resize(fronts_.size());
}

template <class Real>
void Multifrontal<Real>::list_entries(const SymmetricPattern& pattern, const Elimination& order) {
  const std::vector<Front>& fronts = order.fronts;
  std::vector<int> front_of(pattern.block_rows());
  for (int s = 0; s < static_cast<int>(fronts.size()); ++s) {
    std::fill_n(front_of.begin() + fronts[s].first, fronts[s].columns, s);
  }
  std::vector<std::vector<Entry>> of_front(fronts.size());
  for (int i = 0; i < pattern.block_rows(); ++i) {
    for (int k = pattern.row_start()[i]; k < pattern.row_start()[i + 1]; ++k) {
      const int a = order.position[i], b = order.position[pattern.column()[k]];
      const auto [column, row] = std::minmax(a, b);
      const Front& front = fronts[front_of[column]];
      const auto found = std::lower_bound(front.below.begin(), front.below.end(), row);
      const int place = row - front.first < front.columns
                            ? row - front.first
                            : front.columns + static_cast<int>(found - front.below.begin());
      const FrontPlan& plan = fronts_[front_of[column]];
      of_front[front_of[column]].push_back(
          {k * block_ * block_,
           a < b,
           plan.panel + static_cast<size_t>(column - front.first) * block_ * plan.rows +
               static_cast<size_t>(place) * block_});
    }
  }
  for (size_t s = 0; s < fronts.size(); ++s) {
    fronts_[s].first_entry = entries_.size();
    entries_.insert(entries_.end(), of_front[s].begin(), of_front[s].end());
  }
}

template <class Real>
void Multifrontal<Real>::enter(const SymmetricMatrix& A, int front) {
  const FrontPlan& plan = fronts_[front];
  std::fill_n(panel(plan), static_cast<size_t>(plan.pivots) * plan.rows, Real(0));
  const size_t end = front + 1 < static_cast<int>(fronts_.size()) ? fronts_[front + 1].first_entry
                                                                  : entries_.size();
  for (size_t e = plan.first_entry; e < end; ++e) {
    const auto& [source, transposed, target] = entries_[e];
    const double* from = A.values().data() + source;
    const int across = transposed ? block_ : 1, down = transposed ? 1 : block_;
    for (int c = 0; c < block_; ++c) {
      Real* to = factor_.get() + target + static_cast<size_t>(c) * plan.rows;
      for (int r = 0; r < block_; ++r) to[r] = static_cast<Real>(from[r * across + c * down]);
    }
  }
}

/// Adds those columns of a child's update that belong to pivots of its parent to the parent's
/// panel, and the other columns to the parent's own update.
template <class Real>
void Multifrontal<Real>::add_update(const FrontPlan& child,
                                    const Real* update,
                                    bool to_panel,
                                    Real* own) {
  const FrontPlan& parent = fronts_[child.parent];
  const int u = child.below(), skipped = to_panel ? 0 : parent.pivots;
  const size_t stride = to_panel ? parent.rows : parent.below();
  const std::vector<Run>& all = child.in_parent;
  for (size_t across = 0; across < all.size(); ++across) {
    for (int c = 0; c < all[across].length; ++c) {
      const int column = all[across].target + c;
      if ((column < parent.pivots) != to_panel) continue;
      const Real* from = update + static_cast<size_t>(all[across].start + c) * u;
      Real* to = own + (column - skipped) * stride - skipped;
      for (size_t down = across; down < all.size(); ++down) {
        const int first = down == across ? c : 0;
        const Real* source = from + all[down].start;
        Real* target = to + all[down].target;
        for (int r = first; r < all[down].length; ++r) target[r] += source[r];
      }
    }
  }
}

template <class Real>
void Multifrontal<Real>::take_updates(int s) {
  for (int child : children_[s]) {
    add_update(fronts_[child], update_of(child), true, panel(fronts_[s]));
  }
}

template <class Real>
bool Multifrontal<Real>::eliminate_front(int s) {
  const FrontPlan& plan = fronts_[s];
  Real* L = panel(plan);
  take_updates(s);
  if (!cholesky(plan.pivots, L, plan.rows)) return false;
  const int u = plan.below();
  size_t& top = top_[plan.stack];
  Real* update = stacks_[plan.stack].get() + top;
  if (u > 0) {
    solve_right_transposed(u, plan.pivots, L, plan.rows, L + plan.pivots);
    negative_square(u, plan.pivots, L + plan.pivots, plan.rows, update);
  }
  for (int child : children_[s]) {
    add_update(fronts_[child], update_of(child), false, update);
  }
  if (!children_[s].empty()) top_[1 - plan.stack] = stacked_[children_[s].front()];
  stacked_[s] = top;
  top += static_cast<size_t>(u) * u;
  return true;
}

template <class Real>
FactorStatus Multifrontal<Real>::factorize(const SymmetricMatrix& A, bool but_interface) {
  ready = false;
  const Eigen::Map<const Eigen::ArrayXd> values(A.values().data(),
                                                static_cast<Eigen::Index>(A.values().size()));
  if (!std::isfinite(values.abs().sum())) {
    FactorStatus status;
    status.reason = "the matrix holds values that are not numbers";
    return status;
  }
  if (!factor_) {
    factor_ = large_array<Real>(panels_ + kRoom);
    std::fill_n(factor_.get() + panels_, kRoom, Real(0));
  }
  for (int i = 0; i < 2; ++i) stacks_[i] = large_array<Real>(highest_[i]);
  const FactorStatus status = eliminate_all(A, but_interface);
  for (LargeArray<Real>& stack : stacks_) stack.reset();
  return status;
}

template <class Real>
FactorStatus Multifrontal<Real>::eliminate_all(const SymmetricMatrix& A, bool but_interface) {
  FactorStatus status;
  top_ = {};
  for (int s = 0; s < static_cast<int>(fronts_.size()); ++s) {
    enter(A, s);
    if (but_interface && s == static_cast<int>(inside())) {
      take_updates(s);
    } else if (!eliminate_front(s)) {
      status.outcome = FactorStatus::Outcome::not_positive;
      status.reason = "the matrix is not positive definite";
      return status;
    }
  }
  ready = true;
  status.outcome = FactorStatus::Outcome::definite;
  return status;
}

template <class Real>
void Multifrontal<Real>::forward(const FrontPlan& front, int columns) {
  if constexpr (std::is_same_v<Real, float>) {
    float *own = vector_.data() + front.first, *v = below_.data();
    std::copy_n(own, front.pivots, v);
    std::fill_n(v + front.pivots, front.below(), 0.0f);
    eliminate_column(front.pivots, front.rows, panel(front), v);
    std::copy_n(v, front.pivots, own);
    for (const auto& [start, target, length] : front.in_vector) {
      const float* from = v + front.pivots + start;
      for (int r = 0; r < length; ++r) vector_[target + r] += from[r];
    }
    return;
  }
  Real* x = vector_.data() + front.first;
  const Real* L = panel(front);
  solve_lower(front.pivots, columns, L, front.rows, x, size_);
  const int u = front.below();
  if (u == 0) return;
  multiply(u, columns, front.pivots, L + front.pivots, front.rows, x, size_, below_.data());
  for (int j = 0; j < columns; ++j) {
    const Real* from = below_.data() + static_cast<size_t>(j) * u;
    Real* to = vector_.data() + static_cast<size_t>(j) * size_;
    for (const auto& [start, target, length] : front.in_vector) {
      for (int r = 0; r < length; ++r) to[target + r] -= from[start + r];
    }
  }
}

template <class Real>
void Multifrontal<Real>::backward(const FrontPlan& front, int columns) {
  if constexpr (std::is_same_v<Real, float>) {
    float *own = vector_.data() + front.first, *v = below_.data();
    std::copy_n(own, front.pivots, v);
    for (const auto& [start, target, length] : front.in_vector) {
      std::copy_n(vector_.data() + target, length, v + front.pivots + start);
    }
    substitute_column(front.pivots, front.rows, panel(front), v);
    std::copy_n(v, front.pivots, own);
    return;
  }
  Real* x = vector_.data() + front.first;
  const Real* L = panel(front);
  const int u = front.below();
  for (int j = 0; j < columns && u > 0; ++j) {
    Real* to = below_.data() + static_cast<size_t>(j) * u;
    const Real* from = vector_.data() + static_cast<size_t>(j) * size_;
    for (const auto& [start, target, length] : front.in_vector) {
      for (int r = 0; r < length; ++r) to[start + r] = from[target + r];
    }
  }
  if (u > 0) {
    subtract_transposed(
        front.pivots, columns, u, L + front.pivots, front.rows, below_.data(), x, size_);
  }
  solve_lower_transposed(front.pivots, columns, L, front.rows, x, size_);
}

/// Solves for up to eight columns side by side (columns_together.h).
template <>
void Multifrontal<float>::solve_together(Eigen::Ref<Eigen::MatrixXd> X) {
  constexpr int kWidth = kSolvedTogether;
  const int columns = static_cast<int>(X.cols());
  vector_.assign(static_cast<size_t>(size_) * kWidth, 0.0f);
  int tallest = 0;
  for (const FrontPlan& front : fronts_) tallest = std::max(tallest, front.rows);
  below_.resize(static_cast<size_t>(tallest) * kWidth);
  const Eigen::RowVectorXd largest = X.cwiseAbs().colwise().maxCoeff();
  const Eigen::RowVectorXd scale = (largest.array() > 0.0).select(largest, 1.0);
  for (int c = 0; c < columns; ++c) {
    for (int i = 0; i < size_; ++i) {
      vector_[position_[i] * kWidth + c] = static_cast<float>(X(i, c) / scale[c]);
    }
  }
  float* v = below_.data();
  for (const FrontPlan& front : fronts_) {
    float* own = vector_.data() + front.first * kWidth;
    const int pivots = front.pivots * kWidth;
    std::copy_n(own, pivots, v);
    std::fill_n(v + pivots, front.below() * kWidth, 0.0f);
    eliminate_columns(front.pivots, front.rows, panel(front), v);
    std::copy_n(v, pivots, own);
    for (const auto& [start, target, length] : front.in_vector) {
      const float* from = v + pivots + start * kWidth;
      float* to = vector_.data() + target * kWidth;
      for (int r = 0; r < length * kWidth; ++r) to[r] += from[r];
    }
  }
  for (size_t s = fronts_.size(); s-- > 0;) {
    const FrontPlan& front = fronts_[s];
    float* own = vector_.data() + front.first * kWidth;
    const int pivots = front.pivots * kWidth;
    std::copy_n(own, pivots, v);
    for (const auto& [start, target, length] : front.in_vector) {
      std::copy_n(vector_.data() + target * kWidth, length * kWidth, v + pivots + start * kWidth);
    }
    substitute_columns(front.pivots, front.rows, panel(front), v);
    std::copy_n(v, pivots, own);
  }
  for (int c = 0; c < columns; ++c) {
    for (int i = 0; i < size_; ++i) X(i, c) = scale[c] * vector_[position_[i] * kWidth + c];
  }
}

template <class Real>
void Multifrontal<Real>::solve(Eigen::Ref<Eigen::MatrixXd> X, double) {
  assert(ready && X.rows() == size_);
  if constexpr (std::is_same_v<Real, float>) {
    for (Eigen::Index first = 0; X.cols() > 1 && first < X.cols(); first += kSolvedTogether) {
      const auto columns = std::min<Eigen::Index>(kSolvedTogether, X.cols() - first);
      solve_together(X.middleCols(first, columns));
    }
    if (X.cols() > 1) return;
  }
  for (Eigen::Index first = 0; first < X.cols(); first += kColumnsTogether) {
    const int columns =
        static_cast<int>(std::min<Eigen::Index>(kColumnsTogether, X.cols() - first));
    make_room(columns);
    Eigen::VectorXd scale(columns);
    for (int j = 0; j < columns; ++j) scale[j] = take(X.col(first + j), j);
    for (const FrontPlan& front : fronts_) forward(front, columns);
    for (size_t s = fronts_.size(); s-- > 0;) backward(fronts_[s], columns);
    for (int j = 0; j < columns; ++j) give(j, scale[j], X.col(first + j));
  }
}

template <class Real>
void Multifrontal<Real>::make_room(int columns) {
  int tallest = 0;
  for (const FrontPlan& front : fronts_) tallest = std::max(tallest, front.rows);
  tallest += kRoom;
  vector_.resize(static_cast<size_t>(size_) * columns);
  below_.resize(static_cast<size_t>(tallest) * columns);
}

/// Stores a right-hand side in the order of elimination, scaled to the middle of the exponent
/// range, because float cannot represent 1e-40. Returns the scale.
template <class Real>
double Multifrontal<Real>::take(const Eigen::Ref<const Eigen::VectorXd>& x, int column) {
  const double largest = x.cwiseAbs().maxCoeff();
  const double scale = std::is_same_v<Real, float> && largest > 0.0 ? largest : 1.0;
  Real* to = vector_.data() + static_cast<size_t>(column) * size_;
  for (int i = 0; i < size_; ++i) to[position_[i]] = static_cast<Real>(x[i] / scale);
  return scale;
}

template <class Real>
void Multifrontal<Real>::give(int column, double scale, Eigen::Ref<Eigen::VectorXd> x) const {
  const Real* from = vector_.data() + static_cast<size_t>(column) * size_;
  for (int i = 0; i < size_; ++i) x[i] = scale * from[position_[i]];
}

template <class Real>
Eigen::MatrixXd Multifrontal<Real>::condensed() const {
  const FrontPlan& front = fronts_.back();
  using Panel = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  const Eigen::Map<const Panel> lower(factor_.get() + front.panel, front.rows, front.pivots);
  return lower.template cast<double>().template selfadjointView<Eigen::Lower>();
}

template <class Real>
void Multifrontal<Real>::reduce(Eigen::Ref<Eigen::VectorXd> x) {
  make_room(1);
  const double scale = take(x, 0);
  for (size_t s = 0; s < inside(); ++s) forward(fronts_[s], 1);
  give(0, scale, x);
}

template <class Real>
void Multifrontal<Real>::expand(Eigen::Ref<Eigen::VectorXd> x) {
  make_room(1);
  const double scale = take(x, 0);
  for (size_t s = inside(); s-- > 0;) backward(fronts_[s], 1);
  give(0, scale, x);
}

}  // namespace

template <class Real>
std::unique_ptr<Factorization::Impl> multifrontal(const SymmetricPattern& pattern,
                                                  const std::shared_ptr<const Elimination>& order) {
  return std::make_unique<Multifrontal<Real>>(pattern, order);
}
template std::unique_ptr<Factorization::Impl> multifrontal<float>(
    const SymmetricPattern&, const std::shared_ptr<const Elimination>&);
template std::unique_ptr<Factorization::Impl> multifrontal<double>(
    const SymmetricPattern&, const std::shared_ptr<const Elimination>&);

}  // namespace latsch::numerics
