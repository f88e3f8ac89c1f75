// SPDX-License-Identifier: Apache-2.0
#include "base/document_record.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>

#include "base/document_node.h"
#include "base/document_tree.h"
#include "base/mapped_file.h"
#include "base/toml/toml_text.h"

namespace latsch {
namespace {

using Kind = DocumentValue::Kind;

/// Longest value that a record writes in full. Longer values are replaced by their fingerprints
/// because a journal keeps the text of every identity; a larger limit makes journals longer.
constexpr std::size_t kLongest = 2000;  // characters

/// Returns a value of the file in canonical form: numbers in SI, independent of how they are
/// written.
std::string canonical(const DocumentTree& tree, const DocumentChanges& changes, int index) {
  const DocumentValue& value = tree.value(index);
  if (value.number)
    return latsch::canonical(tree.si(index, changes), si_unit(value.number->unit.dimension()));
  switch (value.kind) {
    case Kind::text:
      return toml_text(value.text);
    case Kind::flag:
      return value.flag ? "true" : "false";
    case Kind::number:
    case Kind::date:
      return value.text;
    case Kind::table:
    case Kind::list:
      break;
  }
  const bool is_list = value.kind == Kind::list;
  std::string text;
  for (const int child : value.children) {
    if (!text.empty()) text += ", ";
    if (!is_list) text += toml_key(tree.value(child).key) + " = ";
    text += canonical(tree, changes, child);
  }
  return (is_list ? "[" : "{") + text + (is_list ? "]" : "}");
}

void append_lines(const DocumentTree& tree,
                  const DocumentChanges& changes,
                  int index,
                  const std::string& path,
                  std::string& text) {
  const DocumentValue& value = tree.value(index);
  if (value.kind != Kind::table || value.children.empty()) {
    if (!path.empty()) text += path + " = " + canonical(tree, changes, index) + "\n";
    return;
  }
  for (const int child : value.children)
    append_lines(tree,
                 changes,
                 child,
                 (path.empty() ? "" : path + ".") + toml_key(tree.value(child).key),
                 text);
}

/// True for the kinds of values that are more than a text.
bool is_special(DeclaredKey::Kind kind) {
  return kind >= DeclaredKey::Kind::quantity && kind != DeclaredKey::Kind::text;
}

bool is_below(const std::string& path, const std::string& table) {
  return path.size() > table.size() && path.starts_with(table) && path[table.size()] == '.';
}

/// Returns the contents of the files, preceded by the extension of the first file, because the
/// extension decides in which format the files are read.
std::string contents_of(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> told;
  for (const std::filesystem::path& file : files)
    told.push_back((told.empty() ? file.extension().string() + " of " : "") +
                   fingerprint_of_file(file));
  return fmt::format("\"{}\"", fmt::join(told, "; "));
}

}  // namespace

std::string canonical(double value, std::string_view unit) {
  return unit == "1" || unit.empty() ? fmt::format("{}", value)
                                     : fmt::format("\"{} {}\"", value, unit);
}

std::string canonical(const std::vector<double>& values, std::string_view unit) {
  const std::string list = fmt::format("[{}]", fmt::join(values, ", "));
  return unit == "1" ? list : fmt::format("{{unit = \"{}\", values = {}}}", unit, list);
}

std::string canonical(const std::vector<std::vector<double>>& rows,
                      const std::vector<std::string>& units) {
  std::string text;
  for (const std::vector<double>& row : rows) {
    text += text.empty() ? "[" : ", [";
    for (std::size_t i = 0; i < row.size(); ++i)
      text += (i > 0 ? ", " : "") + canonical(row[i], units[i]);
    text += "]";
  }
  return "[" + text + "]";
}

std::string canonical(const std::vector<std::string>& texts) {
  std::vector<std::string> quoted;
  for (const std::string& text : texts) quoted.push_back(toml_text(text));
  return fmt::format("[{}]", fmt::join(quoted, ", "));
}

std::string canonical_text(const Document& document) {
  const DocumentPlace root = place_in_document(document.root());
  std::string text;
  append_lines(*root.tree, *root.changes, root.index, "", text);
  return text;
}

std::string fingerprint(std::string_view text) {
  std::uint64_t state = 0xcbf29ce484222325u;
  for (const char byte : text) state = (state ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  return fmt::format("{} bytes, {:016x}", text.size(), state);
}

std::string fingerprint_of_file(const std::filesystem::path& file) {
  // Bytes; more than any reader of files accepts.
  constexpr std::size_t kLargest = std::size_t{4} << 30;
  if (file.extension() == ".toml") {
    try {
      return fingerprint(canonical_text(Document::read(file)));
    } catch (const InputError&) {  // the file is named like a document, but is none
    }
  }
  return fingerprint(MappedFile(file, kLargest).text());
}

std::string RecordedKeys::path_of(std::string_view table, std::string_view key) const {
  std::string path(table.substr(std::min(table.size(), base.size())));
  if (path.starts_with('.')) path.erase(0, 1);
  if (!path.empty() && !key.empty()) path += '.';
  return path.append(key);
}

void RecordedKeys::ask(std::string_view table, std::string_view key, bool is_there) {
  keys[path_of(table, key)].is_there = is_there;
  if (outer) outer->ask(table, key, is_there);
}

void RecordedKeys::declare(std::string_view table, std::string_view key, DeclaredKey what) {
  if (outer) outer->declare(table, key, what);
  DeclaredKey& known = keys[path_of(table, key)];
  const bool is_value = what.kind > DeclaredKey::Kind::table;
  // A key that was read as a quantity, a choice or another special kind keeps this kind if it is
  // also read as a text, for example to find its unit.
  const bool stays = what.kind == DeclaredKey::Kind::text && is_special(known.kind);
  if (what.kind == DeclaredKey::Kind::presence) known.may_be_missing = true;
  if (!stays && (is_value || known.kind < what.kind)) known.kind = what.kind;
  if (!what.value.empty()) {
    known.value = std::move(what.value);
  } else if (stays) {
    if (what.fallback) known.fallback = std::move(what.fallback);
  } else if (is_value) {
    known.units = std::move(what.units);
    known.range = what.range;
    known.choices = std::move(what.choices);
    if (what.fallback) known.fallback = std::move(what.fallback);
  }
}

DocumentRecord::DocumentRecord(const Node& table)
    : recorded_(std::make_shared<RecordedKeys>()), node_(recorded_in(table, recorded_)) {
  recorded_->base = table.path();
  recorded_->outer = place_in_document(table).record;
}

void DocumentRecord::put(const std::string& path, std::string value) {
  recorded_->in_place[path] = std::move(value);
}

std::string DocumentRecord::written(const std::string& path) const {
  const DocumentPlace place = place_in_document(node_);
  const std::string& base = recorded_->base;
  const int index = place.tree->find(base.empty() ? path : base + "." + path);
  return index < 0 ? "" : canonical(*place.tree, *place.changes, index);
}

std::string DocumentRecord::text() const {
  std::map<std::string, std::string> values = recorded_->in_place;
  for (const auto& [path, key] : recorded_->keys) {
    const bool is_replaced = std::any_of(
        recorded_->in_place.begin(), recorded_->in_place.end(), [&, at = path](const auto& one) {
          return at == one.first || is_below(at, one.first);
        });
    if (is_replaced) continue;
    std::string value = key.value;
    if (!key.files.empty()) {
      value = contents_of(key.files);
    } else if (!key.is_there) {
      value = key.fallback.value_or("");
    } else if (value.empty() && key.kind != DeclaredKey::Kind::table) {
      value = written(path);  // the key was tested for, but no getter read its value
    }
    if (!value.empty()) values[path] = std::move(value);
  }
  std::string text;
  for (const auto& [path, value] : values)
    text += fmt::format("{} = {}\n", path, value.size() > kLongest ? fingerprint(value) : value);
  return text;
}

std::vector<std::filesystem::path> DocumentRecord::files() const {
  std::vector<std::filesystem::path> files;
  for (const auto& [path, key] : recorded_->keys)
    files.insert(files.end(), key.files.begin(), key.files.end());
  return files;
}

void DocumentRecord::stands_for(const Node& table, const std::string& value) {
  for (auto record = place_in_document(table).record; record; record = record->outer)
    record->in_place[record->path_of(table.path(), "")] = value;
}

void DocumentRecord::names_files(const Node& table,
                                 std::string_view key,
                                 const std::vector<std::filesystem::path>& files) {
  for (auto record = place_in_document(table).record; record; record = record->outer)
    record->keys[record->path_of(table.path(), key)].files = files;
}

void DocumentRecord::expects(const Node& table, std::string_view key, const std::string& words) {
  for (auto record = place_in_document(table).record; record; record = record->outer) {
    auto& expected = record->keys[record->path_of(table.path(), key)].expected;
    if (std::find(expected.begin(), expected.end(), words) == expected.end())
      expected.push_back(words);
  }
}

void DocumentRecord::may_be_measured(const Node& table, std::string_view key) {
  for (auto record = place_in_document(table).record; record; record = record->outer)
    record->keys[record->path_of(table.path(), key)].is_measurable = true;
}

}  // namespace latsch
