// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/block_elimination.h"

#include <algorithm>
#include <cassert>
#include <set>

namespace latsch::multibody {

BlockElimination::BlockElimination(int bodies, const std::vector<std::pair<int, int>>& pairs)
    : bodies_(bodies),
      place_(static_cast<std::size_t>(bodies * bodies), -1),
      pivots_(static_cast<std::size_t>(bodies)),
      later_(static_cast<std::size_t>(bodies)),
      updates_(static_cast<std::size_t>(bodies)) {
  const auto at = [](int body) { return static_cast<std::size_t>(body); };
  std::vector<std::set<int>> meets(at(bodies));
  int blocks = bodies;
  const auto place = [&](int row, int column) -> int& { return place_[at(row * bodies + column)]; };
  const auto join = [&](int i, int j) {
    if (i == j || place(i, j) >= 0) return;
    meets[at(i)].insert(j);
    meets[at(j)].insert(i);
    place(i, j) = blocks++;
    place(j, i) = blocks++;
  };
  for (int i = 0; i < bodies; ++i) place(i, i) = i;
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
      for (const int j : others) updates_[at(k)].push_back({place(i, j), place(i, k), place(k, j)});
  }
  blocks_.resize(at(blocks));
  turn_of_.resize(at(bodies));
  for (int i = 0; i < bodies; ++i) turn_of_[at(order_[at(i)])] = i;
}

void BlockElimination::clear() {
  for (Matrix6d& block : blocks_) block.setZero();
}

bool BlockElimination::factorize() {
  for (const int body : order_) {
    const std::size_t k = static_cast<std::size_t>(body);
    Eigen::PartialPivLU<Matrix6d>& pivot = pivots_[k];
    pivot.compute(at(body));
    const double least = pivot.matrixLU().diagonal().cwiseAbs().minCoeff();
    if (!(least > 0.0) || !pivot.matrixLU().allFinite()) {
      singular_ = body;
      return false;
    }
    for (const Neighbor& n : later_[k]) at(n.right) = pivot.solve(at(n.right)).eval();
    for (const Update& u : updates_[k]) {
      at(u.to).noalias() -= at(u.below) * at(u.right);
    }
  }
  singular_ = -1;
  return true;
}

void BlockElimination::solve(Eigen::Ref<Eigen::MatrixXd> x) const {
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    const auto of = [&](int body) { return x.col(c).segment<6>(6 * body); };
    for (const int k : order_) {
      const Vector6d own = pivots_[static_cast<std::size_t>(k)].solve(of(k));
      of(k) = own;
      for (const Neighbor& n : later_[static_cast<std::size_t>(k)])
        of(n.body).noalias() -= at(n.below) * own;
    }
    for (auto k = order_.rbegin(); k != order_.rend(); ++k)
      for (const Neighbor& n : later_[static_cast<std::size_t>(*k)])
        of(*k).noalias() -= at(n.right) * of(n.body);
  }
}

void BlockElimination::solve_transposed(Eigen::Ref<Eigen::MatrixXd> x) const {
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    const auto of = [&](int body) { return x.col(c).segment<6>(6 * body); };
    for (const int k : order_)
      for (const Neighbor& n : later_[static_cast<std::size_t>(k)])
        of(n.body).noalias() -= at(n.right).transpose() * of(k);
    for (auto k = order_.rbegin(); k != order_.rend(); ++k) {
      Vector6d own = of(*k);
      for (const Neighbor& n : later_[static_cast<std::size_t>(*k)])
        own.noalias() -= at(n.below).transpose() * of(n.body);
      of(*k) = pivots_[static_cast<std::size_t>(*k)].transpose().solve(own);
    }
  }
}

Matrix6d BlockElimination::inverse_block(int row, int column) const {
  const auto index = [](int body) { return static_cast<std::size_t>(body); };
  const int count = bodies(), first = turn_of_[index(column)];
  std::vector<Matrix6d, Eigen::aligned_allocator<Matrix6d>> x(index(count), Matrix6d::Zero());
  x[index(column)].setIdentity();
  for (int i = first; i < count; ++i) {
    const int k = order_[index(i)];
    x[index(k)] = pivots_[index(k)].solve(x[index(k)]).eval();
    for (const Neighbor& n : later_[index(k)])
      x[index(n.body)].noalias() -= at(n.below) * x[index(k)];
  }
  for (int i = count - 1; i >= turn_of_[index(row)]; --i) {
    const int k = order_[index(i)];
    for (const Neighbor& n : later_[index(k)])
      x[index(k)].noalias() -= at(n.right) * x[index(n.body)];
  }
  return x[index(row)];
}

}  // namespace latsch::multibody
