// SPDX-License-Identifier: Apache-2.0
#include "formats/road/open_crg.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "formats/road/open_crg_checks.h"
#include "formats/road/open_crg_contradictions.h"
#include "formats/road/open_crg_grid.h"
#include "formats/road/open_crg_header.h"
#include "formats/road/open_crg_records.h"
#include "formats/road/open_crg_references.h"
#include "formats/text/text_encoding.h"

namespace latsch::formats {
namespace {

/// Sets the format if the header has no format line: the standard then assumes KRBI, which data in
/// digits cannot have.
void settle_format(const std::string& bytes, OpenCrgHeader& header) {
  if (!header.format.empty()) return;
  const auto is_text = [](unsigned char c) { return (c >= 32 && c < 127) || c == 10 || c == 13; };
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(header.data_begin);
  if (std::all_of(begin, bytes.end(), is_text))
    throw InputError({header.file, header.data_line},
                     "begins data without a format, expected #:LRFI for digits");
  header.format = "KRBI";
  header.warnings.push_back(header.file +
                            ": there is no format #:, taken as KRBI, as the standard "
                            "says");
}

/// Returns the last value of a channel; NaN if there is none.
double last_of(OpenCrgHeader::Channel::Kind kind,
               const OpenCrgHeader& header,
               const OpenCrgRecords& records) {
  for (std::size_t i = 0; i < header.channels.size(); ++i)
    if (header.channels[i].kind == kind && records.rows > 0)
      return records.at(records.rows - 1, static_cast<int>(i));
  return std::numeric_limits<double>::quiet_NaN();
}

/// Builds a road from the file that has the data, and the options and modifiers that apply to it.
OpenCrg assemble(const std::string& bytes, OpenCrgHeader header) {
  using Kind = OpenCrgHeader::Channel::Kind;
  if (header.data_begin == std::string_view::npos) {
    throw InputError({header.file, 0}, "has no data, expected a line $$$$ and records behind it");
  }
  settle_format(bytes, header);
  if (header.channels.empty()) {
    throw InputError({header.file, header.data_line}, "begins data without channels, expected D:");
  }
  OpenCrg result;
  result.file = header.file;
  result.comment = utf8_text(header.comment, header.file);
  result.format = header.format;
  for (const auto* values : {&header.options, &header.modifiers}) {
    for (const auto& [name, value] : *values) {
      auto& list = concerns_surface(name) ? result.statements : header.kept;
      list.push_back(name + " = " + format_number(value.number));
    }
  }
  settle_open_crg_modifiers(header);
  const OpenCrgRecords records =
      read_open_crg_records(bytes, header, expected_open_crg_rows(header));
  compare_open_crg_end(header,
                       {last_of(Kind::phi, header, records),
                        last_of(Kind::slope, header, records),
                        last_of(Kind::banking, header, records)});
  result.grid = open_crg_grid(header, records, result.gaps);
  if (header.modifiers.empty()) {
    warn_of_contradictions(header, records, result.grid);
  } else {
    OpenCrgHeader unmoved = header;
    unmoved.modifiers.clear();
    int ignored = 0;
    const road::CrgGrid grid = open_crg_grid(unmoved, records, ignored);
    warn_of_contradictions(header, records, grid);
  }
  result.warnings = std::move(header.warnings);
  for (const std::string& statement : header.kept)
    result.kept.push_back(utf8_text(statement, header.file));
  return result;
}

}  // namespace

OpenCrg OpenCrg::read(const std::filesystem::path& file) {
  ResolvedCrg resolved = resolve_open_crg(file);
  return assemble(resolved.bytes, std::move(resolved.header));
}

OpenCrg OpenCrg::parse(const std::string& bytes, const std::string& file_name) {
  check_open_crg_size(bytes, file_name);
  OpenCrgHeader header = read_open_crg_header(bytes, file_name);
  if (!header.references.empty()) {
    throw InputError({header.file, header.references.front().line},
                     "refers to the file " + in_quotes(header.references.front().text) +
                         ", which is not read here");
  }
  return assemble(bytes, std::move(header));
}

}  // namespace latsch::formats
