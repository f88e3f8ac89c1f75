// SPDX-License-Identifier: Apache-2.0
#include "formats/road/open_crg_header.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "base/utf8.h"
#include "formats/text/letter_case.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kMostRoadChannels = 20000;
constexpr std::size_t kLongestHeaderLine = 1000;

const std::vector<std::string> kRoad = {
    "reference_line_start_u",    "reference_line_start_x",   "reference_line_start_y",
    "reference_line_start_z",    "reference_line_start_phi", "reference_line_start_b",
    "reference_line_start_s",    "reference_line_end_u",     "reference_line_end_x",
    "reference_line_end_y",      "reference_line_end_z",     "reference_line_end_phi",
    "reference_line_end_b",      "reference_line_end_s",     "reference_line_increment",
    "reference_line_offset_x",   "reference_line_offset_y",  "reference_line_offset_z",
    "reference_line_offset_phi", "long_section_v_right",     "long_section_v_left",
    "long_section_v_increment",  "reference_line_start_lon", "reference_line_start_lat",
    "reference_line_start_alt",  "reference_line_end_lon",   "reference_line_end_lat",
    "reference_line_end_alt"};
const std::vector<std::string> kOptions = {"border_mode_u",
                                           "border_mode_v",
                                           "border_offset_u",
                                           "border_offset_v",
                                           "border_smooth_ubeg",
                                           "border_smooth_uend",
                                           "refline_continuation",
                                           "refline_search_far",
                                           "refline_search_close",
                                           "refline_search_u",
                                           "refline_search_ufrac",
                                           "warn_msgs",
                                           "warn_curv_local",
                                           "warn_curv_global",
                                           "log_msgs",
                                           "log_eval",
                                           "log_eval_freq",
                                           "log_hist",
                                           "log_hist_freq",
                                           "log_stat",
                                           "log_stat_freq",
                                           "check_eps",
                                           "check_inc",
                                           "check_tol",
                                           "check_pro",
                                           "check_wgs"};
const std::vector<std::string> kModifiers = {
    "scale_z_grid",        "scale_slope",         "scale_banking",       "scale_length",
    "scale_width",         "scale_curvature",     "grid_nan_mode",       "grid_nan_offset",
    "refline_rotcenter_x", "refline_rotcenter_y", "refline_offset_phi",  "refline_offset_x",
    "refline_offset_y",    "refline_offset_z",    "refpoint_u_fraction", "refpoint_u_offset",
    "refpoint_u",          "refpoint_v_fraction", "refpoint_v_offset",   "refpoint_v",
    "refpoint_x",          "refpoint_y",          "refpoint_z",          "refpoint_phi"};

// Names of statements of $ROAD_CRG_MPRO: ellipsoids, the transformation between them, the map
// projection. The values of those that end in _nm are names.
const std::vector<std::string> kProjection = {
    "gell_nm", "gell_a",  "gell_b",  "lell_nm", "lell_a",  "lell_b",  "tran_nm",
    "tran_ds", "tran_rx", "tran_ry", "tran_rz", "tran_tx", "tran_ty", "tran_tz",
    "proj_nm", "proj_f0", "proj_p0", "proj_l0", "proj_e0", "proj_n0"};

bool is_globe(std::string_view name) {
  return name.ends_with("_lon") || name.ends_with("_lat") || name.ends_with("_alt");
}

class HeaderReading {
 public:
  HeaderReading(std::string_view bytes, OpenCrgHeader& header) : bytes_(bytes), header_(header) {}

  void run() {
    std::string_view line;
    while (next(line)) {
      if (line.starts_with("$$$$")) {
        header_.data_begin = at_;
        header_.data_line = line_;
        return;
      }
      if (line.starts_with('$') && !is_path(line)) {
        open_section(line);
      } else if (section_ == "$ct") {
        header_.comment.append(line).append("\n");
      } else {
        take(line);
      }
    }
    header_.data_begin = std::string_view::npos;
  }

 private:
  /// States how a statement that occurs a second time is treated.
  enum class Twice { refused, last };

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError({header_.file, line_}, message);
  }

  bool next(std::string_view& line) {
    if (at_ >= bytes_.size()) return false;
    if (at_ == 0) refuse_utf16(bytes_, header_.file);
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    line = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    ++line_;
    if (line_ == 1 && line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.size() > kLongestHeaderLine) fail("is a line of the header too long, expected text");
    if (line.find('\0') != line.npos) fail("has a zero byte before the data, expected text");
    return true;
  }

  /// True for a path in the section $ROAD_CRG_FILE that begins with an environment variable:
  /// $roads/track.crg.
  bool is_path(std::string_view line) const {
    return section_ == "$road_crg_file" && line.size() > 1 && line[1] != '!' &&
           line.find('/') != line.npos && line.find('/') < line.find_first_of(" \t!");
  }

  void open_section(std::string_view line) {
    section_ = section_of(line);
    header_.has_options = header_.has_options || section_ == "$road_crg_opts";
    header_.has_modifiers = header_.has_modifiers || section_ == "$road_crg_mods";
  }

  /// Returns the section that the line begins; "" for a line that ends a section.
  std::string section_of(std::string_view line) const {
    const std::string word = lower(line.substr(0, line.find_first_of(" \t!")));
    if (word == "$") return "";
    static const std::vector<std::string> kSections = {"$ct",
                                                       "$road_crg",
                                                       "$road_crg_mpro",
                                                       "$road_crg_opts",
                                                       "$road_crg_mods",
                                                       "$road_crg_file",
                                                       "$kd_definition"};
    if (std::find(kSections.begin(), kSections.end(), word) != kSections.end()) return word;
    fail("unknown section " + in_quotes(word) + did_you_mean(word, kSections));
  }

  void take(std::string_view line) {
    const std::string_view text = trimmed(line.substr(0, line.find('!')));
    if (text.empty() || text.starts_with('*')) return;
    if (section_ == "$road_crg") return take_value(text, kRoad, header_.road, Twice::refused);
    if (section_ == "$road_crg_opts")
      return take_value(text, kOptions, header_.options, Twice::last);
    if (section_ == "$road_crg_mods")
      return take_value(text, kModifiers, header_.modifiers, Twice::last);
    if (section_ == "$kd_definition") return take_definition(text);
    if (section_ == "$road_crg_mpro") return take_projection(text);
    if (section_ == "$road_crg_file") {
      header_.references.push_back({std::string(text), line_});
      return;
    }
    fail("is " + in_quotes(text) + ", expected a section such as $ROAD_CRG");
  }

  /// Keeps a statement of the map projection as text: it gives the road's position on the globe,
  /// not its shape.
  void take_projection(std::string_view text) {
    const std::size_t middle = text.find('=');
    const std::string name = lower(trimmed(text.substr(0, middle)));
    if (std::find(kProjection.begin(), kProjection.end(), name) == kProjection.end())
      fail("unknown statement " + in_quotes(name) + did_you_mean(name, kProjection));
    const std::string_view value =
        middle == text.npos ? std::string_view() : trimmed(text.substr(middle + 1));
    const bool is_name = name.ends_with("_nm");
    const auto number = parse_number(value);
    if (is_name ? value.empty() : !number || !std::isfinite(*number))
      fail(name + " is " + in_quotes(value) + ", expected a " + (is_name ? "name" : "number"));
    header_.kept.push_back(name + " = " + std::string(value) + " (map projection)");
  }

  void take_value(std::string_view text,
                  const std::vector<std::string>& known,
                  OpenCrgHeader::Values& values,
                  Twice twice) {
    const std::size_t middle = text.find('=');
    const std::string name = lower(trimmed(text.substr(0, middle)));
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      fail("unknown statement " + in_quotes(name) + did_you_mean(name, known));
    }
    const auto number = middle == text.npos ? std::nullopt : number_of(text.substr(middle + 1));
    if (!number || !std::isfinite(*number)) {
      fail(name + " is " +
           in_quotes(middle == text.npos ? std::string_view() : trimmed(text.substr(middle + 1))) +
           ", expected a number");
    }
    const auto [place, first] = values.insert({name, {*number, line_, header_.file}});
    if (first && is_globe(name))
      header_.kept.push_back(name + " = " + std::string(trimmed(text.substr(middle + 1))) +
                             " (WGS 84, does not place the road)");
    if (first && name.starts_with("reference_line_offset_"))
      header_.kept.push_back(name + " = " + format_number(*number) +
                             " (from the road's own axes to those of a map)");
    if (first) return;
    if (twice == Twice::refused) fail(name + " comes twice");
    warn_of_two(name, place->second, *number);
    place->second = {*number, line_, header_.file};
  }

  /// Parses a number. With a warning it also accepts an exponent of 0 whose sign precedes the
  /// letter e, as in a sample of the standard (2.000000000+e00).
  std::optional<double> number_of(std::string_view text) {
    const auto number = parse_number(text);
    const std::size_t wrong = text.find("+e");
    if (number || wrong == text.npos) return number;
    const std::string_view exponent = trimmed(text.substr(wrong + 2));
    if (exponent.empty() || exponent.find_first_not_of('0') != exponent.npos) return std::nullopt;
    const auto before = parse_number(text.substr(0, wrong));
    if (before)
      header_.warnings.push_back(header_.file + ":" + std::to_string(line_) + ": " +
                                 in_quotes(trimmed(text)) + " is taken as " +
                                 format_number(*before));
    return before;
  }

  void warn_of_two(const std::string& name, const OpenCrgHeader::Value& before, double now) {
    header_.warnings.push_back(header_.file + ":" + std::to_string(line_) + ": " + name +
                               " comes a second time: " + format_number(now) + " counts, " +
                               format_number(before.number) + " of line " +
                               std::to_string(before.line) + " does not");
  }

  void take_definition(std::string_view text) {
    if (text.starts_with("#:")) {
      if (!header_.format.empty()) fail("the format #: comes twice");
      header_.format = trimmed(text.substr(2));
      header_.format_line = line_;
    } else if (text.starts_with("D:") || text.starts_with("d:")) {
      if (header_.channels.size() == kMostRoadChannels) fail("has too many channels");
      header_.channels.push_back(channel_of(lower(trimmed(text.substr(2)))));
    } else if (text.starts_with("U:") || text.starts_with("u:")) {
      take_virtual_channel(lower(text.substr(2)));
    } else {
      fail("is " + in_quotes(text) + ", expected #:, D: or U:");
    }
  }

  /// Reads a virtual channel. Such channels serve only programs that plot the data; that of u is
  /// kept, to be compared with the road.
  void take_virtual_channel(const std::string& text) {
    std::vector<std::string_view> parts;
    for (std::string_view rest = text; !rest.empty();) {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      parts.push_back(trimmed(rest.substr(0, comma)));
      rest.remove_prefix(std::min(comma + 1, rest.size()));
    }
    if (parts.size() < 4 || parts[0] != "reference line u") return;
    const auto begin = parse_number(parts[2]), step = parse_number(parts[3]);
    if (begin && step) header_.virtual_u = {*begin, *step, line_};
  }

  OpenCrgHeader::Channel channel_of(const std::string& text) const {
    using Kind = OpenCrgHeader::Channel::Kind;
    const std::size_t comma = text.find(',');
    const std::string unit(trimmed(comma == text.npos ? "" : text.substr(comma + 1)));
    std::string_view name = trimmed(std::string_view(text).substr(0, comma));
    const auto expect_unit = [&](const char* expected) {
      if (unit != expected)
        fail("has unit " + in_quotes(unit) + ", expected " + in_quotes(expected));
    };
    if (name.starts_with("long section")) {
      expect_unit("m");
      name = trimmed(name.substr(std::string_view("long section").size()));
      const bool placed = name.starts_with("at v");
      if (placed) {
        const std::size_t equals = name.find('=');
        name = equals == name.npos ? std::string_view() : trimmed(name.substr(equals + 1));
      }
      const auto number = parse_number(name);
      if (!number || !std::isfinite(*number)) {
        fail("is " + in_quotes(text) +
             R"(, expected "long section 1,m" or "long section at v = -1.5,m")");
      }
      return {placed ? Kind::section_place : Kind::section_number, *number, line_};
    }
    static const std::vector<std::pair<const char*, std::pair<Kind, const char*>>> kLine = {
        {"u", {Kind::u, "m"}},
        {"x", {Kind::x, "m"}},
        {"y", {Kind::y, "m"}},
        {"phi", {Kind::phi, "rad"}},
        {"slope", {Kind::slope, "m/m"}},
        {"banking", {Kind::banking, "m/m"}}};
    for (const auto& [word, meaning] : kLine) {
      if (name != std::string("reference line ") + word) continue;
      expect_unit(meaning.second);
      for (const auto& channel : header_.channels)
        if (channel.kind == meaning.first) fail("channel " + in_quotes(name) + " comes twice");
      return {meaning.first, 0.0, line_};
    }
    fail("is channel " + in_quotes(name) +
         R"(, expected "long section" or "reference line" u, x, y, phi, slope or banking)");
  }

  std::string_view bytes_;
  OpenCrgHeader& header_;
  std::size_t at_ = 0;
  int line_ = 0;
  std::string section_;
};

}  // namespace

bool concerns_surface(std::string_view name) {
  return !is_globe(name) && !name.starts_with("reference_line_offset_") &&
         !name.starts_with("check_") && !name.starts_with("warn_") && !name.starts_with("log_") &&
         !name.starts_with("refline_search_");
}

OpenCrgHeader read_open_crg_header(std::string_view bytes, const std::string& file) {
  OpenCrgHeader header;
  header.file = file;
  HeaderReading(bytes, header).run();
  return header;
}

std::optional<double> OpenCrgHeader::find(const Values& values, std::string_view name) const {
  const auto found = values.find(name);
  if (found == values.end()) return std::nullopt;
  return found->second.number;
}

double OpenCrgHeader::value(const Values& values, std::string_view name, double fallback) const {
  return find(values, name).value_or(fallback);
}

void OpenCrgHeader::reject(const Values& values,
                           std::string_view name,
                           const std::string& message) const {
  const Value& value = values.find(name)->second;
  throw InputError({value.file, value.line},
                   std::string(name) + " is " + format_number(value.number) + ", " + message);
}

}  // namespace latsch::formats
