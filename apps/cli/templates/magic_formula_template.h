// SPDX-License-Identifier: Apache-2.0
// The study that `latsch new --magic-formula` writes for recordings of a tire test: it identifies
// the coefficients that the recordings determine, stage by stage.
//
//   Fy, Fx, Mz    the curve and its dependence on load; then on camber and pressure, if these
//                 vary; then the mutual reduction of forces by slip along and across
//   Mx, My        on the quantities with the largest effect
//   all           every coefficient with every channel: the result, with its intervals
//
// A coefficient of a condition (load, camber, pressure, speed) is freed if the recordings have more
// distinct levels of the condition than the order of the coefficient's polynomial
// (models/magic_formula/coefficient_conditions.h): two pressures free no quadratic term. The study
// and the terminal say what was left out, and why.
//
// Recordings or samples that are held out (held_out.h) are experiments with use = "predict"; levels
// are counted and the start is taken from the fitted samples alone.
//
// The usual ranges of three coefficients include tires that behave implausibly beyond the data, so
// the study narrows them (kBounds): PDY2 and PDX2 do not exceed 0, so friction falls with load;
// QCZ1 keeps the trail from turning back far beyond 0.
//
// Every experiment has noise = "own_stage", so that the last stage weighs it by the error that its
// own stage left. With equal relative weights the last stage let Mx and Mz pull the side force of a
// race tire from 2.1 to 3.6 %.
//
// A condition varies if it covers more than a small part of its usual range. Samples of cornering
// and of driving are separate experiments. The tire starts with values that are estimated directly
// from the recordings: grip, slopes, nominal load and pressure, radius and stiffness from the
// loaded radius.
//
// C, D and B keep their signs by the ranges of their coefficients; the formula itself limits E to
// 1, which keeps the curve plausible. Linear constraints E <= 1 at the ends of the load, for PEY1
// and PEY2, QEZ1 and QEZ2, are not written, because they multiply the number of trials without a
// better fit.
//
// In a sweep of some degrees a second forces lag by the relaxation length: the result is a loop
// that no coefficient of the steady state reproduces. If a recording shows one (recorded_lag.h),
// its tests are slip_history, and stages relaxation_y and relaxation_x fit the carcass stiffnesses
// that cause the lag; otherwise samples count as steady states. A comment in the study says which
// of the two applies, and the figure that decided it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/templates/held_out.h"

namespace latsch::cli {

struct TireTestFiles {
  std::vector<std::filesystem::path> files;
  std::string axes;  // axis convention, such as "sae"; empty: the sign of Fz decides
  std::vector<std::string> columns = {};  // "Fz = LOAD [N]"
  std::optional<double> unloaded_radius;  // m; unless the loaded radius was recorded
  HeldOut held_out = {};                  // samples that are predicted instead of fitted
};

struct MagicFormulaStudy {
  std::string tire, study;         // contents of a .tir and of the study
  std::vector<std::string> words;  // remarks for the user about the contents of the recordings
};

/// Returns the study, to be written to `folder`. Throws InputError if the files are no tire test or
/// the radius is not known.
MagicFormulaStudy magic_formula_study(const TireTestFiles& test,
                                      const std::filesystem::path& folder);

}  // namespace latsch::cli
