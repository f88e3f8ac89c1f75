// SPDX-License-Identifier: Apache-2.0
// What a reader asked of a table, and what it got: the declaration of every key (kind of value,
// unit, range, choices, default) with its resolved value, and the files that keys name.
//
// A reader does nothing for it: the getters of Node record as they read. The record is the one
// source of two things. Its text() is the identity of what was read: every key that counts, with
// its default where it was not written, and no comment, order, unit or place. Its keys() are the
// table of keys for a page, a form or a schema.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/document.h"

namespace latsch {

/// A key as its reader asked for it.
struct DeclaredKey {
  enum class Kind {
    presence,  // only whether it is there
    table,
    tables,  // with free names
    quantity,
    quantities,
    one_or_more,
    rows,
    integer,
    flag,
    text,
    choice,
    texts
  };
  Kind kind = Kind::presence;
  std::vector<std::string> units = {};            // SI: one, or of every column
  Range range = {};                               // of numbers
  std::vector<std::string> choices = {};          // of a choice
  std::optional<std::string> fallback = {};       // what holds unless it is written
  std::string value = {};                         // as resolved; "" where it was not read
  bool is_there = false;                          // in the file
  bool is_measurable = false;                     // {from = "measurement.NAME"} may stand there
  std::vector<std::filesystem::path> files = {};  // that it names, those they refer to behind them
};

/// The keys of one reading by their paths below the table it begins with: "road.heading".
struct RecordedKeys {
  std::string base;  // path of that table
  std::map<std::string, DeclaredKey> keys;
  std::map<std::string, std::string> in_place;  // of a whole table: the value it stands for
  std::shared_ptr<RecordedKeys> outer;          // of a reading around this one; nullptr: none

  std::string path_of(std::string_view table, std::string_view key) const;
  void ask(std::string_view table, std::string_view key, bool is_there);
  void declare(std::string_view table, std::string_view key, DeclaredKey what);
};

class DocumentRecord {
 public:
  /// Records what is read through node() and the tables found through it.
  explicit DocumentRecord(const Node& table);
  const Node& node() const { return node_; }

  /// Every key asked for, by its path, also those that are not there.
  const std::map<std::string, DeclaredKey>& keys() const { return recorded_->keys; }
  /// Adds a value that stands somewhere else, in canonical form.
  void put(const std::string& path, std::string value);

  /// The identity of what was read: a line `path = value` for every key that is written or has a
  /// default, sorted by path. A named file counts by its content and the ending of its name. Two
  /// texts are equal exactly if the readers got the same. Long values appear as fingerprints.
  /// Throws InputError if a named file cannot be read any more.
  std::string text() const;
  /// Every file that was named, and those they refer to.
  std::vector<std::filesystem::path> files() const;

  // For readers. Each does nothing where nobody records.

  /// What a whole table, such as {from = "measurement.rig"}, has been resolved into.
  static void stands_for(const Node& table, std::string value);
  /// The files a key names: its own, then those that this refers to.
  static void names_files(const Node& table,
                          std::string_view key,
                          std::vector<std::filesystem::path> files);
  /// That {from = "measurement.NAME"} may stand under the key.
  static void may_be_measured(const Node& table, std::string_view key);

 private:
  std::string written(const std::string& path) const;

  std::shared_ptr<RecordedKeys> recorded_;
  Node node_;
};

/// A document without its comments, formatting and units: a line of TOML for every value, in the
/// order of the file, quantities in SI. Reading the text gives the same text.
std::string canonical_text(const Document& document);

/// A content in a few characters, "17 bytes, 9f86d081884c7d65": its length and the 64-bit FNV-1a
/// hash [Fowler, Noll, Vo, draft-eastlake-fnv]. It tells contents apart that differ by accident or
/// by an edit; it protects against nobody.
std::string fingerprint(std::string_view text);

/// Of what a file means: of a .toml its canonical text, so that notes and formatting do not matter,
/// of any other file its bytes. Throws InputError if the file cannot be read.
std::string fingerprint_of_file(const std::filesystem::path& file);

// Values as records write them: exact, as TOML.

std::string canonical(double value, std::string_view unit);
std::string canonical(const std::vector<double>& values, std::string_view unit);
std::string canonical(const std::vector<std::vector<double>>& rows,
                      const std::vector<std::string>& units);
std::string canonical(const std::vector<std::string>& texts);

}  // namespace latsch
