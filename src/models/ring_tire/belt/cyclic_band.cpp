// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/cyclic_band.h"

#include <cassert>

#define LATSCH_KERNELS_IN "models/ring_tire/belt/cyclic_band_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {

CyclicBand::CyclicBand(int nodes)
    : nodes_(nodes), blocks_(static_cast<std::size_t>(nodes) * (kReach + 1), Block(Block::Zero())) {
  assert(nodes >= 2 * kReach + 2);
}

void CyclicBand::add_diagonal(double translation, double torsion) {
  const Eigen::Vector4d value(translation, translation, translation, torsion);
  for (int k = 0; k < nodes_; ++k) block(k, 0).diagonal() += value;
}

Eigen::Matrix4Xd CyclicBand::multiply(const Eigen::Matrix4Xd& x) const {
  Eigen::Matrix4Xd y = Eigen::Matrix4Xd::Zero(4, nodes_);
  for (int k = 0; k < nodes_; ++k) {
    y.col(k) += block(k, 0) * x.col(k);
    for (int j = 1; j <= kReach; ++j) {
      const int other = (k + j) % nodes_;
      y.col(k) += block(k, j) * x.col(other);
      y.col(other) += block(k, j).transpose() * x.col(k);
    }
  }
  return y;
}

SideBySide CyclicBand::multiply_columns(const SideBySide& x) const {
  assert(x.cols() % 8 == 0 && x.rows() == 4 * nodes_);
  SideBySide y = SideBySide::Zero(x.rows(), x.cols());
  LATSCH_KERNEL(add_product)
  (nodes_, blocks_.data(), x.data(), y.data(), static_cast<int>(x.cols()));
  return y;
}

CyclicBandFactor::CyclicBandFactor(int nodes)
    : interior_(nodes - 3),
      diagonal_(static_cast<std::size_t>(interior_)),
      lower_(static_cast<std::size_t>(interior_) * (kReach + 3)) {}

bool CyclicBandFactor::factorize(const CyclicBand& A) {
  assert(A.nodes() == interior_ + 3);
  for (Eigen::Matrix4d& block : border_) block.setZero();
  for (int k = 0; k < interior_; ++k) {
    diagonal_[static_cast<std::size_t>(k)] = A.block(k, 0);
    for (int i = 0; i < kReach + 3; ++i)
      lower_[static_cast<std::size_t>(k * (kReach + 3) + i)].setZero();
  }
  for (int k = 0; k < A.nodes(); ++k)
    for (int j = k < interior_ ? 1 : 0; j <= kReach; ++j)
      place(k, (k + j) % A.nodes(), A.block(k, j));
  return LATSCH_KERNEL(eliminate_chain)(interior_, diagonal_.data(), lower_.data(), border_.data());
}

/// A(row, column) into the place of its transpose or its own, whichever lies below the diagonal.
void CyclicBandFactor::place(int row, int column, const Eigen::Matrix4d& block) {
  constexpr int kColumn = kReach + 3;
  if (row >= interior_ && column >= interior_) {
    const int i = row - interior_, j = column - interior_;
    if (i >= j)
      border_[static_cast<std::size_t>(3 * i + j)] = block;
    else
      border_[static_cast<std::size_t>(3 * j + i)] = block.transpose();
  } else if (row >= interior_) {
    lower_[static_cast<std::size_t>(column * kColumn + kReach + row - interior_)] = block;
  } else if (column >= interior_) {
    lower_[static_cast<std::size_t>(row * kColumn + kReach + column - interior_)] =
        block.transpose();
  } else {
    lower_[static_cast<std::size_t>(row * kColumn + column - row - 1)] = block.transpose();
  }
}

void CyclicBandFactor::solve(Eigen::Matrix4Xd& x) const {
  LATSCH_KERNEL(solve_chain)(interior_, diagonal_.data(), lower_.data(), border_.data(), x.data());
}

void CyclicBandFactor::solve_columns(Eigen::Ref<SideBySide> x) const {
  assert(x.cols() % 8 == 0 && x.rows() >= 4 * (interior_ + 3));
  LATSCH_KERNEL(solve_chain_of_columns)
  (interior_,
   diagonal_.data(),
   lower_.data(),
   border_.data(),
   x.data(),
   static_cast<int>(x.cols()),
   static_cast<int>(x.outerStride()));
}

}  // namespace latsch::ring_tire
