// SPDX-License-Identifier: Apache-2.0
// Symmetric positive definite matrix of a closed chain of nodes with 4 unknowns each, coupled to
// their three next neighbors on either side, and its factorization A = L D L^T in 4 x 4 blocks.
//
// The last three nodes are the border: without them the chain is open and its factor keeps the
// band. Eliminating node k changes k+1 .. k+3 and the border, so the work is the same for every
// node and the total is linear in their number:
//   L_ik = A_ik D_k^-1,   A_ij <- A_ij - L_ik A_jk^T      i, j: the neighbors of k and the border
// If the matrix contains mass, the coupling of the border with a node decays along the chain. For
// corrections that are checked afterward the coupling can be dropped from the node on where it has
// decayed (`least`), up to the border's neighbors: this leaves two thirds of the work. All data
// that a node's elimination reads are in one panel, column by column, so registers hold several of
// its blocks.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace latsch::ring_tire {

/// Values of several right-hand sides or solutions side by side: each row is an unknown, four rows
/// a node.
using SideBySide = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class CyclicBand {
 public:
  static constexpr int kReach = 3;  // neighbors on either side
  using Block = Eigen::Matrix4d;

  /// All entries are zero. Needs at least 2 kReach + 2 nodes, so that no two nodes couple from both
  /// sides.
  explicit CyclicBand(int nodes);

  int nodes() const { return nodes_; }
  /// A(k, k + j), j = 0 .. kReach, around the ring; the block for j = 0 is stored whole.
  Block& block(int k, int j) { return blocks_[static_cast<std::size_t>(k * (kReach + 1) + j)]; }
  const Block& block(int k, int j) const {
    return blocks_[static_cast<std::size_t>(k * (kReach + 1) + j)];
  }

  /// Returns A x; each column of x is a node.
  Eigen::Matrix4Xd multiply(const Eigen::Matrix4Xd& x) const;
  /// Returns A x for several x side by side; the number of columns is a multiple of eight.
  SideBySide multiply_columns(const SideBySide& x) const;

 private:
  int nodes_;
  std::vector<Block> blocks_;
};

/// The four columns of a node, from its diagonal down, one after the other: the node's rows, those
/// of its three neighbors, those of the border.
struct BandPanel {
  static constexpr int kNext = 4, kLast = 12, kBorder = 16, kRows = 28, kSize = 4 * kRows;
  static constexpr int kBorderRows = 12;
};

class StiffnessRows;

/// A factor that reuses its memory from one matrix to the next.
class CyclicBandFactor {
 public:
  explicit CyclicBandFactor(int nodes);

  /// Returns false if A is not positive definite; then there is no factor.
  bool factorize(const CyclicBand& A);
  /// Starts a factor of a matrix in rotated axes, whose unit vectors are columns of `axes`, from
  /// rows; add() adds blocks (k, k + j). Solutions and right-hand sides stay in inertial axes.
  void start(const StiffnessRows& A, const Eigen::Matrix3d& axes);
  void add(int k, int j, const CyclicBand::Block& block);
  /// `least` is the least entry of L for which the border counts; 0: all entries.
  bool factorize(double least = 0.0);
  /// Rotates the matrix with the axes: from now on the factor acts as if it had been made in
  /// `axes`.
  void turn_to(const Eigen::Matrix3d& axes);

  /// x <- A^-1 x.
  void solve(Eigen::Matrix4Xd& x) const;
  /// Solves for several columns, a multiple of eight; rows beyond the nodes' are not changed.
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
  // A, then L with the inverse of D on the diagonal; then three panels of zeros, which the last
  // eliminations access.
  std::vector<double> panels_;
  std::array<double, BandPanel::kBorderRows * BandPanel::kBorderRows> border_;  // likewise
};

}  // namespace latsch::ring_tire
