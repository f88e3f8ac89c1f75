// SPDX-License-Identifier: Apache-2.0
// Linear systems of bodies: 6 x 6 blocks on the diagonal and where two bodies share an element,
// unsymmetric. A = L U, block by block in an order of least degree that is found once; where
// elements close no loop beyond the ground, nothing fills in.
//   U_kj = D_k^-1 A_kj,   A_ij <- A_ij - A_ik U_kj        k eliminated, i and j those after it
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <utility>
#include <vector>

#include "models/multibody/pose.h"

namespace latsch::multibody {

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
  struct Neighbor {
    int body;
    int below, right;  // blocks (body, k) and (k, body)
  };
  struct Update {
    int to, below, right;  // to -= below right
  };

  int bodies_;
  std::vector<int> place_;  // of blocks, by row and column; -1: none
  std::vector<Matrix6d, Eigen::aligned_allocator<Matrix6d>> blocks_;  // the diagonal's first
  std::vector<Eigen::PartialPivLU<Matrix6d>> pivots_;
  std::vector<int> order_, turn_of_;  // the bodies one after the other; when each is eliminated
  std::vector<std::vector<Neighbor>> later_;  // by body: those eliminated after it that it meets
  std::vector<std::vector<Update>> updates_;  // by body
  int singular_ = -1;
};

}  // namespace latsch::multibody
