// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/symmetric_pattern.h"

#include <algorithm>
#include <cassert>

namespace latsch::numerics {
namespace {

constexpr int kNodeBlock = 3;  // number of unknowns of a node in space

/// True if the unknowns of every element come as whole nodes: (3 n, 3 n + 1, 3 n + 2), or all three
/// held.
bool whole_nodes(int size, const std::vector<std::vector<int>>& elements) {
  if (size % kNodeBlock != 0) return false;
  for (const auto& unknowns : elements) {
    if (unknowns.size() % kNodeBlock != 0) return false;
    for (size_t a = 0; a < unknowns.size(); a += kNodeBlock) {
      const int first = unknowns[a];
      if (first >= 0 && first % kNodeBlock != 0) return false;
      for (int i = 1; i < kNodeBlock; ++i) {
        if (unknowns[a + i] != (first < 0 ? -1 : first + i)) return false;
      }
    }
  }
  return true;
}

int block_of(int unknown, int block_size) { return unknown < 0 ? -1 : unknown / block_size; }

}  // namespace

SymmetricPattern::SymmetricPattern(int size, const std::vector<std::vector<int>>& elements)
    : size_(size), block_size_(whole_nodes(size, elements) ? kNodeBlock : 1) {
  build_rows(elements);
  build_scatter(elements);
}

void SymmetricPattern::build_rows(const std::vector<std::vector<int>>& elements) {
  std::vector<std::vector<int>> columns(block_rows());
  for (int i = 0; i < block_rows(); ++i) columns[i].push_back(i);
  for (const auto& unknowns : elements) {
    for (size_t a = 0; a < unknowns.size(); a += block_size_) {
      assert(unknowns[a] < size_);
      for (size_t b = 0; b < unknowns.size(); b += block_size_) {
        const int row = block_of(unknowns[a], block_size_);
        const int column = block_of(unknowns[b], block_size_);
        if (column >= 0 && row > column) columns[row].push_back(column);
      }
    }
  }
  row_start_.assign(1, 0);
  for (auto& row : columns) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    column_.insert(column_.end(), row.begin(), row.end());
    row_start_.push_back(static_cast<int>(column_.size()));
  }
}

void SymmetricPattern::build_scatter(const std::vector<std::vector<int>>& elements) {
  scatter_start_.assign(1, 0);
  for (const auto& unknowns : elements) {
    // The element matrix is traversed column-major, as it is stored.
    for (size_t b = 0; b < unknowns.size(); b += block_size_) {
      for (size_t a = 0; a < unknowns.size(); a += block_size_) {
        const int row = block_of(unknowns[a], block_size_);
        const int column = block_of(unknowns[b], block_size_);
        if (column < 0 || row < column) continue;
        scatter_.push_back({find(row, column), static_cast<short>(a), static_cast<short>(b)});
      }
    }
    scatter_start_.push_back(static_cast<int>(scatter_.size()));
    element_size_.push_back(static_cast<int>(unknowns.size()));
  }
}

int SymmetricPattern::find(int block_row, int block_column) const {
  assert(block_row >= block_column);
  const auto first = column_.begin() + row_start_[block_row];
  const auto last = column_.begin() + row_start_[block_row + 1];
  const auto found = std::lower_bound(first, last, block_column);
  if (found == last || *found != block_column) return -1;
  return static_cast<int>(found - column_.begin()) * block_size_ * block_size_;
}

}  // namespace latsch::numerics
