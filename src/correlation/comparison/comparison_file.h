// SPDX-License-Identifier: Apache-2.0
// Input of `latsch compare`: tires of any kind and the drum tests that all of them run through.
//
//   title = "Three tire models over the same cleats"
//   channels = ["Fx", "Fz"]              # hub forces that are compared
//   band = ["8 Hz", "200 Hz"]            # of spectra and levels
//   agreement = 3                        # dB: largest error of a reproduced band
//
//   [specimen]                           # a tire instead of a measured one
//   kind = "ring_tire"                   # experiment/language.h
//   file = "specimen.toml"
//   step = "0.25 ms"                     # of its simulation; that of the test unless given
//   seed = 1                             # of the noise
//   [specimen.noise]                     # standard deviation, each sample; 0 unless given
//   Fx = "10 N"
//
//   [test.slow]
//   file = "slow.toml"                   # experiment/rigs/drum_rig.h
//   measurement = "slow_measured.csv"    # time and the channels, in the frame of the test
//                                        # (experiment/rigs/hub_frame.h); not beside [specimen].
//                                        # A [measurement.NAME] of this file is named instead
//   fitted = true                        # the tires were fitted to it; a remark, default false
//
//   [measurement.slow]                   # as in a study: axes, columns, frame, in_frame ...
//   file = "slow_measured.csv"           # (laboratory/measurement.h)
//
//   [tire.rigid_ring]                    # as many as there are
//   title = "Rigid ring"
//   kind = "rigid_ring"
//   file = "rigid_ring.tir"
//   built_from = "static stiffness, modes"   # measurements it needs, for the table
//   parameters = "partly physical"
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/document_record.h"
#include "correlation/laboratory/measurement.h"
#include "experiment/language.h"
#include "experiment/rigs/drum_rig.h"
#include "measurement/rig_response_fit.h"

namespace latsch::correlation {

struct ComparedTire {
  std::string name, title;
  const experiment::SpecimenKind* kind = nullptr;
  std::filesystem::path file;
  Document numbers;
  std::string built_from, parameters;
};

struct ComparisonTest {
  std::string name, in_words;
  experiment::DrumTest drum;
  /// recording of the test; nullptr: the specimen is simulated instead
  std::shared_ptr<const Measurement> measurement;
  bool fitted = false;
};

struct ComparedSpecimen {
  ComparedTire tire;
  double step = 0.0;                    // s; 0: the step of the test
  std::map<std::string, double> noise;  // standard deviation, for each channel
  long seed = 1;
};

struct ComparisonFile {
  std::filesystem::path file;
  std::string title;
  std::vector<std::string> channels;
  FrequencyBand band;
  double agreement = 3.0;  // dB
  std::optional<ComparedSpecimen> specimen;
  std::vector<ComparisonTest> tests;
  std::vector<ComparedTire> tires;
};

/// Returns the unit of a force or moment by its name.
const char* unit_of(const std::string& channel);

/// Throws InputError naming the place.
ComparisonFile read_comparison_file(const std::filesystem::path& file,
                                    const experiment::Language& language);
/// Reads a comparison and returns every key that its readers request, by its path. Throws
/// InputError as read_comparison_file() does.
std::map<std::string, DeclaredKey> keys_of_comparison(const std::filesystem::path& file,
                                                      const experiment::Language& language);

}  // namespace latsch::correlation
