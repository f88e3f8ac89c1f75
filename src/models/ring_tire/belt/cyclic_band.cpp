// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/cyclic_band.h"

#include <algorithm>
#include <cassert>

#include "models/ring_tire/belt/stiffness_rows.h"

#define LATSCH_KERNELS_IN "models/ring_tire/belt/cyclic_band_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {
namespace {

using InPlace = Eigen::Map<Eigen::Matrix4d, 0, Eigen::OuterStride<>>;

InPlace in_panel(double* at) { return InPlace(at, Eigen::OuterStride<>(BandPanel::kRows)); }
InPlace in_border(double* at) { return InPlace(at, Eigen::OuterStride<>(BandPanel::kBorderRows)); }
int border_place(int row, int column) { return 4 * (row + column * BandPanel::kBorderRows); }

}  // namespace

CyclicBand::CyclicBand(int nodes)
    : nodes_(nodes), blocks_(static_cast<std::size_t>(nodes) * (kReach + 1), Block(Block::Zero())) {
  assert(nodes >= 2 * kReach + 2);
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
  turned_ = false;
  clear_border();
  for (int k = 0; k < A.nodes(); ++k)
    for (int j = 0; j <= kReach; ++j) in_panel(panel(k) + 4 * j) = A.block(k, j).transpose();
  close_ring();
  return factorize();
}

void CyclicBandFactor::start(const StiffnessRows& A, const Eigen::Matrix3d& axes) {
  turn_to(axes);
  clear_border();
  A.fill_panels(panels_.data());
  close_ring();
}

void CyclicBandFactor::turn_to(const Eigen::Matrix3d& axes) {
  turned_ = true;
  axes_.topLeftCorner<3, 3>() = axes;
}

void CyclicBandFactor::clear_border() {
  border_.fill(0.0);
  for (int k = 0; k < interior_; ++k)
    for (int c = 0; c < 4; ++c)
      std::fill_n(
          panel(k) + BandPanel::kRows * c + BandPanel::kBorder, BandPanel::kBorderRows, 0.0);
}

/// Every panel has A(k, k + j) transposed below its diagonal; this function moves the blocks of
/// border nodes to their positions.
void CyclicBandFactor::close_ring() {
  for (int j = 1; j <= kReach; ++j)
    for (int k = interior_ - j; k < interior_; ++k) {
      double* const own = panel(k);
      in_panel(own + BandPanel::kBorder + 4 * (k + j - interior_)) = in_panel(own + 4 * j);
      in_panel(own + 4 * j).setZero();
    }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= kReach; ++j) {
      auto block = in_panel(panel(interior_ + i) + 4 * j);
      if (i + j < 3)
        in_border(border_.data() + border_place(i + j, i)) = block;
      else
        in_panel(panel(i + j - 3) + BandPanel::kBorder + 4 * i) = block.transpose();
      block.setZero();
    }
}

void CyclicBandFactor::add(int k, int j, const CyclicBand::Block& block) {
  const int i = k - interior_;
  if (i + j < 0)
    in_panel(panel(k) + 4 * j) += block.transpose();
  else if (i < 0)
    in_panel(panel(k) + BandPanel::kBorder + 4 * (i + j)) += block.transpose();
  else if (i + j < 3)
    in_border(border_.data() + border_place(i + j, i)) += block.transpose();
  else
    in_panel(panel(i + j - 3) + BandPanel::kBorder + 4 * i) += block;
}

bool CyclicBandFactor::factorize(double least) {
  return LATSCH_KERNEL(eliminate_chain)(interior_, panels_.data(), border_.data(), least, far_);
}

void CyclicBandFactor::solve(Eigen::Matrix4Xd& x) const {
  const Eigen::Matrix4d back = axes_.transpose();
  if (turned_) LATSCH_KERNEL(turn_nodes)(interior_ + 3, back.data(), x.data());
  LATSCH_KERNEL(solve_chain)(interior_, far_, panels_.data(), border_.data(), x.data());
  if (turned_) LATSCH_KERNEL(turn_nodes)(interior_ + 3, axes_.data(), x.data());
}

void CyclicBandFactor::solve_columns(Eigen::Ref<SideBySide> x) const {
  assert(x.cols() % 8 == 0 && x.rows() >= 4 * (interior_ + 3));
  const int columns = static_cast<int>(x.cols()), stride = static_cast<int>(x.outerStride());
  const Eigen::Matrix4d back = axes_.transpose();
  const auto turn = [&](const Eigen::Matrix4d& axes) {
    if (!turned_) return;
    LATSCH_KERNEL(turn_columns)(interior_ + 3, axes.data(), x.data(), columns, stride);
  };
  turn(back);
  LATSCH_KERNEL(solve_chain_of_columns)
  (interior_, far_, panels_.data(), border_.data(), x.data(), columns, stride);
  turn(axes_);
}

}  // namespace latsch::ring_tire
