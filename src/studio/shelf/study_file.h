// SPDX-License-Identifier: Apache-2.0
// Changes the file of a study for the page: one value in place, with everything else unchanged,
// comments included; or the whole text. Changes that somebody else made meanwhile are not
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
  std::string version;  // changes with the text
};
StudyText read_study_text(const std::filesystem::path& file);

/// Text, number or flag; monostate removes the key.
using EditedValue = std::variant<std::monostate, std::string, double, bool>;

struct Edit {
  /// path of table names, {"variable", "sidewall"}; empty: the top of the file
  std::vector<std::string> table;
  std::string key;
  EditedValue value;
};

/// Returns the text with one edit: an existing value is replaced, a missing key is added below its
/// table's head, a missing table is added at the end. Throws InputError if the place holds a list
/// or a table, which must be edited as text, and for invalid names.
std::string edited(const std::string& text, const std::string& file_name, const Edit& edit);

/// Thrown if the file differs from the one that the page has seen.
class ChangedMeanwhile : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes the text if the file still has that version. Returns the new version. Throws
/// ChangedMeanwhile, and InputError for a text that is no TOML or a file that cannot be written.
std::string write_study_text(const std::filesystem::path& file,
                             const std::string& version,
                             const std::string& text);

struct Message {
  std::string text;
  int line = 0;          // line in the study's file; 0: another file, or the whole file
  bool is_wrong = true;  // false: a warning
};
struct Checked {
  bool ok = false;
  std::vector<Message> messages;
  std::vector<std::string> understood;  // lines for people
};
/// Returns the result of `latsch check` for that text in place of the file. The file is not
/// changed.
Checked check_study_text(const std::filesystem::path& file,
                         const std::string& text,
                         const experiment::Language& language);

}  // namespace latsch::studio
