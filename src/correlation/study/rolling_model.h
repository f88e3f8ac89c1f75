// SPDX-License-Identifier: Apache-2.0
// [model] in a study: a tire that rolls and the tests it is driven through, in this process.
//
//   [model]
//   kind = "ring_tire"               # or rigid_ring, magic_formula: experiment/kinds/tire_kind.h
//   file = "tire.toml"               # beside the study; a .tir for the other two
//
//   [variable.radial]                # a path into the file's numbers, see variables.h; in a .tir
//   path = "sidewall.radial.stiffness"         # the name of the parameter: "PKY1"
//
//   [test.slow]
//   file = "slow.toml"               # experiment/tests/rolling_tests.h
//
//   [experiment.slow_Fz]             # curve_experiment.h
//   kind = "curve"
//   x = "slow/time"                  # TEST/CHANNEL
//   y = "slow/Fz"
//   measurement = "slow_measured.csv"
//
// A trial runs the tests that fitted experiments or constraints ask for, each with a new tire.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/document.h"
#include "correlation/observable/known_channels.h"
#include "experiment/tests/rolling_tests.h"

namespace latsch::correlation {

struct RollingModel {
  struct Test {
    std::string name;
    std::filesystem::path file;
    experiment::RollingTest test;
    std::string text;  // of the file, and of what it names
  };

  const experiment::TireKind* kind = nullptr;
  std::vector<Test> tests;
};

/// The tire file of [model]. Throws InputError.
std::filesystem::path rolling_tire_file(const Node& model, const std::filesystem::path& folder);

/// Reads the kind of [model] and every [test.NAME] of the study. Throws InputError.
RollingModel read_rolling_model(const Node& model,
                                const Node& study,
                                const std::filesystem::path& folder);

std::vector<KnownChannel> known_channels(const RollingModel& model);

/// The channels of the tests of those names, under "TEST/CHANNEL". Throws InputError where the
/// numbers make no tire.
Result<Channels> run(const RollingModel& model,
                     const Document& numbers,
                     const std::vector<std::string>& tests);

/// "slow" of "slow/Fz".
std::string test_of(const std::string& channel);

}  // namespace latsch::correlation
