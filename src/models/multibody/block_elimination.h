// SPDX-License-Identifier: Apache-2.0
// Unsymmetric linear systems of bodies, with 6 x 6 blocks on the diagonal and for every pair of
// bodies that share an element. They are factorized as A = L U block by block, in an order of least
// degree that is found once. If elements close no loop beyond the ground, there is no fill.
//   U_kj = D_k^-1 A_kj,   A_ij <- A_ij - A_ik U_kj        k eliminated, i and j those after it
// D_k is inverted by Gauss-Jordan elimination with pivoting inside the block, because the stiffness
// that holds a rod's spin may be 1e-9 of that of its ends. The inverse is used because a product of
// two blocks takes a quarter of the time of substitution.
#pragma once

#include <Eigen/Core>
#include <span>
#include <utility>
#include <vector>

#include "models/multibody/pose.h"

namespace latsch::multibody {

/// One step of the elimination: the body that is eliminated, and its ranges in the lists of
/// neighbors and updates.
struct EliminatedBody {
  int body;
  int first_neighbor, end_of_neighbors, first_update, end_of_updates;
};
/// A body that shares an element with the eliminated body k and is eliminated later: index of the
/// body and of the blocks (body, k) and (k, body).
struct EliminationNeighbor {
  int body, below, right;
};
/// One update of the elimination: subtracts the product of the blocks `below` and `right` from the
/// block `to`.
struct EliminationUpdate {
  int to, below, right;
};
struct EliminationPlan {
  int bodies;
  const EliminatedBody* order;
  const EliminationNeighbor* neighbors;
  const EliminationUpdate* updates;
};

class BlockElimination {
 public:
  /// `pairs` lists the bodies that share elements, in any order; pairs may be repeated.
  BlockElimination(int bodies, const std::vector<std::pair<int, int>>& pairs);

  int bodies() const { return bodies_; }
  int size() const { return static_cast<int>(blocks_.size()); }  // number of stored blocks
  void clear();
  /// Returns the index of the block (row, column) for at(); -1 if the two bodies share no element.
  int place(int row, int column) const {
    return place_[static_cast<std::size_t>(row * bodies_ + column)];
  }
  Matrix6d& at(int place) { return blocks_[static_cast<std::size_t>(place)]; }
  const Matrix6d& at(int place) const { return blocks_[static_cast<std::size_t>(place)]; }
  Matrix6d& block(int row, int column) { return at(place(row, column)); }
  /// Factorizes the matrix. Returns false if a block on the diagonal is singular; `singular_body`
  /// then returns the body of this block.
  bool factorize();
  int singular_body() const { return singular_; }

  /// Compute x <- A^-1 x and x <- (A^T)^-1 x, with six rows per body and any number of columns.
  void solve(Eigen::Ref<Eigen::MatrixXd> x) const;
  void solve_transposed(Eigen::Ref<Eigen::MatrixXd> x) const;
  /// Returns the block (row, column) of A^-1. The later the body of the column is eliminated, the
  /// less this costs.
  Matrix6d inverse_block(int row, int column) const;

 private:
  EliminationPlan elimination() const {
    return {bodies_, order_.data(), neighbors_.data(), updates_.data()};
  }
  std::span<const EliminationNeighbor> neighbors(const EliminatedBody& k) const {
    return {neighbors_.data() + k.first_neighbor, neighbors_.data() + k.end_of_neighbors};
  }
  using Blocks = std::vector<Matrix6d, Eigen::aligned_allocator<Matrix6d>>;

  int bodies_;
  std::vector<int> place_;  // indices of blocks by row and column; -1: the block is zero
  Blocks blocks_;           // blocks of the matrix, those on the diagonal first
  Blocks pivots_;           // D_k^-1, by body
  std::vector<EliminatedBody> order_;
  std::vector<EliminationNeighbor> neighbors_;
  std::vector<EliminationUpdate> updates_;
  std::vector<int> turn_of_;  // position of each body in the order of elimination
  int singular_ = -1;
};

}  // namespace latsch::multibody
