// SPDX-License-Identifier: Apache-2.0
// States of the sample tires evaluated by MFeval (README.md), for comparison with our values.
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

/// Throws InputError if the table cannot be read.
std::vector<MagicFormulaPoint> magic_formula_points();

/// Returns the parameters of the sample tire of that version; nothing if the sample files do not
/// exist.
std::optional<magic_formula::Parameters> sample_tire(magic_formula::Version version);

/// The largest deviation over the tolerance: |dF|/(1e-6 N + 1e-9 |F|), |dM|/(1e-7 N m + 1e-9 |M|);
/// at most 1 if all agree.
struct Disagreement {
  double force = 0.0, moment = 0.0, radius = 0.0;
  std::string worst;  // name of the point
};
Disagreement disagreement(const MagicFormulaPoint& point, const magic_formula::SteadyState& found);

}  // namespace latsch::verification
