// SPDX-License-Identifier: Apache-2.0
// The study that `latsch new --ring-data` writes. It identifies the parameters of a flexible ring
// tire from measurements of a tire.
//
//   without a model  the published example of studies/ring_tire_data: loads, frequencies, dampings
//                    and stiffnesses, to be replaced by the user's own measurements
//   with a model     results of its simulation serve as measurements:
//     loads        at three deflections: for the stiffness of the sidewall, its growth, and the
//                  share of the pressure that the belt carries
//     frequencies  in the air, rim fixed: f1 torsional n = 0, f2 radial n = 1, f3 lateral n = 0, f4
//                  lateral n = 1, f5 and f6 radial and lateral n = 2
//     dampings     of f1, f2 and f4, if the model has them; a finite-element tire with losses then
//                  has the moduli of each frequency
//
// Loads do not depend on mass and frequencies do, so together they also determine the equivalent
// mass of the belt. Its radius and pressure are those of the model. Tread and blocks, which affect
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

/// Return the study of studies/ring_tire_data and its ring, unchanged; the program contains them.
std::string_view published_ring();
std::string_view published_ring_study();

/// A parameter of a ring tire that a study may identify.
struct RingNumber {
  const char *name, *path, *unit;
  double range;  // factor between the initial value and each end of the range
};
/// Returns the sections [variable.NAME] of the parameters as text, one in each line, with ranges
/// around the values of the known ring.
std::string ring_variables(const std::vector<RingNumber>& numbers, const Document& known);

RingStudy example_ring_study();

/// Returns the study for a model. `known` is a flexible ring tire with initial values, and
/// variables have ranges around these. Throws InputError if `known` is no ring or the model cannot
/// run the tests; a Failure reports that a simulation of the model failed.
Result<RingStudy> ring_study_of(const experiment::SpecimenKind& kind,
                                const Document& model,
                                const Document& known,
                                const experiment::Language& language);

}  // namespace latsch::cli
