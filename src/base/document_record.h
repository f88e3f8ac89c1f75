// SPDX-License-Identifier: Apache-2.0
// Records what a reader requested from a table and what it received: the declaration of every key
// (kind of value, unit, range, choices, default) with its resolved value, and the files that keys
// name.
//
// A reader needs no code for this: the getters of Node record as they read. The record has two
// uses. Its text() is the identity of what was read: every key that counts, with its default if it
// was not written, and no comment, order, unit or position. Its keys() are the table of keys for a
// page, a form or a schema.
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

/// Declaration of a key by its reader.
struct DeclaredKey {
  enum class Kind {
    presence,  // only tested for presence
    table,
    tables,  // tables with free names
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
  std::vector<std::string> units = {};    // units in SI: a single one, or one for each column
  Range range = {};                       // for numbers
  std::vector<std::string> choices = {};  // for a choice
  /// Requirement in words, "a share such as 3 %", for a text that its reader analyzes.
  std::vector<std::string> expected = {};
  std::optional<std::string> fallback = {};  // value that applies if the key is not written
  std::string value = {};                    // resolved value; "" if it was not read
  bool is_there = false;                     // true if the file has the key
  bool may_be_missing = false;               // the reader tests whether the key is present
  bool is_measurable = false;                // {from = "measurement.NAME"} is allowed
  /// Files that the key names, followed by the files that those refer to.
  std::vector<std::filesystem::path> files = {};
};

/// The keys of one reading by their paths below the table at which the reading begins:
/// "road.heading".
struct RecordedKeys {
  std::string base;  // path of the table
  std::map<std::string, DeclaredKey> keys;
  /// Values that replace whole tables, by the path of the table.
  std::map<std::string, std::string> in_place;
  std::shared_ptr<RecordedKeys> outer;  // record of an enclosing reading; nullptr: none

  std::string path_of(std::string_view table, std::string_view key) const;
  void ask(std::string_view table, std::string_view key, bool is_there);
  void declare(std::string_view table, std::string_view key, DeclaredKey what);
};

class DocumentRecord {
 public:
  /// Records everything read through node() and the tables found through it.
  explicit DocumentRecord(const Node& table);
  const Node& node() const { return node_; }

  /// Returns every key that was read or tested for, by its path, including keys that the file
  /// lacks.
  const std::map<std::string, DeclaredKey>& keys() const { return recorded_->keys; }
  /// Adds a value that was not read from this table, in canonical form, under a path.
  void put(const std::string& path, std::string value);

  /// Returns the identity of what was read: a line `path = value` for every key that is written or
  /// has a default, sorted by path. A named file counts by its content and the extension of its
  /// name. Two texts are equal exactly if the readers received the same. Long values appear as
  /// fingerprints. Throws InputError if a named file cannot be read any more.
  std::string text() const;
  /// Returns every file that was named, and the files that those refer to.
  std::vector<std::filesystem::path> files() const;

  // The following functions are called by readers of tables. They do nothing if nothing is
  // recorded.

  /// Records the value into which a whole table, such as {from = "measurement.rig"}, was resolved.
  static void stands_for(const Node& table, const std::string& value);
  /// Records the files that a key names: the file itself, then the files that it refers to.
  static void names_files(const Node& table,
                          std::string_view key,
                          const std::vector<std::filesystem::path>& files);
  /// Records in words the form that the text under the key must have, beyond the type of the getter
  /// that reads it. May be called several times for a key, once for each allowed form.
  static void expects(const Node& table, std::string_view key, const std::string& words);
  /// Records that {from = "measurement.NAME"} is allowed under the key.
  static void may_be_measured(const Node& table, std::string_view key);

 private:
  std::string written(const std::string& path) const;

  std::shared_ptr<RecordedKeys> recorded_;
  Node node_;
};

/// Returns a document without its comments, formatting and units: a line of TOML for every value,
/// in the order of the file, quantities in SI. Reading the text and calling this again gives the
/// same text.
std::string canonical_text(const Document& document);

/// Returns a short text that identifies a content, "17 bytes, 9f86d081884c7d65": its length and its
/// 64-bit FNV-1a hash [Fowler, Noll, Vo, draft-eastlake-fnv]. Contents that differ by accident or
/// by an edit get different fingerprints; there is no protection against intent.
std::string fingerprint(std::string_view text);

/// Returns the fingerprint of the meaning of a file. For a .toml file this is the fingerprint of
/// its canonical text, so that comments and formatting do not matter; for any other file it is that
/// of its bytes. Throws InputError if the file cannot be read.
std::string fingerprint_of_file(const std::filesystem::path& file);

// These functions return values as TOML text with all digits, as records write them.

std::string canonical(double value, std::string_view unit);
std::string canonical(const std::vector<double>& values, std::string_view unit);
std::string canonical(const std::vector<std::vector<double>>& rows,
                      const std::vector<std::string>& units);
std::string canonical(const std::vector<std::string>& texts);

}  // namespace latsch
