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
// Names of sections, sub-blocks, keys and heads mean the same in any case and come out in capitals.
// A key belongs to its section wherever in it the key stands. Numbers may have a Fortran exponent
// (1.5D3). Bytes that are no ASCII are taken as they are, so comments may be in any encoding.
// Known limit: sections of one name stay apart (DEFLECTION_LOAD_CURVE may occur twice).
#pragma once

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

/// KEY = value.
struct TeimOrbitEntry {
  std::string key;      // in capitals
  std::string value;    // without quotes
  std::string comment;  // behind the value, without its mark
  bool quoted = false;
  int line = 0;           // counted from 1
  std::size_t begin = 0;  // bytes of the value in the file, quotes included
  std::size_t end = 0;
};

/// One row of a table: its fields as written, those in quotes without them.
struct TeimOrbitRow {
  std::vector<std::string> fields;
  int line = 0;
};

struct TeimOrbitTable {
  std::string block;               // the sub-block it stands in, in capitals; "" for none
  std::vector<std::string> heads;  // in capitals; empty where the file has none
  std::vector<TeimOrbitRow> rows;
  int line = 0;
};

/// One [SECTION] of a file. Every complaint names file and line.
class TeimOrbitSection {
 public:
  TeimOrbitSection(std::string name, std::shared_ptr<const std::string> file, int line);

  const std::string& name() const { return name_; }
  Place place() const { return {*file_, line_}; }
  Place place(int line) const { return {*file_, line}; }

  const std::vector<TeimOrbitEntry>& entries() const { return entries_; }
  /// Marks them as read.
  const std::vector<TeimOrbitTable>& tables() const;
  /// Sub-blocks in the order of the file, also those without rows.
  const std::vector<std::string>& blocks() const { return blocks_; }

  /// nullptr where there is none. InputError where the key stands twice with different values.
  /// Marks the key as read.
  const TeimOrbitEntry* find(std::string_view key) const;
  bool has(std::string_view key) const { return find(key) != nullptr; }
  /// A finite number as written, in the units of the file.
  double number(std::string_view key) const;
  double number(std::string_view key, double fallback) const;
  double number(const TeimOrbitEntry& entry) const;
  long integer(std::string_view key, long fallback) const;
  std::string text(std::string_view key) const;
  std::string text(std::string_view key, std::string_view fallback) const;

  /// The first table of that sub-block ("": outside of any); nullptr where there is none.
  const TeimOrbitTable* find_table(std::string_view block) const;
  /// A row as finite numbers; `width` of them at least.
  std::vector<double> numbers(const TeimOrbitRow& row, std::size_t width) const;

 private:
  friend class TeimOrbitReader;
  friend class TeimOrbit;
  std::string name_;
  std::shared_ptr<const std::string> file_;
  int line_;
  /// Lines of the keys and tables that somebody read, and of the section where one looked for any.
  std::shared_ptr<std::set<int>> read_ = std::make_shared<std::set<int>>();
  std::vector<TeimOrbitEntry> entries_;
  std::vector<TeimOrbitTable> tables_;
  std::vector<std::string> blocks_;
};

/// What one unit of the file is in SI. A file without [UNITS] is taken to be in SI.
struct TeimOrbitUnits {
  double length = 1.0;
  double force = 1.0;
  double angle = 1.0;
  double mass = 1.0;
  double time = 1.0;
  double pressure = 1.0;  // force / length^2 where the file does not name it
};

class TeimOrbit {
 public:
  /// Throws InputError naming file and line: a line that is none of the above, a quote or bracket
  /// that is not closed, zero bytes, a line longer than 64 kB.
  static TeimOrbit read(const std::filesystem::path& file);
  static TeimOrbit parse(std::string text, std::string file_name);

  const std::string& file() const { return *file_; }
  const std::vector<TeimOrbitSection>& sections() const { return sections_; }
  /// The first section of that name; nullptr where there is none.
  const TeimOrbitSection* find(std::string_view section) const;
  /// The same; InputError where there is none.
  const TeimOrbitSection& section(std::string_view name) const;
  /// InputError for a unit that is not known.
  TeimOrbitUnits units() const;

  /// What nobody has looked for so far: "[SECTION] KEY", "[SECTION] {table}", and "[SECTION]" of
  /// which nothing was. A reader calls it at its end, and tells. [MDI_HEADER] describes the file.
  std::vector<std::string> unread() const;

  /// The file with some values replaced (as written, with quotes where they need them); every other
  /// byte stays.
  std::string with_values(const std::map<const TeimOrbitEntry*, std::string>& values) const;
  const std::string& source() const { return source_; }

 private:
  friend class TeimOrbitReader;
  std::shared_ptr<const std::string> file_;
  std::string source_;
  std::vector<TeimOrbitSection> sections_;
};

}  // namespace latsch::formats
