// SPDX-License-Identifier: Apache-2.0
// Positions of the entries of a sparse symmetric matrix that is assembled from elements.
//
// The pattern is built once per mesh from the unknowns that each element couples. Storage is the
// lower block triangle by block rows. A block is 3 x 3 if the unknowns of a node always appear
// together (0 1 2, 3 4 5, ...; all free or all held), otherwise 1 x 1; callers need not know which.
// The scatter map holds the position of every number of the element matrices, so that assembly is a
// loop without search.
#pragma once

#include <span>
#include <vector>

namespace latsch::numerics {

class SymmetricPattern {
 public:
  /// elements[e] lists the unknowns (0 ... size-1) that element e couples, in the order of the rows
  /// of its matrix, with -1 for a held one. The pattern has a diagonal entry also for an unknown
  /// that belongs to no element.
  SymmetricPattern(int size, const std::vector<std::vector<int>>& elements);

  int size() const { return size_; }
  int block_size() const { return block_size_; }
  int block_rows() const { return size_ / block_size_; }
  /// Returns the number of values that a matrix on this pattern stores.
  int value_count() const { return static_cast<int>(column_.size()) * block_size_ * block_size_; }

  /// Blocks of block row i are row_start()[i] ... row_start()[i+1]-1, with columns ascending and
  /// the diagonal last.
  std::span<const int> row_start() const { return row_start_; }
  std::span<const int> column() const { return column_; }

  /// One block of an element matrix: its row and column in the element matrix, and the start of its
  /// block in the values (column-major blocks).
  struct Scatter {
    int target;
    short row, column;
  };
  std::span<const Scatter> scatter(int element) const {
    return std::span(scatter_).subspan(scatter_start_[element],
                                       scatter_start_[element + 1] - scatter_start_[element]);
  }
  int element_size(int element) const { return element_size_[element]; }

  /// Searches the start of the block (row, column), row >= column, in the values; -1 if there is
  /// none.
  int find(int block_row, int block_column) const;

 private:
  void build_rows(const std::vector<std::vector<int>>& elements);
  void build_scatter(const std::vector<std::vector<int>>& elements);

  int size_, block_size_;
  std::vector<int> row_start_, column_;
  std::vector<Scatter> scatter_;
  std::vector<int> scatter_start_, element_size_;
};

}  // namespace latsch::numerics
