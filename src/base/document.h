// SPDX-License-Identifier: Apache-2.0
// A model or a study as data: a TOML file seen as a tree of quantities with units.
//
// Any number in it has a path ("rubber.tread.young_modulus", "layer.belt_1.angle") and can be
// varied through that path; nothing in a model knows whether it varies. Quantities are written with
// their unit, "2.6 bar", and read in SI. Every complaint names file, line, what was found and what
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

/// Closed interval of allowed values, SI. `above`: the lower end itself is excluded.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_excluded = false;

  static Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true}; }
  static Range not_negative() { return {0.0, std::numeric_limits<double>::infinity(), false}; }
  static Range between(double lower, double upper) { return {lower, upper, false}; }
};

class DocumentTree;  // the parsed file: document_tree.h

/// One table of a Document. Every get remembers its key; close() then rejects keys nobody asked
/// for.
class Node {
 public:
  bool has(std::string_view key) const;

  /// A quantity in the SI unit of `unit`: "2.6 bar" with unit "Pa" gives 2.6e5. A plain number is
  /// allowed only where unit is "1". Throws InputError on a missing key, a wrong dimension, a value
  /// outside `range` or not finite.
  double quantity(std::string_view key, std::string_view unit, Range range = {}) const;
  double quantity(std::string_view key, std::string_view unit, Range range, double fallback) const;
  /// A list: ["0 mm", "5 mm"] or with one unit for all, {unit = "mm", values = [0, 5]}.
  std::vector<double> quantities(std::string_view key,
                                 std::string_view unit,
                                 Range range = {}) const;
  /// The same, or one value alone.
  std::vector<double> one_or_more(std::string_view key,
                                  std::string_view unit,
                                  Range range = {}) const;
  /// A list of rows, each of the units given: contour = [["0 mm", "310 mm"], ...] or {unit = "mm",
  /// values = [[0, 310]]}.
  std::vector<std::vector<double>> rows(std::string_view key,
                                        const std::vector<std::string>& units) const;

  long integer(std::string_view key, long lower, long upper) const;
  long integer(std::string_view key, long lower, long upper, long fallback) const;
  bool flag(std::string_view key, bool fallback) const;
  std::string text(std::string_view key) const;
  std::string text(std::string_view key, std::string_view fallback) const;
  /// One of `allowed`; the error lists them and names the nearest.
  std::string choice(std::string_view key, const std::vector<std::string>& allowed) const;
  std::string choice(std::string_view key,
                     const std::vector<std::string>& allowed,
                     std::string_view fallback) const;
  std::vector<std::string> texts(std::string_view key) const;

  /// The table of that name; throws where it is missing.
  Node table(std::string_view key) const;
  std::optional<Node> find_table(std::string_view key) const;
  /// Child tables in the order of the file, [layer.carcass] [layer.belt_1] below "layer"; empty
  /// where there are none. The keys themselves are free names and count as asked for.
  std::vector<Node> named_tables(std::string_view key) const;

  /// The names of all that stands in it, in the order of the file; none counts as asked for.
  std::vector<std::string> keys() const;

  /// The last part of the path: "belt_1".
  const std::string& name() const;
  /// The path from the root: "layer.belt_1".
  const std::string& path() const;
  Place place() const;
  Place place(std::string_view key) const;

  /// InputError at the place of `key`, "layer.belt_1.angle" + " " + message.
  [[noreturn]] void reject(std::string_view key, const std::string& message) const;

  /// Throws for the first key of this table and of the tables read through it that was never asked
  /// for: `tire.toml:12: unknown key "presure", did you mean "pressure"?`
  void close() const;

 private:
  friend class Document;
  struct Impl;  // document_node.h
  explicit Node(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

/// A parsed file whose numbers can be set. Copies are independent of each other, and a Node keeps
/// the values of the moment root() was called.
///
/// A path joins keys and places in lists by dots, places counted from 0: the second column of the
/// fourth row of section.contour is "section.contour.3.1", also where it is written with one unit
/// for all.
class Document {
 public:
  /// Throws InputError on a syntax error, a file over 4 MB or nesting deeper than 16.
  static Document read(const std::filesystem::path& file);
  static Document parse(std::string_view text, std::string file_name);

  Node root() const;

  /// The number at `path`, in SI, with the SI unit it stands for ("Pa"). Throws InputError where
  /// the path does not lead to a number and names the nearest path that does.
  double get(std::string_view path) const;
  std::string unit(std::string_view path) const;
  /// Replaces the number at `path` (SI value); it stays written in the unit the file had.
  void set(std::string_view path, double value);
  /// Every path that leads to a number.
  std::vector<std::string> paths() const;

  /// TOML text with the current values.
  std::string text() const;
  const std::string& file() const;

 private:
  std::shared_ptr<const DocumentTree> tree_;
  std::shared_ptr<std::map<int, double>> changes_;  // changed by its only owner
};

}  // namespace latsch
