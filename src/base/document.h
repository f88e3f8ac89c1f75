// SPDX-License-Identifier: Apache-2.0
// A model or a study is data: this file presents a TOML file as a tree of quantities with units.
//
// Every number has a path ("rubber.tread.young_modulus", "layer.belt_1.angle") and can be varied
// through that path; no part of a model knows whether it varies. Quantities are written with their
// unit, "2.6 bar", and read in SI. Every error message names file, line, what was found and what
// was expected.
#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace latsch {

/// Interval of allowed values, SI. The upper end is included, and so is the lower end unless
/// `lower_excluded` is true.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();  // SI
  double upper = std::numeric_limits<double>::infinity();   // SI
  bool lower_excluded = false;  // true: the lower end itself is not allowed

  /// Values above 0.
  static Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true}; }
  /// Values from 0 on.
  static Range not_negative() { return {0.0, std::numeric_limits<double>::infinity(), false}; }
  /// Values from `lower` to `upper`, both included.
  static Range between(double lower, double upper) { return {lower, upper, false}; }
};

class DocumentTree;  // the parsed file; see document_tree.h

/// One table of a Document. Every getter remembers its key; close() then rejects keys that no
/// getter has read.
class Node {
 public:
  /// True if the table has an entry of this name. The key then counts as read.
  bool has(std::string_view key) const;

  /// Returns a quantity in the SI unit of `unit`: "2.6 bar" with unit "Pa" gives 2.6e5. A plain
  /// number is allowed only if the unit is "1". Throws InputError if the key is missing or if the
  /// value has another dimension, is outside `range` or is not finite.
  double quantity(std::string_view key, std::string_view unit, Range range = {}) const;
  /// Returns `fallback` (SI) if the key is missing.
  double quantity(std::string_view key, std::string_view unit, Range range, double fallback) const;
  /// Returns a list: ["0 mm", "5 mm"], or with one unit for all, {unit = "mm", values = [0, 5]}.
  std::vector<double> quantities(std::string_view key,
                                 std::string_view unit,
                                 Range range = {}) const;
  /// Reads a list as quantities() does, or a single value as a list of length one.
  std::vector<double> one_or_more(std::string_view key,
                                  std::string_view unit,
                                  Range range = {}) const;
  /// Returns a list of rows whose columns have the units given: contour = [["0 mm", "310 mm"], ...]
  /// or {unit = "mm", values = [[0, 310]]}.
  std::vector<std::vector<double>> rows(std::string_view key,
                                        const std::vector<std::string>& units) const;

  /// Returns a whole number from `lower` to `upper`. Throws InputError if the key is missing or has
  /// another value.
  long integer(std::string_view key, long lower, long upper) const;
  /// Returns `fallback` if the key is missing.
  long integer(std::string_view key, long lower, long upper, long fallback) const;
  /// Returns true or false; `fallback` if the key is missing. Throws InputError for any other
  /// value.
  bool flag(std::string_view key, bool fallback) const;
  /// Returns a text. Throws InputError if the key is missing or is no text.
  std::string text(std::string_view key) const;
  /// Returns `fallback` if the key is missing.
  std::string text(std::string_view key, std::string_view fallback) const;
  /// Returns a text that is one of `allowed`; the error message lists them and names the nearest.
  std::string choice(std::string_view key, const std::vector<std::string>& allowed) const;
  /// Returns `fallback` if the key is missing.
  std::string choice(std::string_view key,
                     const std::vector<std::string>& allowed,
                     std::string_view fallback) const;
  /// Returns a list of texts. Throws InputError if the key is missing or has another value.
  std::vector<std::string> texts(std::string_view key) const;

  /// Returns the table of the given name. Throws InputError if it is missing.
  Node table(std::string_view key) const;
  /// Returns the table of the given name; nullopt if it is missing.
  std::optional<Node> find_table(std::string_view key) const;
  /// Returns the child tables in the order of the file, [layer.carcass] [layer.belt_1] below
  /// "layer", or none. Their names are free and count as read.
  std::vector<Node> named_tables(std::string_view key) const;

  /// Returns the names of all entries of the table in the order of the file. None of them counts as
  /// read.
  std::vector<std::string> keys() const;

  /// The last part of the path, such as "belt_1".
  const std::string& name() const;
  /// The path from the root, such as "layer.belt_1".
  const std::string& path() const;
  /// The place of this table in its file.
  Place place() const;
  /// The place of an entry of this table; that of the table if the entry is missing.
  Place place(std::string_view key) const;

  /// Throws InputError at the place of `key`: its path, such as "layer.belt_1.angle", a blank and
  /// the message.
  [[noreturn]] void reject(std::string_view key, const std::string& message) const;

  /// Throws InputError for the first key of this table, or of a table read through it, that no
  /// getter has read: `tire.toml:12: unknown key "presure", did you mean "pressure"?`
  void close() const;

 private:
  friend class Document;
  struct Impl;  // defined in document_node.h
  explicit Node(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

/// A parsed file whose numbers can be set. Copies are independent of each other, and a Node keeps
/// the values of the moment at which root() was called.
///
/// A path joins keys and positions in lists by dots, positions counted from 0: the second column of
/// the fourth row of section.contour is "section.contour.3.1", even if the list has one unit for
/// all its values.
class Document {
 public:
  /// Throws InputError on a syntax error, a file above 4 MB or nesting deeper than 16 levels.
  static Document read(const std::filesystem::path& file);
  /// Reads TOML from a text. Messages name it by `file_name`. Throws InputError as read() does.
  static Document parse(std::string_view text, std::string file_name);

  /// The table that contains all others.
  Node root() const;

  /// get() returns the number at `path` in SI, unit() its SI unit ("Pa"). Both throw InputError if
  /// the path leads to no number; the message names the nearest path that does.
  double get(std::string_view path) const;
  /// The SI unit of the number at `path`.
  std::string unit(std::string_view path) const;
  /// Replaces the number at `path` by an SI value; the text keeps the unit that the file has.
  void set(std::string_view path, double value);
  /// Returns every path that leads to a number.
  std::vector<std::string> paths() const;

  /// Returns the TOML text with the current values.
  std::string text() const;
  /// The name of the file in messages.
  const std::string& file() const;

 private:
  std::shared_ptr<const DocumentTree> tree_;
  /// Changed only while this document is the only owner.
  std::shared_ptr<std::map<int, double>> changes_;
};

}  // namespace latsch
