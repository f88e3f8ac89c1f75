// SPDX-License-Identifier: Apache-2.0
// The TeimOrbit form of Adams property files: .tir, .rdf, .bus.
//
//   $ a comment              ! another
//   [SECTION]
//   KEY = 'text'             $ a comment behind a value
//   KEY = 3.5e5
//   (SUB_BLOCK)              names the rows below it
//   {head_1 head_2}          heads of the rows; one block may hold rows without them
//    1.0    0.2
//
// Names of sections, sub-blocks, keys and heads are the same in upper and lower case and are
// returned in capitals. A key belongs to its section at any position in the section. Numbers may
// have a Fortran exponent (1.5D3). Bytes that are not ASCII are kept, so comments may be in any
// encoding. Sections with the same name stay separate (DEFLECTION_LOAD_CURVE may occur twice).
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace latsch::formats {

/// A line KEY = value.
struct TeimOrbitEntry {
  std::string key;      // in capitals
  std::string value;    // without quotes
  std::string comment;  // comment after the value, without its mark
  bool quoted = false;
  int line = 0;           // counted from 1
  std::size_t begin = 0;  // position in bytes of the value in the file, quotes included
  std::size_t end = 0;
};

/// One row of a table: its fields as written, without quotes.
struct TeimOrbitRow {
  std::vector<std::string> fields;
  int line = 0;
};

struct TeimOrbitTable {
  std::string block;               // sub-block to which the table belongs, in capitals; "" for none
  std::vector<std::string> heads;  // in capitals; empty if the file has none
  std::vector<TeimOrbitRow> rows;
  int line = 0;
};

/// One [SECTION] of a file. Every error message names file and line.
class TeimOrbitSection {
 public:
  TeimOrbitSection(std::string name, std::shared_ptr<const std::string> file, int line);

  const std::string& name() const { return name_; }
  Place place() const { return {*file_, line_}; }
  Place place(int line) const { return {*file_, line}; }

  const std::vector<TeimOrbitEntry>& entries() const { return entries_; }
  /// Returns the tables and marks them as read; see TeimOrbit::unread().
  const std::vector<TeimOrbitTable>& tables() const;
  /// Returns the names of the sub-blocks in the order of the file, also of those without rows.
  const std::vector<std::string>& blocks() const { return blocks_; }

  /// Returns the entry of a key and marks it as read; nullptr if there is no such key. Throws
  /// InputError if the key occurs twice with different values.
  const TeimOrbitEntry* find(std::string_view key) const;
  bool has(std::string_view key) const { return find(key) != nullptr; }
  /// Return a finite number as written, in the units of the file; `fallback`, if given, for a
  /// missing key.
  double number(std::string_view key) const;
  double number(std::string_view key, double fallback) const;
  double number(const TeimOrbitEntry& entry) const;
  long integer(std::string_view key, long fallback) const;
  std::string text(std::string_view key) const;
  std::string text(std::string_view key, std::string_view fallback) const;

  /// Returns the first table of that sub-block ("": outside of any sub-block); nullptr if there is
  /// none.
  const TeimOrbitTable* find_table(std::string_view block) const;
  /// Returns the row as finite numbers. Throws InputError if there are fewer than `width`.
  std::vector<double> numbers(const TeimOrbitRow& row, std::size_t width) const;

 private:
  friend class TeimOrbitReader;
  friend class TeimOrbit;
  std::string name_;
  std::shared_ptr<const std::string> file_;
  int line_;
  /// Lines of the keys and tables that were read, and the line of the section if any key was
  /// searched in it.
  std::shared_ptr<std::set<int>> read_ = std::make_shared<std::set<int>>();
  std::vector<TeimOrbitEntry> entries_;
  std::vector<TeimOrbitTable> tables_;
  std::vector<std::string> blocks_;
};

/// SI values of the units in which a file is written. If code uses a unit that the file does not
/// state, an exception is thrown, because a guessed unit would change every number without notice.
/// For formats whose default is SI, the caller requests this default. Without a file all units are
/// SI.
class TeimOrbitUnits {
 public:
  enum class Missing { is_refused, is_si };

  /// Return the SI value of a unit. Throw InputError, which says which line to add, if the file
  /// does not state the unit.
  double length() const { return of(0); }
  double force() const { return of(1); }
  double angle() const { return of(2); }
  double mass() const { return of(3); }
  double time() const { return of(4); }
  /// Returns the SI value of the unit of pressure: force / length^2 if the file does not state one.
  double pressure() const;

  /// Returns the keys of units that the file does not state, except PRESSURE, such as "LENGTH",
  /// "ANGLE".
  std::vector<std::string> missing() const;
  /// Returns the SI unit for a key of [UNITS] in words: "meter" for LENGTH.
  static std::string si_in_words(std::string_view key);

 private:
  friend class TeimOrbit;
  double of(std::size_t key) const;

  std::array<std::optional<double>, 6> stated_;
  Missing missing_ = Missing::is_si;
  bool has_section_ = false;
  Place place_;  // the line [UNITS]; the whole file if it has none
};

/// A part of a file that was not used.
struct TeimOrbitPart {
  std::string name;  // "[SECTION] KEY", "[SECTION] {heads}", or "[SECTION]" for a whole section
  int line = 0;
};

class TeimOrbit {
 public:
  /// Throw InputError that names file and line for: a line of none of the forms above, a quote or
  /// bracket that is not closed, zero bytes, a line longer than 64 kB.
  static TeimOrbit read(const std::filesystem::path& file);
  static TeimOrbit parse(std::string text, std::string file_name);

  const std::string& file() const { return *file_; }
  const std::vector<TeimOrbitSection>& sections() const { return sections_; }
  /// Returns the first section of the given name; nullptr if there is none.
  const TeimOrbitSection* find(std::string_view section) const;
  /// Returns the first section of the given name; throws InputError if there is none.
  const TeimOrbitSection& section(std::string_view name) const;
  /// Returns the units of the file. Throws InputError for an unknown unit.
  TeimOrbitUnits units(TeimOrbitUnits::Missing missing = TeimOrbitUnits::Missing::is_refused) const;

  /// Returns the parts that have not been read so far: "[SECTION] KEY", "[SECTION] {table}", and
  /// "[SECTION]" if nothing of it was read. A reader calls this after reading and reports them.
  /// [MDI_HEADER] describes the file and is not included. A section that occurs a second time but
  /// was read only once is "a second [SECTION]".
  std::vector<TeimOrbitPart> unread() const;

  /// Returns the text of the file with some values replaced by the given texts (with quotes if
  /// needed); every other byte stays.
  std::string with_values(const std::map<const TeimOrbitEntry*, std::string>& values) const;
  const std::string& source() const { return source_; }

 private:
  friend class TeimOrbitReader;
  std::shared_ptr<const std::string> file_;
  std::string source_;
  std::vector<TeimOrbitSection> sections_;
};

}  // namespace latsch::formats
