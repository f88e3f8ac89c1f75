// SPDX-License-Identifier: Apache-2.0
#include "base/document_parts.h"

#include <algorithm>
#include <cassert>

#include "base/document_node.h"
#include "base/text.h"
#include "base/toml/toml_text.h"

namespace latsch {
namespace {

/// Returns the value as TOML text that may follow "key =".
std::string inline_text(const DocumentTree& tree, int index, bool inside_unit = false) {
  const DocumentValue& value = tree.value(index);
  switch (value.kind) {
    case DocumentValue::Kind::text:
      return toml_text(value.text);
    case DocumentValue::Kind::flag:
      return value.flag ? "true" : "false";
    case DocumentValue::Kind::number:
    case DocumentValue::Kind::date:
      return value.text;
    case DocumentValue::Kind::list: {
      const bool has_unit = !inside_unit && !value.unit.empty();
      std::string text = has_unit ? "{unit = " + toml_text(value.unit) + ", values = [" : "[";
      for (const int child : value.children) {
        if (text.back() != '[') text += ", ";
        text += inline_text(tree, child, inside_unit || has_unit);
      }
      return text + (has_unit ? "]}" : "]");
    }
    case DocumentValue::Kind::table:
      break;
  }
  std::string text = "{";
  for (const int child : value.children) {
    if (text.size() > 1) text += ", ";
    text += toml_key(tree.value(child).key) + " = " + inline_text(tree, child, inside_unit);
  }
  return text + "}";
}

/// Writes every value below a table on a separate line, under dotted keys.
void append_lines(const DocumentTree& tree,
                  int table,
                  const std::string& before,
                  std::string& text) {
  for (const int child : tree.value(table).children) {
    const DocumentValue& value = tree.value(child);
    const std::string key = before + toml_key(value.key);
    if (value.kind == DocumentValue::Kind::table && !value.children.empty())
      append_lines(tree, child, key + ".", text);
    else
      text += key + " = " + inline_text(tree, child) + "\n";
  }
}

std::string lines_below(const DocumentTree& tree, int table) {
  std::string text;
  append_lines(tree, table, "", text);
  return text;
}

}  // namespace

Document with_part(const Document& whole, std::string_view key, const Document& part) {
  const DocumentTree tree(whole.text(), whole.file());
  const int index = tree.child(DocumentTree::kRoot, key);
  if (index < 0 || tree.value(index).kind != DocumentValue::Kind::text)
    throw InputError({whole.file(), 0},
                     std::string(key) + " is missing, expected the name of a file");
  // In the combined text, the line that names the part becomes empty, so that all other lines keep
  // their numbers.
  std::string text = whole.text();
  const std::size_t line = text.rfind('\n', tree.value(index).begin) + 1;
  std::size_t end = text.find('\n', tree.value(index).end);
  if (end == text.npos) end = text.size();
  text.erase(line, end - line);
  const DocumentTree of_part(part.text(), part.file());
  text += "\n[" + std::string(key) + "]\n" + lines_below(of_part, DocumentTree::kRoot);
  return Document::parse(text, whole.file());
}

Document with_lines(const Document& whole,
                    std::string_view path,
                    const std::vector<std::string>& lines) {
  const DocumentTree tree(whole.text(), whole.file());
  const int index = tree.find(path);
  assert(index >= 0 && tree.value(index).kind == DocumentValue::Kind::text);
  const DocumentValue& value = tree.value(index);
  std::string text = whole.text();
  const std::size_t line = text.rfind('\n', value.begin) + 1;
  std::size_t end = text.find('\n', value.end);
  if (end == text.npos) end = text.size();
  // The text before "=" is the key, preceded by the dotted names of tables inside the current one,
  // such as "ubj." in "ubj.file = ".
  const std::string_view before =
      trimmed(std::string_view(text).substr(line, text.find('=', line) - line));
  const std::string_view behind =
      trimmed(std::string_view(text).substr(value.end, end - value.end));
  const std::string table(
      before.substr(0, before.size() - std::min(before.size(), value.key.size())));
  if (before.substr(table.size()) != value.key || !(table.empty() || table.back() == '.') ||
      !(behind.empty() || behind.front() == '#'))
    throw InputError(tree.place(index), std::string(path) + " expected on a line of its own");
  std::string own;
  for (const std::string& one : lines)
    own.append(own.empty() ? "" : "\n").append(table).append(one);
  text.replace(line, end - line, own);
  return Document::parse(text, whole.file());
}

bool has_part(const Document& whole, std::string_view key) {
  const DocumentTree tree(whole.text(), whole.file());
  const int index = tree.child(DocumentTree::kRoot, key);
  return index >= 0 && tree.value(index).kind == DocumentValue::Kind::table;
}

Document part_of(const Document& whole, std::string_view key) {
  const DocumentTree tree(whole.text(), whole.file());
  const int index = tree.child(DocumentTree::kRoot, key);
  if (index < 0 || tree.value(index).kind != DocumentValue::Kind::table)
    throw InputError({whole.file(), 0}, std::string(key) + " is missing, expected a table");
  return Document::parse(lines_below(tree, index), whole.file());
}

}  // namespace latsch
