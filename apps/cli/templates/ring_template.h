// SPDX-License-Identifier: Apache-2.0
// The study `latsch new --ring-data` writes: the numbers of a flexible ring from what was measured
// of a tire.
//
//   alone      the published example of studies/ring_tire_data: loads, frequencies, dampings and
//              stiffnesses, to be replaced by one's own
//   of a model what it shows itself, as if measured:
//     loads        at three deflections: stiffness of the sidewall, its growth, and what of the
//                  pressure the belt carries
//     frequencies  in the air, rim held: f1 torsional n = 0, f2 radial n = 1, f3 lateral n = 0, f4
//                  lateral n = 1, f5 and f6 radial and lateral n = 2
//     dampings     of f1, f2 and f4, where the model has them
// Loads have no mass in them and frequencies do: together they determine the equivalent mass of the
// belt as well. Its radius and pressure are the model's; what neither loads nor frequencies feel,
// tread and blocks, stays as the known ring has it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/document.h"
#include "base/result.h"
#include "experiment/language.h"

namespace latsch::cli {

struct RingStudy {
  std::string ring, study;  // texts of the files ring.toml and study.toml
};

/// studies/ring_tire_data and its ring as they stand there, built into the program.
std::string_view published_ring();
std::string_view published_ring_study();

/// A number of a ring that a study may free.
struct RingNumber {
  const char *name, *path, *unit;
  double range;  // of its first guess, either way
};
/// Their [variable.NAME] as text, a line each, around the values of the known ring.
std::string ring_variables(const std::vector<RingNumber>& numbers, const Document& known);

RingStudy example_ring_study();

/// `known`: a flexible ring, whose numbers are first guesses; variables have ranges around them.
/// InputError where it is none or the model cannot do the tests; a Failure is the model's.
Result<RingStudy> ring_study_of(const experiment::SpecimenKind& kind,
                                const Document& model,
                                const Document& known,
                                const experiment::Language& language);

}  // namespace latsch::cli
