// SPDX-License-Identifier: Apache-2.0
// The kinds of tires that roll, each with its file: how the file becomes numbers that can vary, and
// numbers a tire.
//
//   ring_tire        a TOML file (models/ring_tire/description/ring_reader.h)
//   rigid_ring       a .tir with belt and springs (formats/tire/tir_file.h)
//   magic_formula    any .tir
//
// A new kind is one file x_kind.cpp that fills a TireKind, and its line in tire_kind.cpp.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/document.h"
#include "experiment/rigs/vibration_rig.h"
#include "formats/tables/csv_table.h"
#include "measurement/channels.h"
#include "models/tire/tire.h"

namespace latsch::experiment {

struct TireKind {
  std::string name;
  std::string in_words;  // "flexible ring"
  std::string file;      // "a TOML file with kind = \"ring_tire\""
  /// The numbers of a file by their paths: "sidewall.radial.stiffness", "PKY1". InputError.
  Document (*read)(const std::filesystem::path& file);
  /// The tire they make. InputError where they make none.
  std::unique_ptr<Tire> (*build)(const Document& numbers);
  /// The text of a tire file with these numbers.
  std::string (*text)(const Document& numbers);
  /// Answers to a table of states as `latsch evaluate` gives them; nullptr: no tire of steady
  /// states.
  Channels (*steady)(const Document& numbers, const formats::CsvTable& states) = nullptr;
  /// nullptr: a tire without a belt that vibrates.
  Result<Channels> (*modes)(const Document& numbers, const VibrationTest& test) = nullptr;
  /// Raised whenever a tire of the same numbers answers other than before: trials of another
  /// version are not taken for this one's.
  int version = 2;
};

/// In the order in which people read of them.
const std::vector<const TireKind*>& tire_kinds();
/// "ring_tire", "rigid_ring", ...
std::vector<std::string> tire_kind_names();
/// nullptr where none is called so.
const TireKind* find_tire_kind(const std::string& name);

/// Of a tire file alone: the `kind` a TOML file states, `magic_formula` for a .tir. InputError.
const TireKind& kind_of_file(const std::filesystem::path& file);

}  // namespace latsch::experiment
