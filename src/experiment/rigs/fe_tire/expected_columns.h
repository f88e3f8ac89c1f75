// SPDX-License-Identifier: Apache-2.0
// Finds the columns and sectors with the least expected error, from the changes by halving
// (column_changes.h).
#pragma once

#include <limits>
#include <vector>

#include "experiment/rigs/fe_tire/column_changes.h"

namespace latsch::placement {

/// A division of the mesh into columns with a smaller expected error, for one number of sectors.
struct Way {
  int sectors = 0;
  std::vector<double> rho;  // columns per position, constant in each column
  std::vector<int> number;  // columns between neighboring fixed ends
  double error = std::numeric_limits<double>::infinity();
};

/// `fixed` are positions at which columns must end; `most` limits the unknowns.
Way way(const Judged& mesh,
        const ColumnChanges& changes,
        const std::vector<double>& fixed,
        int sectors,
        int most);

/// Returns the least number of sectors of a ring beyond its zones on both sides of the contact.
int fewest_sectors(const fe_tire::Section& section);

/// Returns the number of sectors with the least expected error among the permitted numbers near the
/// present one.
int best_sectors(const Judged& mesh,
                 const ColumnChanges& changes,
                 const std::vector<double>& fixed,
                 int most);

}  // namespace latsch::placement
