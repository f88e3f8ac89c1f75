// SPDX-License-Identifier: Apache-2.0
// Whether the numbers of a study can be those of a tire: what each quantity usually is, in one
// table, and what a measurement has to have to do with the tire it was made on.
//
// Units are right by then (a pressure is a pressure); magnitudes are not: 240 bar for 240 kPa, kN
// read as N, the density of air, a deflection deeper than the section is high. What is unusual may
// be meant and is a warning; what no tire has is impossible. Also found: numbers that two variables
// set, modes and experiments that stand there twice.
//
// The ranges cover tires from a bicycle's to an earthmover's; they are orders of magnitude, not
// tolerances. Not seen: a wrong number of a plausible size.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "correlation/study/study.h"

namespace latsch::correlation {

struct Finding {
  Place place;
  std::string sentence;     // what was found, what is usual, what to do
  bool impossible = false;  // no tire is like that; otherwise it may be meant
};

/// In the order of model, study, measurements. The model's file, the study's and the measurements
/// are read once more, for the lines.
std::vector<Finding> implausible(const Study& study);

}  // namespace latsch::correlation
