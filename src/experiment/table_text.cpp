// SPDX-License-Identifier: Apache-2.0
#include "experiment/table_text.h"

#include <algorithm>

#include "base/document_node.h"
#include "base/document_tree.h"
#include "base/toml/toml_text.h"

namespace latsch::experiment {
namespace {

class TableText {
 public:
  explicit TableText(const DocumentPlace& place) : place_(place) {}

  std::string value(int index) const {
    using Kind = DocumentValue::Kind;
    const DocumentValue now = place_.tree->value_now(index, *place_.changes);
    switch (now.kind) {
      case Kind::table:
        return "{" + entries(now) + "}";
      case Kind::list:
        // The elements have the unit of the list and no text of their own.
        return now.unit.empty()
                   ? list(now)
                   : "{unit = " + toml_text(now.unit) + ", values = " + list(now) + "}";
      case Kind::text:
        return toml_text(now.text);
      case Kind::flag:
        return now.flag ? "true" : "false";
      case Kind::number:
      case Kind::date:
        break;
    }
    return now.text;
  }
  const DocumentValue& own() const { return place_.tree->value(place_.index); }
  std::string key(int index) const { return place_.tree->value(index).key; }

 private:
  std::string entries(const DocumentValue& table) const {
    std::string text;
    for (const int child : table.children)
      text += (text.empty() ? "" : ", ") + toml_key(key(child)) + " = " + value(child);
    return text;
  }
  std::string list(const DocumentValue& of) const {
    std::string text;
    for (const int child : of.children) text += (text.empty() ? "" : ", ") + value(child);
    return "[" + text + "]";
  }

  DocumentPlace place_;
};

}  // namespace

std::string text_of_table(const Node& table, const std::vector<std::string>& without) {
  const TableText writer(place_in_document(table));
  std::string text;
  for (const int child : writer.own().children) {
    const std::string key = writer.key(child);
    if (std::find(without.begin(), without.end(), key) != without.end()) continue;
    text += toml_key(key) + " = " + writer.value(child) + "\n";
  }
  return text;
}

}  // namespace latsch::experiment
