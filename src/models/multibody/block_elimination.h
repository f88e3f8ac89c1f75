// SPDX-License-Identifier: Apache-2.0
// Linear systems of bodies: 6 x 6 blocks on the diagonal and where two bodies share an element,
// unsymmetric. A = L U, block by block in an order of least degree that is found once; where
// elements close no loop beyond the ground, nothing fills in.
//   U_kj = D_k^-1 A_kj,   A_ij <- A_ij - A_ik U_kj        k eliminated, i and j those after it
// D_k^-1 by Gauss-Jordan with pivots sought in the block: what a spinning rod is held by may be
// 1e-9 of what its ends are. Inverted, because a product of two blocks takes a quarter of the time
// that substitution does.
#pragma once

#include <Eigen/Core>
#include <span>
#include <utility>
#include <vector>

#include "models/multibody/pose.h"

namespace latsch::multibody {

/// A body in the order of elimination; ranges of what follows.
struct EliminatedBody {
  int body;
  int first_neighbor, end_of_neighbors, first_update, end_of_updates;
};
/// One that is eliminated after it and that it meets: blocks (body, k) and (k, body).
struct EliminationNeighbor {
  int body, below, right;
};
/// Block `to` less `below` times `right`.
struct EliminationUpdate {
  int to, below, right;
};
struct Elimination {
  int bodies;
  const EliminatedBody* order;
  const EliminationNeighbor* neighbors;
  const EliminationUpdate* updates;
};

class BlockElimination {
 public:
  /// `pairs`: bodies that share elements, in any order and as often as they do.
  BlockElimination(int bodies, const std::vector<std::pair<int, int>>& pairs);

  int bodies() const { return bodies_; }
  int size() const { return static_cast<int>(blocks_.size()); }  // places
  void clear();
  /// Where a block is kept, for at(); -1: two bodies that share no element.
  int place(int row, int column) const {
    return place_[static_cast<std::size_t>(row * bodies_ + column)];
  }
  Matrix6d& at(int place) { return blocks_[static_cast<std::size_t>(place)]; }
  const Matrix6d& at(int place) const { return blocks_[static_cast<std::size_t>(place)]; }
  Matrix6d& block(int row, int column) { return at(place(row, column)); }
  /// False where a block on the diagonal is singular; `singular_body` then says which.
  bool factorize();
  int singular_body() const { return singular_; }

  /// x <- A^-1 x and x <- A'^-1 x, six rows a body, any number of columns.
  void solve(Eigen::Ref<Eigen::MatrixXd> x) const;
  void solve_transposed(Eigen::Ref<Eigen::MatrixXd> x) const;
  /// The block (row, column) of A^-1: of bodies eliminated late with little work.
  Matrix6d inverse_block(int row, int column) const;

 private:
  Elimination elimination() const {
    return {bodies_, order_.data(), neighbors_.data(), updates_.data()};
  }
  std::span<const EliminationNeighbor> neighbors(const EliminatedBody& k) const {
    return {neighbors_.data() + k.first_neighbor, neighbors_.data() + k.end_of_neighbors};
  }
  using Blocks = std::vector<Matrix6d, Eigen::aligned_allocator<Matrix6d>>;

  int bodies_;
  std::vector<int> place_;  // of blocks, by row and column; -1: none
  Blocks blocks_;           // the diagonal's first
  Blocks pivots_;           // D_k^-1, by body
  std::vector<EliminatedBody> order_;
  std::vector<EliminationNeighbor> neighbors_;
  std::vector<EliminationUpdate> updates_;
  std::vector<int> turn_of_;  // when each body is eliminated
  int singular_ = -1;
};

}  // namespace latsch::multibody
