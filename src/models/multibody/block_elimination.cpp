// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/block_elimination.h"

#include <algorithm>
#include <cassert>
#include <set>

namespace latsch::multibody {

BlockElimination::BlockElimination(int bodies, const std::vector<std::pair<int, int>>& pairs)
    : place_(static_cast<std::size_t>(bodies * bodies), -1),
      diagonal_(static_cast<std::size_t>(bodies)),
      pivots_(static_cast<std::size_t>(bodies)),
      later_(static_cast<std::size_t>(bodies)),
      updates_(static_cast<std::size_t>(bodies)) {
  const auto at = [](int body) { return static_cast<std::size_t>(body); };
  std::vector<std::set<int>> meets(at(bodies));
  int blocks = 0;
  const auto place = [&](int row, int column) -> int& { return place_[at(row * bodies + column)]; };
  const auto join = [&](int i, int j) {
    if (i == j || place(i, j) >= 0) return;
    meets[at(i)].insert(j);
    meets[at(j)].insert(i);
    place(i, j) = blocks++;
    place(j, i) = blocks++;
  };
  for (const auto& [i, j] : pairs) join(i, j);
  std::set<int> left;
  for (int i = 0; i < bodies; ++i) left.insert(i);
  while (!left.empty()) {
    const int k = *std::min_element(left.begin(), left.end(), [&](int i, int j) {
      return meets[at(i)].size() < meets[at(j)].size();
    });
    left.erase(k);
    order_.push_back(k);
    const std::set<int> others = meets[at(k)];
    for (const int i : others) {
      meets[at(i)].erase(k);
      later_[at(k)].push_back({i, place(i, k), place(k, i)});
      for (const int j : others) join(i, j);
    }
    for (const int i : others)
      for (const int j : others)
        updates_[at(k)].push_back({i == j ? -1 - i : place(i, j), place(i, k), place(k, j)});
  }
  other_.resize(at(blocks));
  turn_of_.resize(at(bodies));
  for (int i = 0; i < bodies; ++i) turn_of_[at(order_[at(i)])] = i;
}

void BlockElimination::clear() {
  for (Matrix6d& block : diagonal_) block.setZero();
  for (Matrix6d& block : other_) block.setZero();
}

Matrix6d& BlockElimination::block(int row, int column) {
  if (row == column) return diagonal_[static_cast<std::size_t>(row)];
  const int place = place_[static_cast<std::size_t>(row * bodies() + column)];
  assert(place >= 0);
  return other_[static_cast<std::size_t>(place)];
}

bool BlockElimination::factorize() {
  const auto other = [&](int i) -> Matrix6d& { return other_[static_cast<std::size_t>(i)]; };
  for (const int body : order_) {
    const std::size_t k = static_cast<std::size_t>(body);
    Eigen::PartialPivLU<Matrix6d>& pivot = pivots_[k];
    pivot.compute(diagonal_[k]);
    const double least = pivot.matrixLU().diagonal().cwiseAbs().minCoeff();
    if (!(least > 0.0) || !pivot.matrixLU().allFinite()) {
      singular_ = body;
      return false;
    }
    for (const Neighbor& n : later_[k]) other(n.right) = pivot.solve(other(n.right)).eval();
    for (const Update& u : updates_[k]) {
      Matrix6d& to = u.to < 0 ? diagonal_[static_cast<std::size_t>(-1 - u.to)] : other(u.to);
      to.noalias() -= other(u.below) * other(u.right);
    }
  }
  singular_ = -1;
  return true;
}

void BlockElimination::solve(Eigen::Ref<Eigen::MatrixXd> x) const {
  const auto other = [&](int i) -> const Matrix6d& { return other_[static_cast<std::size_t>(i)]; };
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    const auto of = [&](int body) { return x.col(c).segment<6>(6 * body); };
    for (const int k : order_) {
      const Vector6d own = pivots_[static_cast<std::size_t>(k)].solve(of(k));
      of(k) = own;
      for (const Neighbor& n : later_[static_cast<std::size_t>(k)])
        of(n.body).noalias() -= other(n.below) * own;
    }
    for (auto k = order_.rbegin(); k != order_.rend(); ++k)
      for (const Neighbor& n : later_[static_cast<std::size_t>(*k)])
        of(*k).noalias() -= other(n.right) * of(n.body);
  }
}

void BlockElimination::solve_transposed(Eigen::Ref<Eigen::MatrixXd> x) const {
  const auto other = [&](int i) -> const Matrix6d& { return other_[static_cast<std::size_t>(i)]; };
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    const auto of = [&](int body) { return x.col(c).segment<6>(6 * body); };
    for (const int k : order_)
      for (const Neighbor& n : later_[static_cast<std::size_t>(k)])
        of(n.body).noalias() -= other(n.right).transpose() * of(k);
    for (auto k = order_.rbegin(); k != order_.rend(); ++k) {
      Vector6d own = of(*k);
      for (const Neighbor& n : later_[static_cast<std::size_t>(*k)])
        own.noalias() -= other(n.below).transpose() * of(n.body);
      of(*k) = pivots_[static_cast<std::size_t>(*k)].transpose().solve(own);
    }
  }
}

Matrix6d BlockElimination::inverse_block(int row, int column) const {
  const auto at = [](int body) { return static_cast<std::size_t>(body); };
  const int count = bodies(), first = turn_of_[at(column)];
  std::vector<Matrix6d, Eigen::aligned_allocator<Matrix6d>> x(at(count), Matrix6d::Zero());
  x[at(column)].setIdentity();
  for (int i = first; i < count; ++i) {
    const int k = order_[at(i)];
    x[at(k)] = pivots_[at(k)].solve(x[at(k)]).eval();
    for (const Neighbor& n : later_[at(k)])
      x[at(n.body)].noalias() -= other_[at(n.below)] * x[at(k)];
  }
  for (int i = count - 1; i >= turn_of_[at(row)]; --i) {
    const int k = order_[at(i)];
    for (const Neighbor& n : later_[at(k)])
      x[at(k)].noalias() -= other_[at(n.right)] * x[at(n.body)];
  }
  return x[at(row)];
}

}  // namespace latsch::multibody
