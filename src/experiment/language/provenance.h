// SPDX-License-Identifier: Apache-2.0
// The origin of the numbers of a fitted model, for the comments of its file.
//
// Code that fits a model fills in a Provenance; SpecimenKind::annotated_text() writes it to the
// file. The date is an argument, so that the text of a file depends only on its arguments: only the
// command that the user starts reads the clock.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiment/language/specimen.h"

namespace latsch::experiment {

struct Provenance {
  /// Lines about the whole fit: program, date, study, data, target, errors of each experiment.
  std::vector<std::string> header;
  /// The origin of a number by its path: "fitted -32.1 +- 0.4 (95 %)". Numbers without an entry
  /// come from the model's file or are defaults.
  std::map<std::string, std::string> origins;
  /// The file that the study names as its model, as the study writes the name.
  std::string model_name;
  /// path of the file that the study names as its model
  std::filesystem::path model_file;
  /// Returns the values (SI) of a condition in the tests of the fitted experiments. May be null.
  MeasuredAt measured_at;
};

/// Returns the lines, each after the comment mark, wrapped to at most 96 characters. Control
/// characters become blanks, so that no text of a user can end a comment.
std::string comment_lines(const std::vector<std::string>& lines, const std::string& mark);

/// Returns a text without control characters, which fits into one line of a comment.
std::string on_one_line(std::string text);

}  // namespace latsch::experiment
