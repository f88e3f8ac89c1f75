// SPDX-License-Identifier: Apache-2.0
// Places the ends of the columns of elements of a section: columns are short where shorter ones
// change the results.
//
// Every column of a mesh is halved in turn: the change of growth and unloaded modes is the column's
// part of their error, c h^3 of its length h. For a given number of unknowns the error is least if
// h ~ (cost / c)^(1/3), where cost is the number of unknowns of a column [equidistribution: de Boor
// 1973, Lecture Notes in Mathematics 363]. The moved columns are halved again, because c changes as
// they move, and the best mesh is kept. The model is one sector, so a tire needs seconds.
//   The error is the largest of three: that of the unloaded tire, by the limit of all elements
// refined two and three times at once, because directions cancel each other less together than one
// by one (growth of a 295/55R17 seemed right within 0.6 % and had an error of 1.5 %), and rows of a
// smeared section overshoot if halved; that of a loaded tire, whose modes bend where sectors are
// widest; and that of columns alone, because what rows cancel on one mesh they may not cancel on a
// finer one (tire A smeared: lateral n=0 seemed right within 0.6 % and had an error of 1.7 %).
//   If a deflection is given, columns and sectors are then exchanged according to measured errors
// on the ground (column_exchange.h), in some minutes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch {

struct ColumnPlacementSettings {
  int unknowns = 0;  // largest number of unknowns; 0: as many as the present mesh has
  int modes = 20;
  int rounds = 6;               // most rounds of moving columns
  bool choose_sectors = false;  // true: chooses an even number of sectors, too
  /// Deflection, m; if > 0, columns and sectors are then exchanged according to errors on the
  /// ground.
  double deflection = 0.0;
};

struct ColumnPlacement {
  std::vector<double> columns;  // Section::columns
  int sectors = 0;
  int unknowns = 0;
  /// Error of the quantity with the greatest error, as estimated above.
  double error_before = 0.0, error = 0.0;
  std::string worst;  // name of that quantity: "growth", "lateral n=2"
  /// Reason why not all rounds were completed; the result is then the best of the completed rounds.
  /// Empty if all were.
  std::string stopped = {};
};

/// `progress` is called before each round. Fails if the tire cannot be inflated, or if the least
/// number of columns has more unknowns than allowed in the first round; a failure of a later round
/// ends the search with the best result so far.
Result<ColumnPlacement> place_columns(const fe_tire::TireDescription& tire,
                                      const ColumnPlacementSettings& settings,
                                      const std::function<void(const std::string&)>& progress = {});

}  // namespace latsch
