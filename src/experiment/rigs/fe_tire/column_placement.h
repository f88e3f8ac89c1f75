// SPDX-License-Identifier: Apache-2.0
// Where the columns of elements of a section should end: short where shorter ones move the results.
//
// Every column of a mesh is halved in turn: what that changes in growth and unloaded modes is the
// column's part of their error, c h^3 of its length h. With as many unknowns the error is least
// where h ~ (cost / c)^(1/3), cost the unknowns of a column [equidistribution: de Boor 1973,
// Lecture Notes in Mathematics 363]. The columns moved there are halved again, for c changes where
// they move, and the best mesh met is kept. One sector serves, so a tire takes seconds.
//   Error is the largest of three: of the unloaded tire, by the limit of all elements refined two
// and three times at once, for directions cancel less of each other together than one by one
// (growth of a 295/55R17 seemed right within 0.6 % and was off by 1.5), and rows of a smeared
// section overshoot where halved; of a loaded one, whose modes bend where sectors are widest; and
// of columns alone, for what rows cancel on one mesh they may not on a finer one (tire A smeared:
// lateral n=0 seemed right within 0.6 % and was off by 1.7).
//   Asked for a deflection, columns and sectors so placed are then exchanged by what is measured on
// the ground (column_exchange.h): some minutes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch {

struct ColumnPlacementSettings {
  int unknowns = 0;  // of the mesh at most; 0: as many as it has
  int modes = 20;
  int rounds = 6;               // of columns moved
  bool choose_sectors = false;  // their number too, even, within the same unknowns
  double deflection = 0.0;      // m; > 0: then exchanged by what is seen on the ground
};

struct ColumnPlacement {
  std::vector<double> columns;  // Section::columns
  int sectors = 0;
  int unknowns = 0;
  /// Of the quantity that errs most, as estimated above.
  double error_before = 0.0, error = 0.0;
  std::string worst;  // its name: "growth", "lateral n=2"
  /// Why not all rounds were gone through; what stands above is the best of those before. Empty
  /// where they were.
  std::string stopped = {};
};

/// `progress` is told each round before it begins. Fails where the tire cannot be inflated, and
/// where the fewest columns make more unknowns than allowed in the first round; a later round that
/// fails ends the search with the best so far.
Result<ColumnPlacement> place_columns(const fe_tire::TireDescription& tire,
                                      const ColumnPlacementSettings& settings,
                                      const std::function<void(const std::string&)>& progress = {});

}  // namespace latsch
