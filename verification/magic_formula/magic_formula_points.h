// SPDX-License-Identifier: Apache-2.0
// States of the sample tires with the results of MFeval (README.md), an independent program.
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

/// Returns the parameters of the sample tire for that version of the Magic Formula; nothing if the
/// sample files do not exist.
std::optional<magic_formula::Parameters> sample_tire(magic_formula::Version version);

/// The largest deviations from the reference as multiples of the tolerance: |dF|/(1e-6 N + 1e-9
/// |F|), |dM|/(1e-7 N m + 1e-9 |M|); at most 1 if all agree.
struct Disagreement {
  double force = 0.0, moment = 0.0, radius = 0.0;
  std::string worst;  // name of the state with the largest deviation
};
Disagreement disagreement(const MagicFormulaPoint& point, const magic_formula::SteadyState& found);

}  // namespace latsch::verification
