// SPDX-License-Identifier: Apache-2.0
#include "formats/road/open_crg.h"

#include "base/file.h"
#include "base/text.h"
#include "formats/road/open_crg_grid.h"
#include "formats/road/open_crg_header.h"
#include "formats/road/open_crg_records.h"
#include "formats/text/text_encoding.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kLargestCrg = 256u << 20;  // bytes
constexpr int kDeepestReference = 4;             // files that refer to each other

void check_size(std::string_view bytes, const std::string& file) {
  if (bytes.size() > kLargestCrg) throw InputError({file, 0}, "is larger than 256 MB");
}

/// The file itself, or what it includes with its own options and modifiers in the place of those.
OpenCrg assemble(const std::string& bytes, const OpenCrgHeader& header) {
  if (header.data_begin == std::string_view::npos) {
    throw InputError({header.file, 0}, "has no data, expected a line $$$$ and records behind it");
  }
  if (header.format.empty()) {
    throw InputError({header.file, header.data_line}, "begins data of no format, expected #:LRFI");
  }
  if (header.channels.empty()) {
    throw InputError({header.file, header.data_line}, "begins data without channels, expected D:");
  }
  OpenCrg result;
  result.file = header.file;
  result.comment = utf8_text(header.comment, header.file);
  result.format = header.format;
  result.warnings = header.warnings;
  for (const auto* values : {&header.options, &header.modifiers}) {
    for (const auto& [name, value] : *values) {
      result.statements.push_back(name + " = " + format_number(value.number));
    }
  }
  const OpenCrgRecords records =
      read_open_crg_records(bytes, header, expected_open_crg_rows(header));
  result.grid = open_crg_grid(header, records, result.gaps);
  return result;
}

OpenCrg read_included(const std::filesystem::path& file, const OpenCrgHeader* outer, int depth) {
  const std::string bytes = read_text_file(file, kLargestCrg);
  OpenCrgHeader header = read_open_crg_header(bytes, file.string());
  if (outer && !outer->options.empty()) header.options = outer->options;
  if (outer && !outer->modifiers.empty()) header.modifiers = outer->modifiers;
  if (header.include.empty()) return assemble(bytes, header);
  const Place place{header.file, header.include_line};
  if (depth == kDeepestReference)
    throw InputError(place, "refers to a file that refers to files, too deep");
  if (header.include.find('$') != header.include.npos) {
    throw InputError(place, "has " + in_quotes(header.include) + ", expected a path without $");
  }
  OpenCrg result = read_included(file.parent_path() / header.include, &header, depth + 1);
  result.warnings.insert(result.warnings.begin(), header.warnings.begin(), header.warnings.end());
  return result;
}

}  // namespace

OpenCrg OpenCrg::read(const std::filesystem::path& file) { return read_included(file, nullptr, 0); }

OpenCrg OpenCrg::parse(std::string bytes, std::string file_name) {
  check_size(bytes, file_name);
  const OpenCrgHeader header = read_open_crg_header(bytes, file_name);
  if (!header.include.empty()) {
    throw InputError(
        {header.file, header.include_line},
        "refers to the file " + in_quotes(header.include) + ", which is not read here");
  }
  return assemble(bytes, header);
}

}  // namespace latsch::formats
