// SPDX-License-Identifier: Apache-2.0
// What a Node holds: where it stands in the tree, the keys that were asked for through any Node of
// the same reading, and the record that this reading is kept in, if there is one.
#pragma once

#include <map>
#include <set>
#include <string>

#include "base/document.h"
#include "base/document_record.h"
#include "base/document_tree.h"

namespace latsch {

/// Where a Node stands in a document, for those who need more than its getters say.
struct DocumentPlace {
  std::shared_ptr<const DocumentTree> tree;
  std::shared_ptr<const DocumentChanges> changes;
  int index = 0;
  std::shared_ptr<RecordedKeys> record;
};
DocumentPlace place_in_document(const Node& node);
/// The same table, what is read through it recorded there.
Node recorded_in(const Node& node, std::shared_ptr<RecordedKeys> record);

/// Keys asked for, by the table they belong to: also those the file does not have, for suggestions.
using DocumentAsked = std::map<int, std::set<std::string, std::less<>>>;

struct Node::Impl {
  std::shared_ptr<const DocumentTree> tree;
  std::shared_ptr<const DocumentChanges> changes;
  std::shared_ptr<DocumentAsked> asked;
  int index;
  std::shared_ptr<RecordedKeys> record = nullptr;  // none: nobody wants to know

  // The only ways in from outside: a nested class may open its Node, and names its friends.
  friend DocumentPlace place_in_document(const Node& node) {
    const Impl& impl = of(node);
    return {impl.tree, impl.changes, impl.index, impl.record};
  }
  friend Node recorded_in(const Node& node, std::shared_ptr<RecordedKeys> record) {
    auto impl = std::make_shared<Impl>(of(node));
    impl->record = std::move(record);
    return node_of(std::move(impl));
  }
  static const Impl& of(const Node& node) { return *node.impl_; }
  static Node node_of(std::shared_ptr<const Impl> impl) { return Node(std::move(impl)); }

  const DocumentValue& value() const { return tree->value(index); }
  /// The value of that key, which now counts as asked for; -1 where the file has none.
  int ask(std::string_view key) const;
  /// The same reading at another table of it.
  std::shared_ptr<const Impl> at(int table) const;
  /// Adds to the record what a reader says of a key of this table. A later statement completes or
  /// replaces an earlier one; `has` alone replaces none.
  template <class MakeDeclaredKey>
  void declare(std::string_view key, const MakeDeclaredKey& make) const {
    if (record) record->declare(value().path, key, make());  // else nothing is made
  }
  DocumentValue::Kind kind(int i) const { return tree->value(i).kind; }
  DocumentValue now(int i) const { return tree->value_now(i, *changes); }
  /// InputError for a key that is not there, at the one that was probably meant to be it.
  [[noreturn]] void reject_missing(std::string_view key, const std::string& expected) const;
};

/// As in the file, for messages: `"22 N"`, `2.6`, `a table`.
std::string written(const DocumentValue& value);

}  // namespace latsch
