// SPDX-License-Identifier: Apache-2.0
#include "formats/deck/inp_remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "base/text.h"
#include "formats/text/letter_case.h"

namespace latsch::formats {
namespace {

constexpr std::string_view kBeginning = "** latsch ";
constexpr int kMostLayerRows = 1000;  // most elements through the thickness of a layer

std::string remark_without_blanks(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return std::string(text);
}

std::vector<std::string> fields_of_remark(std::string_view text) {
  std::vector<std::string> fields;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    fields.push_back(remark_without_blanks(text.substr(begin, comma - begin)));
    begin = comma + 1;
  }
  return fields;
}

class RemarkReader {
 public:
  void take(std::string_view line, const Place& place) {
    const std::string_view said = line.substr(kBeginning.size());
    const std::size_t colon = said.find(':');
    if (colon == std::string_view::npos) return;
    const std::string name = remark_without_blanks(lower(said.substr(0, colon)));
    const std::vector<std::string> fields = fields_of_remark(said.substr(colon + 1));
    if (name == "wall") {
      take_wall(fields, place);
    } else if (name == "tread") {
      if (fields.size() != 1 || fields[0].empty())
        throw InputError(place,
                         "expected the name of an element set, as in "
                         "\"** latsch tread: TREAD\"");
      remarks_.treads.push_back({upper(fields[0]), place});
    } else if (name == "planes") {
      take_planes(fields, place);
    } else {
      throw InputError(place,
                       fmt::format("{} is no remark of a deck, expected wall, tread or planes",
                                   in_quotes(name)));
    }
  }

  InpRemarks remarks() { return std::move(remarks_); }

 private:
  void take_wall(const std::vector<std::string>& fields, const Place& place) {
    const auto thickness = fields.size() == 3 ? parse_number(fields[1]) : std::optional<double>();
    const auto rows = fields.size() == 3 ? parse_number(fields[2]) : std::optional<double>();
    if (!thickness || !rows || fields[0].empty() || !(*thickness >= 0.0) || !(*rows >= 0.0) ||
        *rows > kMostLayerRows || *rows != static_cast<int>(*rows))
      throw InputError(place,
                       "expected an element set, the thickness of its wall and the number of "
                       "elements in its layer, as in \"** latsch wall: WALL0, 8.5, 1\"");
    remarks_.walls.push_back({upper(fields[0]), *thickness, static_cast<int>(*rows), place});
  }

  void take_planes(const std::vector<std::string>& fields, const Place& place) {
    if (remarks_.planes.empty()) remarks_.planes_place = place;
    for (const std::string& field : fields) {
      const auto degrees = parse_number(field);
      const double last = remarks_.planes.empty() ? -1.0 : remarks_.planes.back();
      const double angle = degrees.value_or(-1.0) * std::numbers::pi / 180.0;
      if (!degrees || !(angle >= 0.0) || angle <= last || !(*degrees < 360.0))
        throw InputError(place,
                         fmt::format("plane {} is at {}, expected angles from 0 to 360 degrees "
                                     "that rise",
                                     remarks_.planes.size(),
                                     in_quotes(field)));
      remarks_.planes.push_back(angle);
    }
  }

  static std::string upper(std::string text) {
    for (char& c : text)
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return text;
  }

  InpRemarks remarks_;
};

}  // namespace

InpRemarks stated_remarks(std::string_view text, const std::string& file_name) {
  RemarkReader reader;
  int line = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    ++line;
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view one = text.substr(begin, end - begin);
    begin = end + 1;
    if (!one.starts_with("**") || one.size() < kBeginning.size()) continue;
    if (lower(one.substr(0, kBeginning.size())) == kBeginning) reader.take(one, {file_name, line});
  }
  return reader.remarks();
}

}  // namespace latsch::formats
