// SPDX-License-Identifier: Apache-2.0
// States of the sample tires evaluated by MFeval (README.md), beside our values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "models/magic_formula/magic_formula.h"

namespace latsch::verification {

struct MagicFormulaPoint {
  magic_formula::Version version;
  magic_formula::Conventions conventions;
  magic_formula::State state;
  magic_formula::SteadyState expected;
};

/// Throws InputError where the table cannot be read.
std::vector<MagicFormulaPoint> magic_formula_points();

/// The parameters of the sample tire of that version; nothing where the sample files are not there.
std::optional<magic_formula::Parameters> sample_tire(magic_formula::Version version);

/// The largest excess over the reach: |dF|/(1e-6 N + 1e-9 |F|), |dM|/(1e-7 N m + 1e-9 |M|); at most
/// 1 where all agree.
struct Disagreement {
  double force = 0.0, moment = 0.0, radius = 0.0;
  std::string worst;  // which point
};
Disagreement disagreement(const MagicFormulaPoint& point, const magic_formula::SteadyState& found);

}  // namespace latsch::verification
