// SPDX-License-Identifier: Apache-2.0
// Simulated recordings of a rig with known parameters, in place of measured recordings:
//
//   [truth]
//   circumference = "6 m"
//   rate = "2 kHz"
//   seed = 1
//   gain = 0.45                          # of the rig: A/f^2,
//   frequency = "92 Hz"                  # f,
//   damping = 0.06                       # zeta,
//   direct = 0.55                        # c
//   hold = "20 s"                        # of each plateau
//   drift = "0.2 %"                      # of the speed over a plateau
//   hits = 20                            # of the hammer
//   hammer_noise = "2 N"
//   [truth.run.c_dummy]                  # for each [run]
//   rim = "dummy"                        # or "real"
//   load = "4 kN"
//   noise = "15 N"
//   modes = [["45 Hz", "5 %", "400 N"], ["92 Hz", "4 %", "250 N"]]
//                                        # frequency, damping, amplitude
#pragma once

#include <string>
#include <vector>

#include "base/document.h"
#include "measurement/synthetic_rig.h"

namespace latsch::correlation {

struct RigFile;

struct SyntheticTruth {
  SyntheticRig rig;
  std::vector<SyntheticRun> runs;  // in the order of the runs
  int hits = 20;                   // number of hammer hits
  double hammer_noise = 2.0;       // standard deviation, N
};

/// Reads the table [truth] for runs with these names, each at all of these speeds.
SyntheticTruth read_truth(const Node& table,
                          const std::vector<std::string>& runs,
                          const std::vector<double>& speeds);

/// Writes every recording that the file names. Returns the names of the files.
std::vector<std::string> write_synthetic_files(const RigFile& rig);

}  // namespace latsch::correlation
