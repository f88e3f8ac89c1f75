// SPDX-License-Identifier: Apache-2.0
#include "formats/text/document_si.h"

#include <fmt/format.h>

#include "base/document_tree.h"
#include "base/toml/toml_text.h"
#include "base/units.h"

namespace latsch::formats {

std::string digits_of(double value, bool may_be_whole) {
  std::string digits = fmt::format("{}", value);
  if (!may_be_whole && digits.find_first_not_of("-0123456789") == digits.npos) digits += ".0";
  return digits;
}

namespace {

class SiWriter {
 public:
  explicit SiWriter(const DocumentTree& tree) : tree_(tree) {}

  /// Writes every value below a table on a separate line, under dotted keys.
  void append_lines(int table, const std::string& before, std::string& text) const {
    for (const int child : tree_.value(table).children) {
      const DocumentValue& value = tree_.value(child);
      const std::string key = before + toml_key(value.key);
      if (value.kind == DocumentValue::Kind::table && !value.children.empty())
        append_lines(child, key + ".", text);
      else
        text += key + " = " + value_text(value) + "\n";
    }
  }

 private:
  std::string value_text(const DocumentValue& value) const {
    switch (value.kind) {
      case DocumentValue::Kind::text:
        return toml_text(value.number ? quantity(*value.number) : value.text);
      case DocumentValue::Kind::flag:
        return value.flag ? "true" : "false";
      case DocumentValue::Kind::date:
        return value.text;
      case DocumentValue::Kind::number:
        return number(value);
      case DocumentValue::Kind::list:
        return list(value);
      case DocumentValue::Kind::table:
        break;
    }
    std::string text = "{";
    for (const int child : value.children) {
      if (text.size() > 1) text += ", ";
      text += toml_key(tree_.value(child).key) + " = " + value_text(tree_.value(child));
    }
    return text + "}";
  }

  /// Returns "240000 Pa"; a plain number written as a text keeps the unit "1".
  static std::string quantity(const DocumentNumber& number) {
    return digits_of(number.si) + " " + si_unit(number.unit.dimension());
  }

  /// Returns a number beside which no unit is written: a plain one, or one of a list whose unit
  /// stands before it.
  static std::string number(const DocumentValue& value) {
    if (value.integer && value.unit.empty()) return value.text;
    return value.number ? digits_of(value.number->si, false) : value.text;
  }

  /// The unit of a list is written once, before its outermost brackets.
  std::string list(const DocumentValue& value) const {
    if (value.unit.empty()) return brackets(value);
    return "{unit = " + toml_text(si_unit(Unit::of(value.unit).dimension())) +
           ", values = " + brackets(value) + "}";
  }

  std::string brackets(const DocumentValue& value) const {
    std::string text = "[";
    for (const int child : value.children) {
      if (text.size() > 1) text += ", ";
      const DocumentValue& element = tree_.value(child);
      const bool is_inner = element.kind == DocumentValue::Kind::list && !value.unit.empty();
      text += is_inner ? brackets(element) : value_text(element);
    }
    return text + "]";
  }

  const DocumentTree& tree_;
};

}  // namespace

std::string text_in_si(const Document& document) {
  const DocumentTree tree(document.text(), document.file());
  std::string text;
  SiWriter(tree).append_lines(DocumentTree::kRoot, "", text);
  return text;
}

}  // namespace latsch::formats
