// SPDX-License-Identifier: Apache-2.0
// Symmetric positive definite matrix of a closed chain of nodes with 4 unknowns each, coupled to
// their three next neighbors on either side, and its factorization A = L D L^T in 4 x 4 blocks.
//
// The last three nodes are the border: without them the chain is open and its factor keeps the
// band. Eliminating node k reaches k+1 .. k+3 and the border, so the work is the same for every
// node and the whole is linear in their number:
//   L_ik = A_ik D_k^-1,   A_ij <- A_ij - L_ik A_jk^T      i, j: the neighbors of k and the border
// Where the matrix has mass in it, what the border has to do with a node fades along the chain. For
// corrections that are looked at again it can be forgotten from the node on where it has (`least`),
// up to those that are the border's neighbors: two thirds of the work.
// All that a node's elimination reads is one panel, column by column: registers hold several of
// its blocks.
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

/// A node's four columns below and with its diagonal, one after the other: its own rows, those of
/// its three neighbors, those of the border.
struct BandPanel {
  static constexpr int kNext = 4, kLast = 12, kBorder = 16, kRows = 28, kSize = 4 * kRows;
  static constexpr int kBorderRows = 12;
};

class StiffnessRows;

/// Reuses its memory from one matrix to the next.
class CyclicBandFactor {
 public:
  explicit CyclicBandFactor(int nodes);

  /// False where A is not positive definite: then there is no factor.
  bool factorize(const CyclicBand& A);
  /// The same of a matrix in axes that are turned, their unit vectors being columns: what rows
  /// say, and more in blocks (k, k + j). Solutions and what they are of stay in inertial axes.
  void start(const StiffnessRows& A, const Eigen::Matrix3d& axes);
  void add(int k, int j, const CyclicBand::Block& block);
  /// `least`: of L, what of the border counts; 0: all.
  bool factorize(double least = 0.0);
  /// From here on as if it had been made in these axes: the matrix turns with them.
  void turn_to(const Eigen::Matrix3d& axes);

  /// x <- A^-1 x.
  void solve(Eigen::Matrix4Xd& x) const;
  /// The same of a multiple of eight columns; rows beyond the nodes' stay.
  void solve_columns(Eigen::Ref<SideBySide> x) const;

 private:
  static constexpr int kReach = CyclicBand::kReach;

  double* panel(int k) { return panels_.data() + k * BandPanel::kSize; }
  void clear_border();
  void close_ring();

  int interior_;
  int far_ = 0;  // the border counts before this node and for the last three
  bool turned_ = false;
  Eigen::Matrix4d axes_ = Eigen::Matrix4d::Identity();
  // A, then L with the inverse of D in the diagonal's place; three more of zeros, which the last
  // eliminations reach.
  std::vector<double> panels_;
  std::array<double, BandPanel::kBorderRows * BandPanel::kBorderRows> border_;  // the same
};

}  // namespace latsch::ring_tire
