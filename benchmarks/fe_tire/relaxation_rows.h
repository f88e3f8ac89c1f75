// SPDX-License-Identifier: Apache-2.0
// Rows of ./bench.sh response: forces of a rolling tire that follow a slip which changes.
#pragma once

#include "models/fe_tire/analysis/fe_tire.h"
#include "options.h"
#include "table.h"

namespace latsch::benchmarks {

/// Adds slopes of steady forces, relaxation lengths beside steps of rolling in time, and the cost,
/// of a free wheel without losses.
void relaxation_rows(Table& table,
                     const Options& options,
                     fe_tire::FeTire& tire,
                     const fe_tire::Inflated& inflated);

}  // namespace latsch::benchmarks
