// SPDX-License-Identifier: Apache-2.0
// The study that `latsch new --drum` writes for recordings of a drum with a cleat. It fits a
// flexible ring tire to the raw record.
//
//   rig.toml                   column names and plateaus of the speed, for latsch process
//   rig_processed/             the averages that latsch process makes; already written
//   ring.toml                  a known ring, at which the fit starts
//   study.toml                 a test over the cleat for every plateau, compared with its average
//
// A plateau is a stretch of constant speed: the longest stretches that stay within a margin of one
// speed are used. An average begins at an arbitrary angle of the drum. Its hit, the sample farthest
// from its mean, is moved to the time with the greatest similarity to the response of the known
// ring, and the remaining delay is fitted (curve_delay.h). The load is the mean of the average
// before the hit, minus the increase of the known ring's load by rolling. Forces are compared
// relative to their means, so that the zero offset of the load cell does not matter. The noise is
// the scatter of the passages over the square root of their number.
//
// The height and length of the cleat are not in a recording and must be given. The drum's diameter
// follows from speed and period; if teeth were recorded instead of the speed, the diameter must be
// given too.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "experiment/language.h"

namespace latsch::cli {

struct DrumRecordings {
  std::vector<std::filesystem::path> files;
  std::string cleat;     // "10 mm x 20 mm"
  std::string diameter;  // "2.5 m"; empty: not known
  int teeth = 0;         // number of teeth of the speed sensor's wheel; 0: the speed was recorded
  std::vector<std::string> columns = {};  // "Fz = LOAD [N]"
};

struct DrumStudy {
  std::string rig, ring, study;  // contents of rig.toml, ring.toml and study.toml
  /// remarks for the user: contents of the recordings and assumptions, one in each line
  std::vector<std::string> words;
};

/// Processes the recordings and writes rig.toml and the tables of their averages into the existing
/// folder `folder`. `known` is a flexible ring tire; its response also determines the time of the
/// hit in a test. Throws InputError if the recordings are no drum test: if a column is missing (the
/// message lists the existing ones), the speed is never constant, or the force does not repeat
/// itself.
DrumStudy drum_study(const DrumRecordings& recordings,
                     const Document& known,
                     const std::filesystem::path& folder,
                     const experiment::Language& language);

}  // namespace latsch::cli
