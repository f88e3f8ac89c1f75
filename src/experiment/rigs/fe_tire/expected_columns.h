// SPDX-License-Identifier: Apache-2.0
// The columns and sectors that are expected to err least, by what halved ones change
// (column_changes.h).
#pragma once

#include <limits>
#include <vector>

#include "experiment/rigs/fe_tire/column_changes.h"

namespace latsch::placement {

/// Columns of a mesh of so many sectors that is expected to err less.
struct Way {
  int sectors = 0;
  std::vector<double> rho;  // columns per position, constant in each column
  std::vector<int> number;  // of columns between neighboring fixed ends
  double error = std::numeric_limits<double>::infinity();
};

/// `fixed` are positions where columns must end; `most` unknowns.
Way way(const Judged& mesh,
        const ColumnChanges& changes,
        const std::vector<double>& fixed,
        int sectors,
        int most);

/// Sectors of a ring, beyond those of its zones on both sides of the contact.
int fewest_sectors(const fe_tire::Section& section);

/// Of the sectors a ring may have, near those it has, those that are expected to err least.
int best_sectors(const Judged& mesh,
                 const ColumnChanges& changes,
                 const std::vector<double>& fixed,
                 int most);

}  // namespace latsch::placement
