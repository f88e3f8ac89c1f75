// SPDX-License-Identifier: Apache-2.0
// The parsed file behind a Document: every value with its path, its file and line, its characters
// in the file and the number it stands for. The tree never changes. Numbers set later are stored
// beside it and replace only their own characters when a text is written. So comments stay, copies
// of a document share the file, and its text is parsed only once.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/units.h"

namespace latsch {

/// A number with its unit: "2.6 bar", 0.49, or 310 in {unit = "mm", values = [310]}.
struct DocumentNumber {
  Unit unit;
  double si = 0.0;
};

/// One value of the file. A table {unit = "mm", values = [...]} is a list with this unit.
struct DocumentValue {
  enum class Kind { table, list, text, number, flag, date };

  Kind kind = Kind::table;
  std::string key;        // the last part of the path
  std::string path;       // "section.contour.3.1"
  int line = 0;           // counted from 1
  std::size_t begin = 0;  // offset in the source of a text, number or flag, bytes
  std::size_t end = 0;
  std::string text;      // the content of a text; of other scalars, the characters in the source
  bool integer = false;  // a number without decimal point
  bool flag = false;
  std::string unit;           // unit named by {unit, values}; "" if every number has its own
  std::vector<int> children;  // elements of a table or list, in the order of the file
  std::optional<DocumentNumber> number;  // nullopt if the value is not a finite number
};

/// Numbers (SI) that replace those of the file, by the index of their value.
using DocumentChanges = std::map<int, double>;

class DocumentTree {
 public:
  /// Throws InputError on a syntax error and on a file that is too large or nested too deeply.
  DocumentTree(std::string_view source, std::string file);

  const std::string& file() const { return file_; }
  const DocumentValue& value(int i) const { return values_[i]; }
  static constexpr int kRoot = 0;
  static constexpr std::size_t kLargestFile = 4u << 20;  // bytes
  /// Returns the index of a value in a table by its key; -1 if the table has no such key.
  int child(int table, std::string_view key) const;
  /// Returns -1 if the path leads nowhere.
  int find(std::string_view path) const;
  int size() const { return static_cast<int>(values_.size()); }
  Place place(int i) const { return {file_, values_[i].line}; }

  /// Returns the current number, in SI, of a value that has a number.
  double si(int i, const DocumentChanges& changes) const;
  /// Returns a value with its present number, as the file would contain it.
  DocumentValue value_now(int i, const DocumentChanges& changes) const;
  /// Returns the source text with the changed numbers.
  std::string text(const DocumentChanges& changes) const;

 private:
  friend class DocumentBuilder;
  std::string file_;
  std::string source_;
  std::vector<DocumentValue> values_;
  std::map<std::string, int, std::less<>> by_path_;
};

}  // namespace latsch
