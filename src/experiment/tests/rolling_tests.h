// SPDX-License-Identifier: Apache-2.0
// One test of a tire that rolls, as a file describes it, whatever the tire:
//
//   kind = "drum_cleat"              # drum_rig.h
//
//   kind = "slip_sweep"              # flat_track.h; alpha, kappa: one of the two
//   speed = "60 km/h"
//   load = "4 kN"
//   camber = "2 deg"                 # default 0
//   axle = "load"                    # what it keeps; "height": the axle's
//   frame = "W"                      # of the forces recorded (hub_frame.h); "W", "H" or "C"
//   alpha = ["-10 deg", "10 deg"]    # from, to
//   kappa = [-0.1, 0.1]              # from, to
//   run_in = "0.3 s"                 # default, as the next three
//   duration = "1 s"
//   step = "0.5 ms"
//   sample_step = "5 ms"             # of the record; a multiple of step, default step
//
//   kind = "static_stiffness"        # static_stiffness.h
//   deflections = ["10 mm", "20 mm"] # channels "deflection" and "force"
//   load = "4 kN"                    # in its place: under the load, a channel of one value for
//   directions = ["vertical", "longitudinal", "lateral", "torsional"]  # default: all
//
//   kind = "footprint"               # footprint_rig.h
//   kind = "modes"                   # vibration_rig.h; a flexible ring
//
//   kind = "steady_states"           # slip_states.h; a Magic Formula
//   states = "cornering.csv"         # beside the file
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/result.h"
#include "experiment/kinds/tire_kind.h"
#include "experiment/rigs/drum_rig.h"
#include "experiment/rigs/flat_track.h"
#include "experiment/rigs/footprint_rig.h"
#include "experiment/rigs/static_stiffness.h"
#include "experiment/rigs/vibration_rig.h"

namespace latsch::experiment {

struct SampledSweep {
  SlipSweep sweep;
  double sample_step = 5e-4;  // s
};

struct StaticTest {
  std::vector<double> deflections;  // m
  double load = 0.0;                // N
  std::vector<Direction> directions;
};

struct SteadyStates {
  formats::CsvTable states;
};

using RollingTest =
    std::variant<DrumTest, SampledSweep, StaticTest, FootprintTest, VibrationTest, SteadyStates>;

/// Throws InputError naming the place.
RollingTest read_rolling_test(const std::filesystem::path& file);

struct RecordedChannel {
  std::string name, unit;  // SI
  std::string frame = "";  // "W", "H" or "C" of a force or moment
};
/// What run() of this test gives.
std::vector<RecordedChannel> recorded(const RollingTest& test);

struct Reach {
  double from, to;  // SI
};
/// From where to where a channel goes by which others are told (time, deflection), as far as the
/// test alone says; nullopt where a run has to.
std::optional<Reach> reach(const RollingTest& test, const std::string& channel);

/// How many values its channels have; nullopt where a run has to tell.
std::optional<long> samples(const RollingTest& test);

/// A sentence for people: "drum, 60 km/h, 4500 N, cleat 15 mm x 30 mm".
std::string in_words(const RollingTest& test);

/// Throws InputError where the numbers make no tire or the kind cannot do the test.
Result<Channels> run(const TireKind& kind, const Document& numbers, const RollingTest& test);

}  // namespace latsch::experiment
