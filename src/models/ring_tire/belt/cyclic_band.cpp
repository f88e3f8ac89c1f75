// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/cyclic_band.h"

#include <algorithm>
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
    : interior_(nodes - 3), panels_(static_cast<std::size_t>(nodes) * BandPanel::kSize, 0.0) {}

bool CyclicBandFactor::factorize(const CyclicBand& A) {
  assert(A.nodes() == interior_ + 3);
  constexpr int kRows = BandPanel::kRows, kBorder = BandPanel::kBorder;
  constexpr int kBorderRows = BandPanel::kBorderRows;
  const auto put = [](const auto& block, double* to, int apart) {
    Eigen::Map<Eigen::Matrix4d, 0, Eigen::OuterStride<>>(to, Eigen::OuterStride<>(apart)) = block;
  };
  border_.fill(0.0);
  for (int k = 0; k < interior_; ++k) {
    double* const own = panel(k);
    put(A.block(k, 0), own, kRows);
    for (int c = 0; c < 4; ++c) std::fill_n(own + kRows * c + kBorder, kBorderRows, 0.0);
    for (int j = 1; j <= kReach; ++j) {
      const int other = k + j;
      put(A.block(k, j).transpose(),
          own + (other < interior_ ? 4 * j : kBorder + 4 * (other - interior_)),
          kRows);
      if (other >= interior_) put(Eigen::Matrix4d::Zero(), own + 4 * j, kRows);
    }
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= kReach; ++j) {
      const CyclicBand::Block& block = A.block(interior_ + i, j);
      if (i + j < 3)
        put(block.transpose(), border_.data() + kBorderRows * 4 * i + 4 * (i + j), kBorderRows);
      else
        put(block, panel(i + j - 3) + kBorder + 4 * i, kRows);
    }
  return LATSCH_KERNEL(eliminate_chain)(interior_, panels_.data(), border_.data());
}

void CyclicBandFactor::solve(Eigen::Matrix4Xd& x) const {
  LATSCH_KERNEL(solve_chain)(interior_, panels_.data(), border_.data(), x.data());
}

void CyclicBandFactor::solve_columns(Eigen::Ref<SideBySide> x) const {
  assert(x.cols() % 8 == 0 && x.rows() >= 4 * (interior_ + 3));
  LATSCH_KERNEL(solve_chain_of_columns)
  (interior_,
   panels_.data(),
   border_.data(),
   x.data(),
   static_cast<int>(x.cols()),
   static_cast<int>(x.outerStride()));
}

}  // namespace latsch::ring_tire
