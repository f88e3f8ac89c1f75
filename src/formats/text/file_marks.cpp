// SPDX-License-Identifier: Apache-2.0
#include "formats/text/file_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "base/error.h"
#include "base/text.h"
#include "formats/text/letter_case.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kHeadBytes = 512;

struct StartOfFile {
  std::string_view bytes;
  FileMark mark;
};

const std::vector<StartOfFile>& starts_of_files() {
  using namespace std::string_view_literals;
  static const std::vector<StartOfFile> starts = {
      {"MDF     "sv, {"an MDF 4 file", {".mf4", ".mdf"}, ""}},
      {"UnFinMF "sv, {"an MDF 4 file", {".mf4", ".mdf"}, ""}},
      {"TDSm"sv, {"a TDMS file", {".tdms"}, ""}},
      {"FORMAT\0"sv, {"an RPC III file", {".rsp", ".drv", ".tim", ".rpc"}, ""}},
      {"@\0\0\0"sv, {"a MoTeC log", {".ld"}, ""}},
      {"MATLAB 5.0 MAT-file"sv, {"a MATLAB file", {".mat"}, ""}},
      {"MATLAB 7.3 MAT-file"sv, {"a MATLAB file", {".mat"}, ""}},
      {"**HEADER"sv, {"a TYDEX file", {".tdx", ".tydex", ".tda", ".tdb"}, ""}},
      {"PK\x03\x04"sv,
       {"a ZIP archive or a workbook (.xlsx)",
        {},
        "save the sheet as .csv, or unpack the archive"}},
      {"\xd0\xcf\x11\xe0"sv, {"a workbook (.xls)", {}, "save the sheet as .csv"}},
      {"\x1f\x8b"sv, {"a compressed file (gzip)", {}, "unpack it"}},
      {"%PDF-"sv, {"a PDF document", {}, "ask for the numbers as .csv"}},
  };
  return starts;
}

/// True for the first two lines of a universal file: a line of -1 in columns 5 and 6, and a line
/// with a data set's number.
bool begins_as_universal_file(std::string_view head) {
  if (!head.starts_with("    -1")) return false;
  const std::size_t end = head.find('\n');
  if (end == head.npos || !trimmed(head.substr(6, end - 6)).empty()) return false;
  const std::string_view next = head.substr(end + 1);
  return next.size() >= 6 && std::isdigit(static_cast<unsigned char>(next[5])) &&
         std::all_of(next.begin(), next.begin() + 5, [](unsigned char c) {
           return c == ' ' || std::isdigit(c);
         });
}

}  // namespace

const FileMark* find_file_mark(std::string_view head) {
  static const FileMark universal = {"a universal file", {".uff", ".unv", ".uf", ".bunv"}, ""};
  for (const StartOfFile& start : starts_of_files())
    if (head.starts_with(start.bytes)) return &start.mark;
  return begins_as_universal_file(head) ? &universal : nullptr;
}

void expect_content_of_ending(const std::filesystem::path& file, std::string_view head) {
  const FileMark* mark = find_file_mark(head.substr(0, kHeadBytes));
  if (!mark) return;
  const std::string ending = lower(file.extension().string());
  const auto& endings = mark->endings;
  if (std::find(endings.begin(), endings.end(), ending) != endings.end()) return;
  const std::string name = ending.empty() ? "has no extension" : "ends in " + in_quotes(ending);
  throw InputError(
      {file.string(), 0},
      endings.empty()
          ? fmt::format(
                "is {} by its first bytes; such a file is not read: {}", mark->words, mark->advice)
          : fmt::format("is {} by its first bytes, but {}: expected {}; change its name",
                        mark->words,
                        name,
                        list_of(endings)));
}

void expect_content_of_ending(const std::filesystem::path& file) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) return;
  std::ifstream in(file, std::ios::binary);
  std::string head(kHeadBytes, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  expect_content_of_ending(file, head);
}

}  // namespace latsch::formats
