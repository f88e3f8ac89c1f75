// SPDX-License-Identifier: Apache-2.0
// The study `latsch new --drum` writes for recordings of a drum with a cleat: from a raw record to
// a flexible ring.
//
//   rig.toml                   names of the columns, plateaus of the speed, for latsch process
//   rig_processed/             its averages, made at once
//   ring.toml                  a known ring, where the fit begins
//   study.toml                 a test over the cleat for every plateau, compared with the average
//
// The plateaus are found in the speed: the longest stretches that stay within the margin of one
// speed. An average begins somewhere in a turn of the drum: its hit, the sample farthest from its
// mean, is moved to where the known ring answers most alike, and the delay that is left is fitted
// (curve_delay.h). Load is the mean of the average before the hit, less what the known ring gains
// by rolling; forces are compared about their means, so that the load cell's zero does not count.
// Noise is the spread of the passages over the root of their number.
//
// The cleat is what no recording tells: its height and length are asked for. The drum's diameter
// follows from speed and period; where teeth were recorded in the place of the speed it is asked
// for, too.
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
  std::string cleat;                      // "10 mm x 20 mm"
  std::string diameter;                   // "2.5 m"; empty: not known
  int teeth = 0;                          // of the toothed wheel; 0: the speed was recorded
  std::vector<std::string> columns = {};  // "Fz = LOAD [N]"
};

struct DrumStudy {
  std::string rig, ring, study;    // texts of rig.toml, ring.toml and study.toml
  std::vector<std::string> words;  // what the recordings hold and what is assumed, a line each
};

/// Processes the recordings and writes rig.toml and the tables of their averages into `folder`,
/// which is there. `known`: a flexible ring, which also tells where in time a test has the hit.
/// Throws InputError where the recordings are no drum test: a column that is missing (with those
/// there are), no plateau, a force that does not repeat itself.
DrumStudy drum_study(const DrumRecordings& recordings,
                     const Document& known,
                     const std::filesystem::path& folder,
                     const experiment::Language& language);

}  // namespace latsch::cli
