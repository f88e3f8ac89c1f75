// SPDX-License-Identifier: Apache-2.0
#include "studio/shelf/study_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cmath>
#include <optional>

#include "base/document_tree.h"
#include "base/error.h"
#include "base/file.h"
#include "base/units.h"
#include "correlation/analysis/plausibility.h"
#include "correlation/search/study_method.h"
#include "correlation/study/study.h"
#include "evaluation/trial/encoding.h"

namespace latsch::studio {

namespace fs = std::filesystem;
using Kind = DocumentValue::Kind;

namespace {

std::string version_of(const std::string& text) { return fmt::format("{:016x}", hash(text)); }

/// Returns the text as a basic string of TOML [TOML 1.0, String].
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string toml_of(const EditedValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return quoted(*text);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  const double number = std::get<double>(value);
  if (!std::isfinite(number)) throw InputError("the number is not finite");
  return fmt::format("{}", number);
}

/// Throws unless the name consists of letters, digits, _ and -, so that it needs no quotes in the
/// head of a table.
void expect_bare(const std::string& name) {
  const auto is_bare = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
  if (name.empty() || !std::all_of(name.begin(), name.end(), is_bare))
    throw InputError("\"" + name + "\" is not a name: expected letters, digits, _ and - only");
}

/// Returns the beginning of the line that contains the position, and that of the next line.
std::pair<std::size_t, std::size_t> line_around(const std::string& text, std::size_t at) {
  const std::size_t before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  const std::size_t end = text.find('\n', at);
  return {begin, end == std::string::npos ? text.size() : end + 1};
}

/// Returns the position of the end of the line with this number; the first line has number 1.
std::size_t end_of_line(const std::string& text, int line) {
  std::size_t at = 0;
  for (int k = 0; k < line; ++k) {
    const std::size_t next = text.find('\n', at);
    if (next == std::string::npos) return text.size();
    at = next + 1;
  }
  return at;
}

std::string without(const std::string& text, const DocumentValue& value) {
  const auto [begin, end] = line_around(text, value.begin);
  const std::size_t key = text.find_first_not_of(" \t", begin);
  if (text.compare(key, value.key.size(), value.key) != 0)
    throw InputError(value.path + " shares its line with others: edit the text");
  return text.substr(0, begin) + text.substr(end);
}

std::string with_key(const std::string& text,
                     const DocumentTree& tree,
                     int table,
                     const std::string& line) {
  if (table == DocumentTree::kRoot) return line + text;
  const DocumentValue& head = tree.value(table);
  const auto [begin, end] = line_around(text, end_of_line(text, head.line - 1));
  const std::size_t first = text.find_first_not_of(" \t", begin);
  if (first == std::string::npos || text[first] != '[')
    throw InputError(head.path + " is written in one line: edit the text");
  const bool ends_in_line = end > 0 && text[end - 1] == '\n';
  return text.substr(0, end) + (ends_in_line ? "" : "\n") + line + text.substr(end);
}

}  // namespace

StudyText read_study_text(const fs::path& file) {
  std::string text = read_text_file(file);
  std::string version = version_of(text);
  return {std::move(text), std::move(version)};
}

std::string edited(const std::string& text, const std::string& file_name, const Edit& edit) {
  for (const std::string& name : edit.table) expect_bare(name);
  expect_bare(edit.key);
  const DocumentTree tree(text, file_name);
  int table = DocumentTree::kRoot;
  for (const std::string& name : edit.table) {
    if (table >= 0) table = tree.child(table, name);
  }
  const std::string whole = fmt::format("{}", fmt::join(edit.table, "."));
  if (table >= 0 && tree.value(table).kind != Kind::table)
    throw InputError(whole + " is not a table in " + file_name + ": edit the text");
  const int place = table < 0 ? -1 : tree.child(table, edit.key);
  const bool goes = std::holds_alternative<std::monostate>(edit.value);
  if (place >= 0) {
    const DocumentValue& value = tree.value(place);
    if (value.kind == Kind::table || value.kind == Kind::list)
      throw InputError(value.path + " is a list or a table: edit the text");
    if (goes) return without(text, value);
    return text.substr(0, value.begin) + toml_of(edit.value) + text.substr(value.end);
  }
  if (goes) return text;
  const std::string line = edit.key + " = " + toml_of(edit.value) + "\n";
  if (table >= 0 && (table == DocumentTree::kRoot || tree.value(table).line > 0))
    return with_key(text, tree, table, line);
  return text + (text.ends_with('\n') || text.empty() ? "" : "\n") + "\n[" + whole + "]\n" + line;
}

std::string write_study_text(const fs::path& file,
                             const std::string& version,
                             const std::string& text) {
  (void)DocumentTree(text, file.string());  // throws before writing if the text is no TOML
  if (read_study_text(file).version != version)
    throw ChangedMeanwhile(
        file.string() + " was changed by somebody else meanwhile: load it again before you write");
  allow_to_replace(file);  // the page edits this file
  write_text_file(file, text);
  return version_of(text);
}

namespace {

/// A temporary file beside the study. It is removed after the study has been read from it.
class Beside {
 public:
  Beside(const fs::path& file, const std::string& text) {
    static std::atomic<int> number = 0;
    path_ = file.parent_path() /
            fmt::format(".{}.{}.{}.toml", file.stem().string(), ::getpid(), ++number);
    write_text_file(path_, text);
  }
  ~Beside() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

std::vector<std::string> understood(const correlation::Study& study) {
  std::vector<std::string> lines{study.title, study.specimens->describe(study)};
  for (const DesignVariable& v : study.space.variables())
    lines.push_back(fmt::format("variable {}: {} .. {}, begins at {}",
                                v.name,
                                format_quantity(v.lower, v.unit),
                                format_quantity(v.upper, v.unit),
                                format_quantity(v.initial, v.unit)));
  for (const auto& experiment : study.experiments)
    lines.push_back(fmt::format("experiment {}: {} values from {}, {}, weight {:g}",
                                experiment.name,
                                experiment.values(),
                                experiment.measured_in(),
                                experiment.fitted ? "fitted" : "predicted",
                                experiment.objective.weight));
  const auto method = method_of(study);
  lines.push_back(fmt::format("optimizer {}: {}", in_words(method.method), method.reason));
  return lines;
}

}  // namespace

Checked check_study_text(const fs::path& file,
                         const std::string& text,
                         const experiment::Language& language) {
  Checked checked;
  // Files that a study names are relative to its folder. Therefore the text is read from a
  // temporary file there, unless the study's file holds the same text.
  std::optional<Beside> beside;
  try {
    std::error_code none;
    if (!fs::exists(file, none) || read_study_text(file).text != text) beside.emplace(file, text);
  } catch (const InputError& error) {
    checked.messages.push_back(
        {fmt::format("{} cannot be written to, so this text can be neither checked nor saved: make "
                     "the folder writable, or copy the study to one that is ({})",
                     file.parent_path().string(),
                     error.what()),
         0,
         true});
    return checked;
  }
  const fs::path read = beside ? beside->path() : file;
  const auto message = [&](const std::string& what, const Place& place, bool is_wrong) {
    const bool is_here = place.file == read.string();
    checked.messages.push_back(
        {replaced(what, read.string(), file.string()), is_here ? place.line : 0, is_wrong});
  };
  try {
    const auto study = correlation::read_study(read, language);
    checked.ok = true;
    for (const correlation::Finding& finding : correlation::implausible(study)) {
      message(experiment::in_words(finding), finding.place, finding.impossible);
      checked.ok = checked.ok && !finding.impossible;
    }
    study.specimens->check(study);
    checked.understood = understood(study);
  } catch (const InputError& error) {
    checked.ok = false;
    message(error.what(), error.place(), true);
  }
  return checked;
}

}  // namespace latsch::studio
