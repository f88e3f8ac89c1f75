// SPDX-License-Identifier: Apache-2.0
// The study that `latsch new --ring-data` writes: it identifies the numbers of a flexible ring from
// measurements of a tire.
//
//   alone      the published example of studies/ring_tire_data: loads, frequencies, dampings and
//              stiffnesses, to be replaced by the user's own
//   of a model results of its simulation, used as measurements:
//     loads        at three deflections: stiffness of the sidewall, its growth, and the share of
//                  the pressure that the belt carries
//     frequencies  in the air, rim held: f1 torsional n = 0, f2 radial n = 1, f3 lateral n = 0, f4
//                  lateral n = 1, f5 and f6 radial and lateral n = 2
//     dampings     of f1, f2 and f4, if the model has them
// Loads do not depend on mass and frequencies do: together they determine the equivalent mass of
// the belt as well. Its radius and pressure are those of the model; tread and blocks, which affect
// neither loads nor frequencies, stay as in the known ring.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/document.h"
#include "base/result.h"
#include "experiment/language.h"

namespace latsch::cli {

struct RingStudy {
  std::string ring, study;  // contents of the files ring.toml and study.toml
};

/// studies/ring_tire_data and its ring, contained in the program unchanged.
std::string_view published_ring();
std::string_view published_ring_study();

/// A number of a ring that a study may free.
struct RingNumber {
  const char *name, *path, *unit;
  double range;  // factor by which its range extends from the first guess, up and down
};
/// Returns the [variable.NAME] of the numbers as text, one in each line, around the values of the
/// known ring.
std::string ring_variables(const std::vector<RingNumber>& numbers, const Document& known);

RingStudy example_ring_study();

/// `known` is a flexible ring, whose numbers are the first guesses; variables have ranges around
/// them. Throws InputError if it is no ring or the model cannot run the tests; a Failure is that of
/// the model.
Result<RingStudy> ring_study_of(const experiment::SpecimenKind& kind,
                                const Document& model,
                                const Document& known,
                                const experiment::Language& language);

}  // namespace latsch::cli
