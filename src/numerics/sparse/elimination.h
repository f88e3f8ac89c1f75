// SPDX-License-Identifier: Apache-2.0
// In which order a sparse symmetric matrix is eliminated, and which dense fronts that makes.
//
// Nested dissection (METIS) orders the block rows; the elimination tree [Liu, The role of
// elimination trees in sparse factorization, SIAM J. Matrix Anal. Appl. 11 (1990)] and the rows of
// every column of the factor follow from the pattern. Columns of the same rows make one front;
// small fronts join their parents where that stores few zeros, because dense products on larger
// fronts are faster [Ashcraft & Grimes, The influence of relaxed supernode partitions on the
// multifrontal method, ACM Trans. Math. Softw. 15 (1989)].
#pragma once

#include <vector>

#include "numerics/sparse/symmetric_pattern.h"

namespace latsch::numerics {

/// Successive columns of the factor that share their rows; all in block rows, in the order of
/// elimination.
struct Front {
  int first = 0, columns = 0;  // pivots
  std::vector<int> below;      // rows under the pivots, ascending
  int parent = -1;             // front that holds the first of them; -1: none below

  int rows() const { return columns + static_cast<int>(below.size()); }
};

struct Elimination {
  std::vector<int> position;  // of every block row of the pattern
  std::vector<Front> fronts;  // children before their parents, the last child right before
  int interface = 0;          // block rows at the end that make the last front, alone; 0: none
};

Elimination eliminate(const SymmetricPattern& pattern);
/// `interface`: block rows that are eliminated last, together, in this order.
Elimination eliminate(const SymmetricPattern& pattern, const std::vector<int>& interface);
/// The same with all others in the order of `whole`, of the same pattern without an interface: what
/// separates it separates what is left, if not as well. Saves the dissection.
Elimination eliminate(const SymmetricPattern& pattern,
                      const std::vector<int>& interface,
                      const Elimination& whole);

}  // namespace latsch::numerics
