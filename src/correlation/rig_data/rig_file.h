// SPDX-License-Identifier: Apache-2.0
// Input of `latsch process`: the recordings of a drum rig and their processing.
//
//   title = "Race tire on the drum"
//   [channels]
//   time = "time"                        # names as in the files
//   speed = "speed"                      # of the drum's surface; or pulses = "tooth", of a toothed
//                                        # wheel on its shaft: pulse_speed.h
//   force = "Fz"                         # gives period and alignment; the filter is applied to it
//   also = ["Fx"]                        # averaged too; none unless given
//   group = "forces"                     # of a recorder's file: recorded_file.h; or resample =
//                                        # "0.5 ms", which joins its groups
//   [channels.units]                     # of files that have none (MAT)
//   Fz = "N"
//   [drum]
//   circumference = "6 m"                # optional: the period is then looked for around it
//   teeth = 60                           # of that wheel
//   [plateaus]
//   speeds = ["30 km/h", "60 km/h", "90 km/h"]
//   margin = "1 km/h"                    # and low_pass, order, trim, shortest: plateaus.h
//   [passages]
//   reference = "first"                  # or "average"; hit_at, align_below, most_shift,
//                                        # least_likeness: passages.h
//   [spectrum]
//   convention = "scipy"                 # or "octave", "matlab": numerics/signals/welch.h
//   segment = "0.25 s"
//   band = ["5 Hz", "300 Hz"]            # of tables and fits
//   [run.c_dummy]
//   file = "c_dummy.csv"
//
// Optional: the response that the rig adds (3-3) and the filter that removes it:
//
//   [hammer]
//   file = "hammer.csv"
//   input = "hammer"                     # output: the force channel unless given
//   window = "1 s"                       # and before, threshold: hammer.h
//   estimator = "H1"                     # or "H2"
//   [compensation]
//   fit = ["C"]                          # cases fitted together; none: the inverse of the hammer's
//   gain = 0.8                           # A/f^2, frequency, damping, direct: a start by hand
//   low_pass = "400 Hz"                  # behind an inverse
//   bootstrap = 100                      # draws; 0: none
//   apply = ["c_dummy"]                  # runs written once more, filtered
//   [case.C]
//   dummy = "c_dummy"
//   real = "c_real"
//   speed = "60 km/h"
//
// Simulated recordings of a known rig, in place of measured ones: [truth], see synthetic_files.h.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "correlation/rig_data/synthetic_files.h"
#include "measurement/hammer.h"
#include "measurement/passages.h"
#include "measurement/plateaus.h"
#include "numerics/signals/welch.h"

namespace latsch::correlation {

struct RigRun {
  std::string name;
  std::filesystem::path file;
};

struct RigHammer {
  std::filesystem::path file;
  std::string input, output;
  HammerSettings settings;
  Estimator estimator = Estimator::h1;
};

struct RigCase {
  std::string name;
  int dummy = 0, real = 0;  // indices of runs
  int speed = 0;            // index of a speed
};

struct RigCompensation {
  std::vector<int> fit;  // indices of cases
  std::optional<RigResponse> start;
  std::optional<double> low_pass;  // Hz
  int bootstrap = 0;
  std::vector<int> apply;  // indices of runs
};

struct RigFile {
  std::filesystem::path file;
  std::string title;
  std::string time, speed, force;
  std::string pulses;  // channel of the toothed wheel's pulses; empty: the speed was recorded
  int teeth = 0;
  std::vector<std::string> also;
  std::map<std::string, std::string> units;  // unit of each channel
  std::string group;       // group of the files that is read; empty: the reader chooses
  double resampled = 0.0;  // s; step at which all groups are joined; 0: they are not
  std::optional<double> circumference;  // m
  std::vector<double> speeds;           // m/s
  PlateauSettings plateaus;
  PassageSettings passages;
  numerics::Convention convention = numerics::Convention::scipy;
  std::string convention_name = "scipy";
  std::optional<double> segment;  // s
  FrequencyBand band{5.0, 300.0};
  std::vector<RigRun> runs;
  std::optional<RigHammer> hammer;
  std::vector<RigCase> cases;
  std::optional<RigCompensation> compensation;
  std::optional<SyntheticTruth> truth;
};

/// Throws InputError naming file and line.
RigFile read_rig_file(const std::filesystem::path& file);

}  // namespace latsch::correlation
