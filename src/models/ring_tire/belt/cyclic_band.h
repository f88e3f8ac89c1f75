// SPDX-License-Identifier: Apache-2.0
// Symmetric positive definite matrix of a closed chain of nodes with 4 unknowns each, coupled to
// their three next neighbors on either side, and its factorization A = L D L^T in 4 x 4 blocks.
//
// The last three nodes are the border: without them the chain is open and its factor keeps the
// band. Eliminating node k reaches k+1 .. k+3 and the border, so the work is the same for every
// node and the whole is linear in their number:
//   L_ik = A_ik D_k^-1,   A_ij <- A_ij - L_ik A_jk^T      i, j: the neighbors of k and the border
// Four doubles make a column of a block: one register of the processor.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace latsch::ring_tire {

/// Values of several right-hand sides or solutions side by side: a row an unknown, four a node.
using SideBySide = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class CyclicBand {
 public:
  static constexpr int kReach = 3;  // neighbors on either side
  using Block = Eigen::Matrix4d;

  /// All zero. At least 2 kReach + 2 nodes: no two nodes meet from both sides.
  explicit CyclicBand(int nodes);

  int nodes() const { return nodes_; }
  /// A(k, k + j), j = 0 .. kReach, around the ring; that of j = 0 is kept whole.
  Block& block(int k, int j) { return blocks_[static_cast<std::size_t>(k * (kReach + 1) + j)]; }
  const Block& block(int k, int j) const {
    return blocks_[static_cast<std::size_t>(k * (kReach + 1) + j)];
  }
  void add_diagonal(double translation, double torsion);

  /// A x, node by node a column.
  Eigen::Matrix4Xd multiply(const Eigen::Matrix4Xd& x) const;
  /// The same of a multiple of eight columns.
  SideBySide multiply_columns(const SideBySide& x) const;

 private:
  int nodes_;
  std::vector<Block> blocks_;
};

/// Reuses its memory from one matrix to the next.
class CyclicBandFactor {
 public:
  explicit CyclicBandFactor(int nodes);

  /// False where A is not positive definite: then there is no factor.
  bool factorize(const CyclicBand& A);
  /// x <- A^-1 x.
  void solve(Eigen::Matrix4Xd& x) const;
  /// The same of a multiple of eight columns; rows beyond the nodes' stay.
  void solve_columns(Eigen::Ref<SideBySide> x) const;

 private:
  static constexpr int kReach = CyclicBand::kReach;

  void place(int row, int column, const Eigen::Matrix4d& block);

  int interior_;
  std::vector<Eigen::Matrix4d> diagonal_;  // D_k, then its inverse
  std::vector<Eigen::Matrix4d> lower_;     // kReach + 3 a node: A_ik, then L_ik
  std::array<Eigen::Matrix4d, 9> border_;  // row by row; the lower triangle counts
};

}  // namespace latsch::ring_tire
