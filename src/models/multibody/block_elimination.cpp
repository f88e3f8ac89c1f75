// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/block_elimination.h"

#include <algorithm>
#include <cstring>
#include <set>

#define LATSCH_KERNELS_IN "models/multibody/block_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::multibody {

BlockElimination::BlockElimination(int bodies, const std::vector<std::pair<int, int>>& pairs)
    : bodies_(bodies),
      place_(static_cast<std::size_t>(bodies * bodies), -1),
      pivots_(static_cast<std::size_t>(bodies)) {
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
    EliminatedBody own{
        k, static_cast<int>(neighbors_.size()), 0, static_cast<int>(updates_.size()), 0};
    const std::set<int> others = meets[at(k)];
    for (const int i : others) {
      meets[at(i)].erase(k);
      neighbors_.push_back({i, place(i, k), place(k, i)});
      for (const int j : others) join(i, j);
    }
    for (const int i : others)
      for (const int j : others) updates_.push_back({place(i, j), place(i, k), place(k, j)});
    own.end_of_neighbors = static_cast<int>(neighbors_.size());
    own.end_of_updates = static_cast<int>(updates_.size());
    order_.push_back(own);
  }
  blocks_.resize(at(blocks));
  turn_of_.resize(at(bodies));
  for (int i = 0; i < bodies; ++i) turn_of_[at(order_[at(i)].body)] = i;
}

void BlockElimination::clear() {
  std::memset(static_cast<void*>(blocks_.data()), 0, blocks_.size() * sizeof(Matrix6d));
}

bool BlockElimination::factorize() {
  singular_ =
      LATSCH_KERNEL(factorize)(elimination(), blocks_.front().data(), pivots_.front().data());
  return singular_ < 0;
}

void BlockElimination::solve(Eigen::Ref<Eigen::MatrixXd> x) const {
  for (Eigen::Index c = 0; c < x.cols(); ++c) LATSCH_KERNEL(solve)
  (elimination(), blocks_.front().data(), pivots_.front().data(), x.col(c).data());
}

void BlockElimination::solve_transposed(Eigen::Ref<Eigen::MatrixXd> x) const {
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    const auto of = [&](int body) { return x.col(c).segment<6>(6 * body); };
    for (const EliminatedBody& k : order_)
      for (const EliminationNeighbor& n : neighbors(k))
        of(n.body).noalias() -= at(n.right).transpose() * of(k.body);
    for (auto k = order_.rbegin(); k != order_.rend(); ++k) {
      Vector6d own = of(k->body);
      for (const EliminationNeighbor& n : neighbors(*k))
        own.noalias() -= at(n.below).transpose() * of(n.body);
      of(k->body).noalias() = pivots_[static_cast<std::size_t>(k->body)].transpose() * own;
    }
  }
}

Matrix6d BlockElimination::inverse_block(int row, int column) const {
  const auto index = [](int body) { return static_cast<std::size_t>(body); };
  const int first = turn_of_[index(column)], last = turn_of_[index(row)];
  if (std::min(first, last) == bodies_ - 1) return pivots_[index(column)];
  Blocks x(index(bodies_), Matrix6d::Zero());
  x[index(column)].setIdentity();
  for (int i = first; i < bodies_; ++i) {
    const EliminatedBody& k = order_[index(i)];
    Matrix6d& own = x[index(k.body)];
    own = pivots_[index(k.body)] * own;
    for (const EliminationNeighbor& n : neighbors(k))
      x[index(n.body)].noalias() -= at(n.below) * own;
  }
  for (int i = bodies_ - 1; i >= last; --i) {
    const EliminatedBody& k = order_[index(i)];
    for (const EliminationNeighbor& n : neighbors(k))
      x[index(k.body)].noalias() -= at(n.right) * x[index(n.body)];
  }
  return x[index(row)];
}

}  // namespace latsch::multibody
