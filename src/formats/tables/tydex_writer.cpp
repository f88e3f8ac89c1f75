// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/tydex_writer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "base/error.h"
#include "base/text.h"
#include "base/units.h"
#include "formats/tables/tydex_file.h"
#include "formats/text/letter_case.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kColumn = 10, kCommentColumn = 30;
constexpr std::size_t kLongestName = 8;  // the format's limit, which leaves two blanks
constexpr const char* kGap = "NOTAVAIL";

/// Our names of channels that have one name of TYDEX in every frame.
const std::map<std::string, std::string, std::less<>>& plain_names() {
  static const std::map<std::string, std::string, std::less<>> names = {
      {"time", "RUNTIME"},
      {"Vx", "LONGVEL"},
      {"speed", "LONGVEL"},
      {"omega", "WHROTSPD"},
      {"alpha", "SLIPANGL"},
      {"wheel_speed", "WHROTSPD"},
      {"gamma", "INCLANGL"},
      {"kappa", "LONGSLIP"},
      {"p", "INFLPRES"},
      {"pressure", "INFLPRES"},
      {"tread", "TRDTEMP"},
      {"road", "TRCKTEMP"},
      {"ambient", "AMBITEMP"},
  };
  return names;
}

/// Returns the name of TYDEX for a force or moment "Fx" .. "Mz" in a frame; "" for any other
/// channel. The longitudinal force in W is FX.
std::string name_of_force(std::string_view channel, std::string frame) {
  constexpr std::array<std::string_view, 6> kForces = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
  const std::string_view axis = channel.substr(0, 2);
  if (std::find(kForces.begin(), kForces.end(), axis) == kForces.end()) return "";
  const std::string_view letter = channel.substr(axis.size());
  if (!letter.empty()) {
    if (letter != "W" && letter != "H" && letter != "C") return "";
    frame = letter;
  }
  if (frame.empty()) return "";
  return axis == "Fx" && frame == "W" ? "FX" : capitals(axis) + frame;
}

bool has_dimension_of(const TydexName& name, const std::string& unit) {
  return !name.si_unit.empty() && Unit::of(name.si_unit).same_dimension(Unit::of(unit));
}

/// Returns capital letters and digits of a channel's name, at most eight, such that neither TYDEX
/// nor the file has the name.
std::string own_name(const std::string& channel, const std::set<std::string>& used) {
  std::string letters;
  for (const char c : capitals(channel))
    if ((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')) letters += c;
  if (letters.empty()) letters = "CHANNEL";
  for (int count = 0;; ++count) {
    const std::string number = count == 0 ? "" : std::to_string(count + 1);
    std::string name = letters.substr(0, kLongestName - number.size()) + number;
    if (!used.contains(name) && !find_tydex_name(name)) return name;
  }
}

std::string in_one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return text;
}

/// Returns a line of header or constants: name, comment and unit in their columns, then the value.
std::string tydex_entry(const std::string& name,
                        const std::string& comment,
                        const std::string& unit,
                        const std::string& value) {
  const std::string about = in_one_line(comment).substr(0, kCommentColumn - 1);
  std::string line = fmt::format("{:<10}{:<30}{:<10}{}", name, about, unit, in_one_line(value));
  line.erase(line.find_last_not_of(' ') + 1);
  return line + '\n';
}

/// Returns the spelling of a unit in the format: "Nm" without blank, "-" for a plain number.
std::string tydex_unit(std::string unit) {
  if (unit == "1") return "-";
  if (unit.starts_with("N m")) unit.erase(1, 1);
  return unit;
}

class TydexWriting {
 public:
  TydexWriting(const TydexRecord& record, TydexDigits digits) : record_(record), digits_(digits) {}

  WrittenTydex run() {
    find_lines();
    for (std::size_t i = 0; i < record_.channels.all().size(); ++i) take_channel(i);
    if (columns_.empty()) throw InputError("a TYDEX file needs a channel; there is none to write");
    std::string& text = result_.text;
    text = "**HEADER\n" + tydex_entry("RELEASE", "Release of TYDEX-Format", "", "1.3");
    text += tydex_entry("MEASID", "Measurement ID", "", known(record_.measurement));
    text += tydex_entry("SUPPLIER", "Data supplier", "", known(record_.supplier));
    text += tydex_entry("DATE", "Date", "", known(record_.date));
    text += tydex_entry("CLCKTIME", "Clocktime", "", kGap);
    text += "**COMMENTS\n";
    for (const std::string& line : record_.comments) text += "! " + in_one_line(line) + "\n";
    text += "**CONSTANTS\n";
    for (const TydexRecord::Constant& constant : record_.constants)
      text += tydex_entry(constant.name, constant.comment, constant.unit, constant.value);
    text += constants_ + "**MEASURCHANNELS\n";
    for (const Column& column : columns_)
      text += tydex_entry(column.name, column.comment, column.unit_text, "1         0         0");
    text += "**MEASURDATA\n";
    write_rows();
    text += "**END\n";
    return std::move(result_);
  }

 private:
  struct Column {
    std::string name, comment, unit_text;
    Unit unit;
    std::vector<double> values;  // SI
  };

  static std::string known(const std::string& text) { return text.empty() ? kGap : text; }

  void find_lines() {
    for (const TydexRecord::Constant& constant : record_.constants)
      constant_names_.insert(constant.name);
    for (const Channel& channel : record_.channels.all())
      lines_ = std::max(lines_, channel.values.size());
  }

  /// Chooses name and unit of a channel.
  void take_channel(std::size_t i) {
    const Channel& channel = record_.channels.all()[i];
    const std::string frame = record_.frames.empty() ? "" : record_.frames[i];
    const std::string unit = record_.units.empty() ? channel.unit : record_.units[i];
    Column column = {"", channel.name, "", Unit::of(unit), channel.values};
    assert(column.unit.same_dimension(Unit::of(channel.unit)));
    if (tydex_unit(unit).size() >= kColumn) {
      result_.left_out.push_back(fmt::format("{} [{}]", channel.name, unit));
      return;
    }
    const bool is_constant = column.values.size() == 1 && lines_ > 1;
    std::set<std::string>& used = is_constant ? constant_names_ : channel_names_;
    const std::string defined = defined_name(channel, frame, used, column);
    column.name = defined.empty() ? own_name(channel.name, used) : defined;
    used.insert(column.name);
    const bool is_angle = column.name == "SLIPANGL" || column.name == "INCLANGL";
    if (is_angle && record_.units.empty()) column.unit = Unit::of("deg");
    column.unit_text = tydex_unit(column.unit.text());
    result_.names.push_back({channel.name, column.name, find_tydex_name(column.name) != nullptr});
    for (double& value : column.values) {
      value += 0.0;  // -0 becomes 0
      if (std::isinf(value))
        throw InputError(channel.name + " has an infinite value, which TYDEX cannot express");
    }
    if (is_constant) {
      constants_ += tydex_entry(
          column.name, column.comment, column.unit_text, text_of(column, column.values.front()));
    } else if (!column.values.empty()) {
      columns_.push_back(std::move(column));
    }
  }

  /// Returns the name that TYDEX defines for a channel; "" if it has none, or if another channel
  /// has it already. Changes comment and values where the definitions differ.
  std::string defined_name(const Channel& channel,
                           const std::string& frame,
                           const std::set<std::string>& used,
                           Column& column) {
    std::string name = name_of_force(channel.name, frame);
    if (name.empty()) {
      const auto plain = plain_names().find(channel.name);
      if (plain != plain_names().end()) name = plain->second;
      if (find_tydex_name(channel.name)) name = channel.name;
    }
    if (channel.name == "loaded_radius") name = height_of(column);
    const TydexName* known = find_tydex_name(name);
    if (!known || used.contains(name) || !has_dimension_of(*known, channel.unit)) {
      if (name == "RL" && !used.contains(name)) return name;
      return "";
    }
    column.comment = known->meaning;
    const std::string axes(known->axes);
    if ((name[0] == 'F' || name[0] == 'M') && !axes.empty() &&
        std::find(result_.axes.begin(), result_.axes.end(), axes) == result_.axes.end())
      result_.axes.push_back(axes);
    return name;
  }

  /// Turns the loaded radius into the height of the wheel center if the inclination is a channel.
  /// Returns its name in the file.
  std::string height_of(Column& column) const {
    const Channel* gamma = record_.channels.find("gamma");
    if (!gamma || gamma->unit != "rad" || gamma->values.size() != column.values.size()) {
      column.comment = "loaded radius, wheel plane";
      return "RL";
    }
    for (std::size_t i = 0; i < column.values.size(); ++i)
      column.values[i] *= std::cos(gamma->values[i]);
    return "DSTGRWHC";
  }

  std::string text_of(const Column& column, double value) const {
    if (std::isnan(value)) return kGap;
    std::string exact = column.unit.exact_number(value);
    return digits_ == TydexDigits::all || exact.size() < kColumn
               ? exact
               : nine_characters(column.unit.from_si(value));
  }

  /// Writes the samples into columns of ten characters, or of thirty if a number needs more.
  void write_rows() {
    std::size_t longest = 0;
    for (const Column& column : columns_) note_rounding(column, longest);
    constexpr std::size_t kWideColumn = 3 * kColumn;  // holds every number, also in a wide unit
    const std::size_t width = longest < kColumn ? kColumn : kWideColumn;
    std::string& text = result_.text;
    for (std::size_t row = 0; row < lines_; ++row) {
      for (const Column& column : columns_)
        text += fmt::format("{:<{}}",
                            row < column.values.size() ? text_of(column, column.values[row]) : kGap,
                            width);
      text.erase(text.find_last_not_of(' ') + 1);
      text += '\n';
    }
  }

  /// Finds the longest number of a channel, and the largest error of its numbers.
  void note_rounding(const Column& column, std::size_t& longest) {
    double largest = 0.0, error = 0.0;
    for (const double value : column.values) {
      if (std::isnan(value)) continue;
      const std::string text = text_of(column, value);
      longest = std::max(longest, text.size());
      largest = std::max(largest, std::abs(value));
      const auto number = split_number(text);
      assert(number);
      error = std::max(error, std::abs(column.unit.to_si(number->number) - value));
    }
    if (largest <= 0.0 || error / largest <= result_.rounding) return;
    result_.rounding = error / largest;
    result_.rounded = column.name;
  }

  const TydexRecord& record_;
  TydexDigits digits_;
  WrittenTydex result_;
  std::set<std::string> constant_names_, channel_names_;
  std::vector<Column> columns_;
  std::string constants_;
  std::size_t lines_ = 0;
};

/// Returns a number with so many digits, without the zeros that lead an exponent.
std::string digits_of(double number, std::chars_format format, int precision) {
  std::array<char, 400> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), number, format, precision).ptr;
  std::string text(buffer.data(), end);
  const std::size_t e = text.find('e');
  if (e == text.npos) return text;
  std::string exponent = text.substr(e + 1);
  const std::string sign = exponent.starts_with('-') ? "-" : "";
  exponent.erase(0, std::min(exponent.find_first_not_of("+-0"), exponent.size() - 1));
  return text.substr(0, e) + "e" + sign + exponent;
}

}  // namespace

std::string nine_characters(double number) {
  assert(std::isfinite(number));
  std::array<char, 32> shortest;
  const auto end = std::to_chars(shortest.data(), shortest.data() + shortest.size(), number).ptr;
  if (end - shortest.data() < static_cast<std::ptrdiff_t>(kColumn)) return {shortest.data(), end};
  std::string best;
  double error = std::numeric_limits<double>::infinity();
  for (const auto format : {std::chars_format::fixed, std::chars_format::scientific})
    for (int precision = kColumn; precision >= 0; --precision) {
      const std::string text = digits_of(number, format, precision);
      if (text.size() >= kColumn) continue;
      double read = 0.0;
      std::from_chars(text.data(), text.data() + text.size(), read);
      if (std::abs(read - number) < error) {
        best = text;
        error = std::abs(read - number);
      }
      break;
    }
  return best;
}

WrittenTydex tydex_text(const TydexRecord& record, TydexDigits digits) {
  return TydexWriting(record, digits).run();
}

std::vector<std::string> remarks_on(const WrittenTydex& written, const std::string& more_digits) {
  std::vector<std::string> remarks;
  if (!written.axes.empty())
    remarks.push_back(fmt::format("Forces on the tire are in axes {}, signs of ISO 8855",
                                  fmt::join(written.axes, ", ")));
  std::vector<std::string> own;
  for (const WrittenTydex::Name& name : written.names)
    if (!name.is_defined) own.push_back(name.channel + " " + name.tydex);
  if (!own.empty())
    remarks.push_back(
        fmt::format("TYDEX defines no name for these channels: {}", fmt::join(own, ", ")));
  if (written.rounding > 0.0)
    remarks.push_back(
        fmt::format("Numbers are rounded to the format's columns of ten characters, by at most "
                    "{:.1g} of the largest value of a channel ({}); {} writes every digit",
                    written.rounding,
                    written.rounded,
                    more_digits));
  if (!written.left_out.empty())
    remarks.push_back(fmt::format("Left out, because the unit is longer than nine characters: {}",
                                  fmt::join(written.left_out, ", ")));
  return remarks;
}

}  // namespace latsch::formats
