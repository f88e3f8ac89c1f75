// SPDX-License-Identifier: Apache-2.0
// Elimination order of a sparse symmetric matrix, and the dense fronts that result from it.
//
// Nested dissection (METIS) orders the block rows. The elimination tree [Liu, The role of
// elimination trees in sparse factorization, SIAM J. Matrix Anal. Appl. 11 (1990)] and the rows of
// every column of the factor follow from the pattern. Columns with the same rows form a front.
// Small fronts join their parents if this stores few zeros, because dense products on larger fronts
// are faster [Ashcraft & Grimes, The influence of relaxed supernode partitions on the multifrontal
// method, ACM Trans. Math. Softw. 15 (1989)].
#pragma once

#include <vector>

#include "numerics/sparse/symmetric_pattern.h"

namespace latsch::numerics {

/// Successive columns of the factor that share their rows. All numbers count block rows in the
/// order of elimination.
struct Front {
  int first = 0, columns = 0;  // pivots
  std::vector<int> below;      // block rows below the pivots, ascending
  /// Index of the front that holds the first row below the pivots; -1: none.
  int parent = -1;

  int rows() const { return columns + static_cast<int>(below.size()); }
};

struct Elimination {
  /// Position of every block row of the pattern in the order of elimination.
  std::vector<int> position;
  std::vector<Front> fronts;  // children precede their parents; the last child directly
  /// Number of block rows at the end that form the last front alone; 0: none.
  int interface = 0;
};

Elimination eliminate(const SymmetricPattern& pattern);
/// `interface`: block rows that are eliminated last, together, in this order.
Elimination eliminate(const SymmetricPattern& pattern, const std::vector<int>& interface);
/// Takes the order of all other rows from `whole`, the elimination of the same pattern without an
/// interface. The separators of `whole` also separate the remaining rows, though less well, and no
/// new dissection has to be computed.
Elimination eliminate(const SymmetricPattern& pattern,
                      const std::vector<int>& interface,
                      const Elimination& whole);

}  // namespace latsch::numerics
