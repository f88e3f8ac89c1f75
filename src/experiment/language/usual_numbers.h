// SPDX-License-Identifier: Apache-2.0
// The usual magnitudes of the numbers in files of tires, cars, tests and studies; this is the only
// table of them.
//
// Readers have checked units (a pressure is a pressure), but not magnitudes: 240 bar for 240 kPa,
// grams for kilograms, the density of air. An unusual number may be intended and is a warning; a
// number that no tire has is impossible. The ranges cover tires from a bicycle's to an
// earthmover's; they are orders of magnitude, not tolerances. A wrong number of a plausible size is
// not detected.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/document.h"
#include "base/error.h"

namespace latsch::experiment {

/// A number that is not usual, or a note on how a file was read.
struct Finding {
  Place place;
  std::string sentence;     // the finding, the usual range, and advice
  bool impossible = false;  // true if no tire is like that; otherwise the number may be meant
  bool is_note = false;     // true if it says how a file was read, not that a number is unusual
};

/// Usual range of a quantity, in `unit`. A value outside of `from` to `to` is unusual, one below
/// `least` or above `most` impossible.
struct UsualMagnitude {
  const char* below;  // table that contains the key, the first parts of its path; empty: any
  const char* key;
  const char* words;
  const char* unit;
  double least, from, to, most;
  std::vector<const char*> taken_for;  // units that are often confused
  bool zero_allowed = false;
  bool is_signed = false;  // true if the range is of the absolute value
};

enum class Seen { usual, unusual, impossible };

/// Judges whether a value in SI is usual, unusual or impossible.
Seen judged(const UsualMagnitude& usual, double si);
/// Returns for example "a wheel load is usually 100 to 60000 N".
std::string usual_in_words(const UsualMagnitude& usual);
/// Returns the usual magnitude of the number at a path and, if `unit` is given, of this dimension;
/// nullptr if the table has none. Numbers in parts of a car are found by their path within the
/// part: "front_suspension.bushing.all.x" as "bushing.all.x".
const UsualMagnitude* usual_magnitude(std::string_view path, std::string_view unit = "");

/// A number of a document as it is written.
struct Written {
  Place place;
  std::string text;  // empty if the number is part of a list
};
Written written_at(const Document& document, const std::string& path);
/// Returns the key a number belongs to: "deflections" of "test.a.deflections.values.2".
std::string key_of(std::string path);

/// Compares a value in SI with its usual range; returns a finding if it lies outside. `name` is the
/// number's name in the sentence.
std::optional<Finding> unusual(const UsualMagnitude& usual,
                               const Written& written,
                               const std::string& name,
                               double si);

/// Examines all numbers of a document; those of a model also in relation to each other: cords that
/// overlap, a belt too light for its size. `below` is the table to which the whole document
/// corresponds, "test" for the file of a test; empty: the paths are used as written. Paths for
/// which `passed_over` is true are not examined.
std::vector<Finding> unusual_numbers(
    const Document& document,
    const std::string& below = "",
    const std::function<bool(const std::string&)>& passed_over = nullptr);

class SpecimenKind;

/// Returns what the user should know about a model before using it: what reading left out of its
/// file or assumed for it, and its unusual numbers. `file` is the file from which `numbers` were
/// read.
std::vector<Finding> findings_of_model(const SpecimenKind& kind,
                                       const Document& numbers,
                                       const std::filesystem::path& file);

/// Returns the finding with its place, as it is shown to the user.
std::string in_words(const Finding& finding);

}  // namespace latsch::experiment
