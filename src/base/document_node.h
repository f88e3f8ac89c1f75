// SPDX-License-Identifier: Apache-2.0
// What a Node holds: where it stands in the tree, and the keys that were asked for through any Node
// of the same reading.
#pragma once

#include <map>
#include <set>
#include <string>

#include "base/document.h"
#include "base/document_tree.h"

namespace latsch {

/// Keys asked for, by the table they belong to: also those the file does not have, for suggestions.
using DocumentAsked = std::map<int, std::set<std::string, std::less<>>>;

struct Node::Impl {
  std::shared_ptr<const DocumentTree> tree;
  std::shared_ptr<const DocumentChanges> changes;
  std::shared_ptr<DocumentAsked> asked;
  int index;

  const DocumentValue& value() const { return tree->value(index); }
  /// The value of that key, which now counts as asked for; -1 where the file has none.
  int ask(std::string_view key) const;
  DocumentValue::Kind kind(int i) const { return tree->value(i).kind; }
  DocumentValue now(int i) const { return tree->value_now(i, *changes); }
  /// InputError for a key that is not there, at the one that was probably meant to be it.
  [[noreturn]] void reject_missing(std::string_view key, const std::string& expected) const;
};

/// As in the file, for messages: `"22 N"`, `2.6`, `a table`.
std::string written(const DocumentValue& value);

}  // namespace latsch
