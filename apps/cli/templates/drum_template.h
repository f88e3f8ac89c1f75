// SPDX-License-Identifier: Apache-2.0
// The study that `latsch new --drum` writes for recordings of a drum with a cleat: from a raw
// record to a flexible ring.
//
//   rig.toml                   names of the columns, plateaus of the speed, for latsch process
//   rig_processed/             its averages, made at once
//   ring.toml                  a known ring, with which the fit begins
//   study.toml                 a test over the cleat for every plateau, compared with the average
//
// The plateaus are found in the speed: the longest stretches that stay within the margin of one
// speed. An average begins at an arbitrary angle of the drum: its hit, the sample farthest from its
// mean, is moved to the position with the greatest similarity to the response of the known ring,
// and the remaining delay is fitted (curve_delay.h). The load is the mean of the average before the
// hit, minus the increase of the known ring by rolling; forces are compared relative to their
// means, so that the load cell's zero does not count. Noise is the scatter of the passages over the
// root of their number.
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
  std::string cleat;                      // "10 mm x 20 mm"
  std::string diameter;                   // "2.5 m"; empty: not known
  int teeth = 0;                          // number of the toothed wheel; 0: the speed was recorded
  std::vector<std::string> columns = {};  // "Fz = LOAD [N]"
};

struct DrumStudy {
  std::string rig, ring, study;    // contents of rig.toml, ring.toml and study.toml
  std::vector<std::string> words;  // contents of the recordings and assumptions, one in each line
};

/// Processes the recordings and writes rig.toml and the tables of their averages into the existing
/// folder `folder`. `known` is a flexible ring, which also determines the time of the hit in a
/// test. Throws InputError if the recordings are no drum test: a missing column (with the existing
/// ones), no plateau, a force that does not repeat itself.
DrumStudy drum_study(const DrumRecordings& recordings,
                     const Document& known,
                     const std::filesystem::path& folder,
                     const experiment::Language& language);

}  // namespace latsch::cli
