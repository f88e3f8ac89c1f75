// SPDX-License-Identifier: Apache-2.0
// The study `latsch new --magic-formula` writes for recordings of a tire test: the coefficients
// that they tell, stage by stage.
//
//   Fy, Fx, Mz    the curve and what load changes in it; then what camber and pressure change,
//                 where these vary; then what slip along and across takes from each other
//   Mx, My        of what they depend on most
//   all           every coefficient with every channel: the result, with its intervals
//
// A coefficient of a condition (load, camber, pressure, speed) is freed where the recordings hold
// more distinct levels of it than the order of its polynomial (models/magic_formula/
// coefficient_conditions.h): two pressures free no quadratic term. The study and the terminal say
// what was left out, and why.
//
// Recordings or samples that are held out (held_out.h) are experiments with use = "predict"; levels
// are counted and the start is taken from the fitted samples alone.
//
// The usual ranges of three coefficients reach to tires that misbehave beyond the data, so the
// study bounds them further (kBounds): PDY2 and PDX2 do not exceed 0, so friction falls with load;
// QCZ1 keeps the trail from turning back far beyond 0.
//
// Every experiment has noise = "own_stage", so that the last stage weighs it by the error that its
// own stage left. With equal relative weights the last stage let Mx and Mz pull the side force of a
// race tire from 2.1 to 3.6 %.
//
// What varies is what goes through more than a little of its usual range. Samples of cornering and
// of driving are separate experiments. The tire begins with what the recordings show at a glance:
// grip, slopes, nominal load and pressure, radius and stiffness from the loaded radius.
//
// C, D and B keep their signs by the ranges of their coefficients; E above 1 is cut off by the
// formula itself, which keeps the curve sane. E <= 1 at the ends of the load, as linear constraints
// of PEY1 and PEY2, QEZ1 and QEZ2, is not written: on the race tire of ./bench.sh race_tire_mf it
// took 159 recordings in place of 48, for a side force no closer (3.85 in place of 3.75 %).
//
// A sweep of some degrees a second lags by its relaxation length: a loop that no coefficient of the
// steady state closes. Where a recording shows one (recorded_lag.h), its tests are slip_history,
// and stages relaxation_y and relaxation_x fit the stiffnesses of the carcass behind it; else
// samples count as steady states. The study says in a comment which of the two, by which figure.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/templates/held_out.h"

namespace latsch::cli {

struct TireTestFiles {
  std::vector<std::filesystem::path> files;
  std::string axes;                       // "sae"; empty: by the sign of Fz
  std::vector<std::string> columns = {};  // "Fz = LOAD [N]"
  std::optional<double> unloaded_radius;  // m; unless the loaded radius was recorded
  HeldOut held_out = {};                  // predicted, not fitted
};

struct MagicFormulaStudy {
  std::string tire, study;         // texts of a .tir and of the study
  std::vector<std::string> words;  // what the recordings hold
};

/// The study lies in `folder`. Throws InputError where the files are no tire test or the radius is
/// not known.
MagicFormulaStudy magic_formula_study(const TireTestFiles& test,
                                      const std::filesystem::path& folder);

}  // namespace latsch::cli
