// SPDX-License-Identifier: Apache-2.0
// The file of a study as the page changes it: one value in its place, all else as it was, comments
// included; or the whole text. What was changed by somebody else meanwhile is not written over.
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

/// Text, number or flag; monostate: the key goes.
using EditedValue = std::variant<std::monostate, std::string, double, bool>;

struct Edit {
  std::vector<std::string> table;  // {"variable", "sidewall"}; empty: the top of the file
  std::string key;
  EditedValue value;
};

/// The text with one edit: a value that stands there is replaced, a key that does not is added
/// below its table's head, a table that does not is added at the end. Throws InputError where the
/// place holds a list or a table, which have to be edited as text, and for names that are none.
std::string edited(const std::string& text, const std::string& file_name, const Edit& edit);

/// Thrown where the file is another one than the page has seen.
class ChangedMeanwhile : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes the text where the file still has that version; gives the new one. Throws
/// ChangedMeanwhile, and InputError for a text that is no TOML or a file that cannot be written.
std::string write_study_text(const std::filesystem::path& file,
                             const std::string& version,
                             const std::string& text);

struct Message {
  std::string text;
  int line = 0;          // of the study's file; 0: of another file, or of all of it
  bool is_wrong = true;  // otherwise a warning
};
struct Checked {
  bool ok = false;
  std::vector<Message> messages;
  std::vector<std::string> understood;  // lines for people
};
/// What `latsch check` would say of that text in the place of the file. Nothing is kept of it.
Checked check_study_text(const std::filesystem::path& file,
                         const std::string& text,
                         const experiment::Language& language);

}  // namespace latsch::studio
