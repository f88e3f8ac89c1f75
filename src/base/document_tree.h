// SPDX-License-Identifier: Apache-2.0
// The parsed file behind a Document: every value with its path, its place, the characters it was
// written with and the number it stands for. It never changes: numbers that were set since are kept
// beside it and replace just these characters where a text is wanted, so that comments stay, copies
// share the file and nobody reads its text twice.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/units.h"

namespace latsch {

/// "2.6 bar", 0.49, or 310 in {unit = "mm", values = [310]}.
struct DocumentNumber {
  Unit unit;
  double si = 0.0;
};

/// One value of the file. A table {unit = "mm", values = [...]} is a list with that unit.
struct DocumentValue {
  enum class Kind { table, list, text, number, flag, date };

  Kind kind = Kind::table;
  std::string key;        // the last part of the path
  std::string path;       // "section.contour.3.1"
  int line = 0;           // counted from 1
  std::size_t begin = 0;  // bytes of a text, number or flag in the source
  std::size_t end = 0;
  std::string text;      // what a text says; of other scalars the characters in the source
  bool integer = false;  // a number without decimal point
  bool flag = false;
  std::string unit;           // what {unit, values} names; "" where every number has its own
  std::vector<int> children;  // of a table or list, in the order of the file
  std::optional<DocumentNumber> number;  // none where it stands for no finite number
};

/// Numbers in the place of those of the file, SI, by the value they stand at.
using DocumentChanges = std::map<int, double>;

class DocumentTree {
 public:
  /// Throws InputError on a syntax error, a file that is too large or too deep.
  DocumentTree(std::string_view source, std::string file);

  const std::string& file() const { return file_; }
  const DocumentValue& value(int i) const { return values_[i]; }
  static constexpr int kRoot = 0;
  static constexpr std::size_t kLargestFile = 4u << 20;  // bytes
  /// -1 where the table has no such key.
  int child(int table, std::string_view key) const;
  /// -1 where the path leads nowhere.
  int find(std::string_view path) const;
  int size() const { return static_cast<int>(values_.size()); }
  Place place(int i) const { return {file_, values_[i].line}; }

  /// The number at a value that has one.
  double si(int i, const DocumentChanges& changes) const;
  /// A value as it would be written now.
  DocumentValue value_now(int i, const DocumentChanges& changes) const;
  /// The source with other numbers.
  std::string text(const DocumentChanges& changes) const;

 private:
  friend class DocumentBuilder;
  std::string file_;
  std::string source_;
  std::vector<DocumentValue> values_;
  std::map<std::string, int, std::less<>> by_path_;
};

}  // namespace latsch
