// SPDX-License-Identifier: Apache-2.0
// A Node holds its position in the tree, the keys that were read through any Node of the same
// reading, and, if there is one, the record that this reading is written to.
#pragma once

#include <map>
#include <set>
#include <string>

#include "base/document.h"
#include "base/document_record.h"
#include "base/document_tree.h"

namespace latsch {

/// Position of a Node in a document, for code that needs more than the getters of Node.
struct DocumentPlace {
  std::shared_ptr<const DocumentTree> tree;
  std::shared_ptr<const DocumentChanges> changes;
  int index = 0;
  std::shared_ptr<RecordedKeys> record;
};
DocumentPlace place_in_document(const Node& node);
/// Returns the table of `node` such that everything read through it is also written to `record`.
Node recorded_in(const Node& node, std::shared_ptr<RecordedKeys> record);

/// Keys that were read, by the table they belong to. Keys that the file lacks are included, for
/// suggestions.
using DocumentAsked = std::map<int, std::set<std::string, std::less<>>>;

struct Node::Impl {
  std::shared_ptr<const DocumentTree> tree;
  std::shared_ptr<const DocumentChanges> changes;
  std::shared_ptr<DocumentAsked> asked;
  int index;
  std::shared_ptr<RecordedKeys> record = nullptr;  // nullptr: nothing is recorded

  // Only these two functions give code outside of Node access to its position: Impl is nested in
  // Node and names them as friends.
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
  /// Returns the index of the value of the given key, which now counts as read, or -1 if the file
  /// lacks the key.
  int ask(std::string_view key) const;
  /// Returns a Node of the same reading for another table.
  std::shared_ptr<const Impl> at(int table) const;
  /// Adds a reader's declaration of a key of this table to the record. A later declaration
  /// completes or replaces an earlier one; a bare `has` replaces none.
  template <class MakeDeclaredKey>
  void declare(std::string_view key, const MakeDeclaredKey& make) const {
    // The declaration is made only if it is recorded.
    if (record) record->declare(value().path, key, make());
  }
  DocumentValue::Kind kind(int i) const { return tree->value(i).kind; }
  DocumentValue now(int i) const { return tree->value_now(i, *changes); }
  /// Throws InputError for a missing key, at the place of the key that was probably meant.
  [[noreturn]] void reject_missing(std::string_view key, const std::string& expected) const;
};

/// Returns the value as written in the file, for messages: `"22 N"`, `2.6`, `a table`.
std::string written(const DocumentValue& value);

}  // namespace latsch
