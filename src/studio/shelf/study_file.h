// SPDX-License-Identifier: Apache-2.0
// Changes a study's file for the page: replaces one value and keeps everything else, including
// comments; or replaces the whole text. Changes that somebody else has made meanwhile are not
// overwritten.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "experiment/language.h"

namespace latsch::studio {

struct StudyText {
  std::string text;
  std::string version;  // text that differs for every content of the file
};
StudyText read_study_text(const std::filesystem::path& file);

/// A text, a number or a flag as new value of a key; monostate removes the key.
using EditedValue = std::variant<std::monostate, std::string, double, bool>;

struct Edit {
  /// Names of the table and the tables that contain it, such as {"variable", "sidewall"}; empty:
  /// the top level of the file.
  std::vector<std::string> table;
  std::string key;
  EditedValue value;
};

/// Returns the text with one edit: an existing value is replaced, a missing key is added below the
/// head of its table, a missing table is added at the end. Throws InputError for invalid names and
/// if the value to replace is a list or a table, which must be edited as text.
std::string edited(const std::string& text, const std::string& file_name, const Edit& edit);

/// Thrown if the file has changed since the page read it.
class ChangedMeanwhile : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes the text if the file still has that version, and returns the new version. Throws
/// ChangedMeanwhile if it does not, and InputError for a text that is no TOML or a file that cannot
/// be written.
std::string write_study_text(const std::filesystem::path& file,
                             const std::string& version,
                             const std::string& text);

struct Message {
  std::string text;
  /// line in the study's file; 0: the message concerns another file, or the whole file
  int line = 0;
  bool is_wrong = true;  // false: a warning
};
struct Checked {
  bool ok = false;
  std::vector<Message> messages;
  std::vector<std::string> understood;  // lines that say how the files were interpreted
};
/// Returns the result of `latsch check` for the text, as if the file contained it. The file is not
/// changed.
Checked check_study_text(const std::filesystem::path& file,
                         const std::string& text,
                         const experiment::Language& language);

}  // namespace latsch::studio
