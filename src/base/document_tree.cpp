// SPDX-License-Identifier: Apache-2.0
#include "base/document_tree.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>

#include "base/document_number.h"
#include "base/text.h"

namespace latsch {
namespace {

constexpr int kDeepest = 16;
constexpr int kMostValues = 50000;

/// Rejects deep nesting and too many values in a TOML text before the parser reads it: the parser
/// allows very deep nesting, does not limit dotted keys, and needs a hundred times the memory of
/// the text for a value. Counts brackets, dots and separators outside of texts and comments; the
/// exact depth is checked later.
void check_size_of_source(std::string_view source, const std::string& file) {
  int line = 1, brackets = 0, dots = 0, values = 0;
  for (std::size_t i = 0; i < source.size(); ++i) {
    const char c = source[i];
    if (c == '"' || c == '\'') {
      const bool multiline = source.substr(i, 3) == std::string(3, c);
      const std::string_view closing = source.substr(i, multiline ? 3 : 1);
      for (i += closing.size(); i < source.size() && source.substr(i, closing.size()) != closing;
           ++i) {
        if (source[i] == '\n') ++line;
        // A text without end, which the parser will report.
        if (source[i] == '\n' && !multiline) break;
        if (source[i] == '\\' && c == '"') ++i;
      }
      if (multiline) i += 2;
    } else if (c == '#') {
      while (i + 1 < source.size() && source[i + 1] != '\n') ++i;
    } else if (c == '[' || c == '{') {
      ++brackets;
      ++values;
    } else if (c == ']' || c == '}') {
      brackets = std::max(0, brackets - 1);
    } else if (c == '.') {
      ++dots;
    } else if (c == '\n' || c == '=' || c == ',') {
      dots = 0;
      if (c == '\n')
        ++line;
      else
        ++values;
    }
    if (brackets > kDeepest + 2 || dots > kDeepest + 2)
      throw InputError({file, line}, fmt::format("nested deeper than {} levels", kDeepest));
    if (values > kMostValues)
      throw InputError({file, line}, fmt::format("holds more than {} values", kMostValues));
  }
}

/// Converts positions given as line and column in characters into byte offsets. Values are looked
/// up from left to right, so each search continues where the last one ended: a line may hold
/// thousands of values.
class SourceMap {
 public:
  explicit SourceMap(std::string_view source) : source_(source), starts_{0} {
    for (std::size_t i = 0; i < source.size(); ++i)
      if (source[i] == '\n') starts_.push_back(i + 1);
  }

  std::size_t offset(const toml::source_position& position) {
    const std::size_t line = std::clamp<std::size_t>(position.line, 1, starts_.size());
    if (line != line_ || position.column < column_) {
      line_ = line;
      column_ = 1;
      at_ = starts_[line - 1];
    }
    for (; column_ < position.column && at_ < source_.size(); ++column_) {
      ++at_;
      while (at_ < source_.size() && (static_cast<unsigned char>(source_[at_]) & 0xc0) == 0x80)
        ++at_;
    }
    return at_;
  }

 private:
  std::string_view source_;
  std::vector<std::size_t> starts_;
  std::size_t line_ = 0, column_ = 1, at_ = 0;  // position at which the last search ended
};

}  // namespace

/// Copies the parser's tree into values, sorted as in the file.
class DocumentBuilder {
 public:
  explicit DocumentBuilder(DocumentTree& tree) : tree_(tree), map_(tree.source_) {}

  int add(const toml::node& node, const std::string& key, const std::string& path, int depth) {
    const int line = static_cast<int>(node.source().begin.line);
    if (depth > kDeepest)
      throw InputError({tree_.file_, line}, fmt::format("nested deeper than {} levels", kDeepest));
    const int index = tree_.size();
    tree_.values_.emplace_back();
    DocumentValue& value = tree_.values_.back();
    value.key = key;
    value.path = path;
    value.line = line;
    tree_.by_path_.emplace(path, index);
    if (const toml::table* table = node.as_table())
      add_table(*table, index, depth);
    else if (const toml::array* array = node.as_array())
      add_list(*array, index, depth);
    else
      add_scalar(node, value);
    return index;
  }

 private:
  static std::string joined(const std::string& path, const std::string& key) {
    return path.empty() ? key : path + "." + key;
  }

  /// True for a table {unit = "mm", values = [...]}.
  static bool is_list_with_unit(const toml::table& table) {
    return table.size() == 2 && table.get("unit") && table.get("unit")->is_string() &&
           table.get("values") && table.get("values")->is_array();
  }

  void add_table(const toml::table& table, int index, int depth) {
    if (is_list_with_unit(table)) {
      tree_.values_[index].unit = **table.get("unit")->as_string();
      return add_list(*table.get("values")->as_array(), index, depth);
    }
    struct Entry {
      toml::source_position position;
      std::string key;
      const toml::node* node;
    };
    std::vector<Entry> entries;
    for (const auto& [key, node] : table)
      entries.push_back({key.source().begin, std::string(key.str()), &node});
    std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return std::pair(a.position.line, a.position.column) <
             std::pair(b.position.line, b.position.column);
    });
    const std::string path = tree_.values_[index].path;
    for (const Entry& entry : entries) {
      if (entry.key.empty() || entry.key.find('.') != entry.key.npos)
        throw InputError({tree_.file_, static_cast<int>(entry.position.line)},
                         "key " + in_quotes(entry.key) + " is empty or contains a dot");
      const int child = add(*entry.node, entry.key, joined(path, entry.key), depth + 1);
      tree_.values_[index].children.push_back(child);
    }
  }

  void add_list(const toml::array& array, int index, int depth) {
    tree_.values_[index].kind = DocumentValue::Kind::list;
    const std::string path = tree_.values_[index].path, unit = tree_.values_[index].unit;
    for (std::size_t i = 0; i < array.size(); ++i) {
      const std::string key = std::to_string(i);
      const int child = add(array[i], key, joined(path, key), depth + 1);
      tree_.values_[index].children.push_back(child);
      if (!unit.empty()) inherit_unit(child, unit);
    }
  }

  void inherit_unit(int index, const std::string& unit) {
    DocumentValue& value = tree_.values_[index];
    value.unit = unit;
    for (const int child : value.children) inherit_unit(child, unit);
  }

  void add_scalar(const toml::node& node, DocumentValue& value) {
    using Kind = DocumentValue::Kind;
    value.begin = map_.offset(node.source().begin);
    value.end = map_.offset(node.source().end);
    value.text = tree_.source_.substr(value.begin, value.end - value.begin);
    if (const auto* text = node.as_string()) {
      value.kind = Kind::text;
      value.text = **text;
    } else if (const auto* integer = node.as_integer()) {
      value.kind = Kind::number;
      value.integer = true;
      // Written in decimal, even if the file has it in hexadecimal.
      value.text = std::to_string(**integer);
    } else if (node.is_floating_point()) {
      value.kind = Kind::number;
      std::erase(value.text, '_');
    } else if (const auto* flag = node.as_boolean()) {
      value.kind = Kind::flag;
      value.flag = **flag;
    } else {
      value.kind = Kind::date;
    }
  }

  DocumentTree& tree_;
  SourceMap map_;
};

DocumentTree::DocumentTree(std::string_view source, std::string file) : file_(std::move(file)) {
  if (source.size() > kLargestFile)
    throw InputError({file_, 0},
                     fmt::format("is {} bytes, expected at most {}", source.size(), kLargestFile));
  // Removes the byte order mark of UTF-8.
  if (source.starts_with("\xef\xbb\xbf")) source.remove_prefix(3);
  source_ = source;
  check_size_of_source(source_, file_);
  try {
    const toml::table table = toml::parse(std::string_view(source_), std::string_view(file_));
    DocumentBuilder(*this).add(table, "", "", 0);
    for (DocumentValue& value : values_) value.number = number_of(value);
  } catch (const toml::parse_error& error) {
    std::string what = "not valid TOML: " + std::string(error.description());
    if (what.find("utf-8") != what.npos) what += "; save the file as UTF-8";
    const std::string ending = std::filesystem::path(file_).extension().string();
    if (!ending.empty() && ending != ".toml")
      what += "; it ends in " + in_quotes(ending) + ", expected a .toml";
    throw InputError({file_, static_cast<int>(error.source().begin.line)}, what);
  }
}

int DocumentTree::child(int table, std::string_view key) const {
  for (const int child : values_[table].children)
    if (values_[child].key == key) return child;
  return -1;
}

int DocumentTree::find(std::string_view path) const {
  const auto found = by_path_.find(path);
  return found == by_path_.end() ? -1 : found->second;
}

double DocumentTree::si(int i, const DocumentChanges& changes) const {
  const auto changed = changes.find(i);
  return changed == changes.end() ? values_[i].number->si : changed->second;
}

DocumentValue DocumentTree::value_now(int i, const DocumentChanges& changes) const {
  const auto changed = changes.find(i);
  return changed == changes.end() ? values_[i] : with_number(values_[i], changed->second);
}

std::string DocumentTree::text(const DocumentChanges& changes) const {
  std::vector<DocumentValue> changed;
  for (const auto& [index, si] : changes) changed.push_back(with_number(values_[index], si));
  std::sort(changed.begin(), changed.end(), [](const auto& a, const auto& b) {
    return a.begin < b.begin;
  });
  std::string text;
  std::size_t copied = 0;
  for (const DocumentValue& value : changed) {
    text.append(source_, copied, value.begin - copied);
    if (value.kind == DocumentValue::Kind::text) {
      text += '"';
      for (const char c : value.text) {
        if (c == '"' || c == '\\') text += '\\';
        text += c;
      }
      text += '"';
    } else {
      text += value.text;
    }
    copied = value.end;
  }
  return text.append(source_, copied);
}

}  // namespace latsch
