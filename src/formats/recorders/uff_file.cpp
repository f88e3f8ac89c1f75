// SPDX-License-Identifier: Apache-2.0
#include "formats/recorders/uff_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "formats/recorders/uff_channels.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kLeastBytes = 1;  // a number in a text has one digit at least
constexpr std::size_t kHeadLines = 11;  // lines of a data set 58 behind its number
constexpr std::size_t kMostSets = 100000;

class UffReading {
 public:
  UffReading(std::string_view bytes, RecordedFile& file)
      : bytes_(bytes), file_(file), budget_(file.file, bytes.size()), channels_(file, budget_) {}

  void run() {
    std::string_view line;
    std::size_t sets = 0;
    while (next(line)) {
      if (trimmed(line).empty()) continue;
      if (!is_mark(line))
        fail(fmt::format("is {}, expected \"    -1\", which begins a data set", shown_bytes(line)));
      if (++sets > kMostSets) fail(fmt::format("has more than {} data sets", kMostSets));
      take_set();
    }
    for (UffFunction& function : functions_) channels_.add(function);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { fail_at(line_, message); }
  [[noreturn]] void fail_at(int line, const std::string& message) const {
    throw InputError({file_.file, line}, message);
  }

  bool next(std::string_view& line) {
    if (at_ >= bytes_.size()) return false;
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    line = bytes_.substr(at_, end - at_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    at_ = std::min(end + 1, bytes_.size());
    ++line_;
    return true;
  }

  std::string_view expect_line(const char* what) {
    std::string_view line;
    if (!next(line)) fail(fmt::format("ends before {}: the file is cut off", what));
    if (is_mark(line)) fail(fmt::format("ends the data set before {}", what));
    return line;
  }

  static bool is_mark(std::string_view line) { return trimmed(line) == "-1"; }

  std::string_view field(std::string_view line, std::size_t from, std::size_t width) const {
    return from < line.size() ? trimmed(line.substr(from, width)) : std::string_view();
  }

  long integer(std::string_view line, std::size_t from, std::size_t width, const char* what) const {
    std::string_view text = field(line, from, width);
    if (text.empty()) return 0;
    long value = 0;
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      fail(fmt::format("has {} in columns {} to {}, expected an integer, {}",
                       shown_bytes(text),
                       from + 1,
                       from + width,
                       what));
    return value;
  }

  double number(std::string_view line,
                std::size_t from,
                std::size_t width,
                const char* what) const {
    const std::string_view text = field(line, from, width);
    std::vector<double> one;
    if (text.empty()) return 0.0;
    if (!take_uff_line(text, {width}, 1, one) || !std::isfinite(one[0]))
      fail(fmt::format("has {} in columns {} to {}, expected {}",
                       shown_bytes(text),
                       from + 1,
                       from + width,
                       what));
    return one[0];
  }

  void take_set() {
    std::string_view line;
    if (!next(line)) fail("ends behind the beginning of a data set: the file is cut off");
    if (is_mark(line)) return;  // an empty data set, or two marks in one place
    const bool is_binary = line.size() > 6 && (line[6] == 'b' || line[6] == 'B');
    const long type = integer(line, 0, 6, "the number of the data set");
    if (type == 58) return is_binary ? take_binary(line) : take_text();
    if (is_binary) fail(fmt::format("is a binary data set {}, of which only 58 is read", type));
    if (type == 151) return take_header();
    if (type == 164) return take_units();
    if (type == 15 || type == 2411) return take_points(type);
    const int first = line_;
    while (next(line))
      if (is_mark(line)) {
        if (++skipped_[type] == 1)
          file_.facts.push_back(fmt::format("data set {} is not read (line {})", type, first));
        return;
      }
    fail_at(first, fmt::format("begins data set {}, which has no end", type));
  }

  void take_header() {
    std::string_view line;
    for (int i = 0; next(line) && !is_mark(line); ++i)
      if (const auto text = recorded_text(line, file_.file); i < 2 && !text.empty())
        file_.facts.push_back(text);
  }

  /// Reads the factors by which numbers of the file are divided to get SI units.
  void take_units() {
    expect_line("the code of the units");
    std::vector<double> factors;
    std::string_view line;
    while (next(line) && !is_mark(line))
      for (std::size_t i = 0; i < 3 && factors.size() < 4; ++i)
        if (!field(line, 25 * i, 25).empty())
          factors.push_back(number(line, 25 * i, 25, "a factor of a unit"));
    if (factors.size() < 2 || !(factors[0] > 0.0) || !(factors[1] > 0.0))
      fail("ends data set 164 without factors of length and force above 0");
    channels_.set_units(factors[0], factors[1]);
  }

  void take_points(long type) {
    std::string_view line;
    while (next(line) && !is_mark(line)) {
      const long label = integer(line, 0, 10, "the label of a point");
      UffPoint point;
      if (type == 15) {
        point = {number(line, 40, 13, "x"), number(line, 53, 13, "y"), number(line, 66, 13, "z")};
      } else {
        const std::string_view place = expect_line("the coordinates of a point");
        point = {number(place, 0, 25, "x"), number(place, 25, 25, "y"), number(place, 50, 25, "z")};
      }
      channels_.set_point(label, point);
    }
  }

  UffAxis axis(std::string_view line) const {
    UffAxis axis;
    axis.quantity = integer(line, 0, 10, "the kind of quantity");
    axis.label = text_of(line, 26);
    axis.unit = text_of(line, 47);
    return axis;
  }

  /// Returns a text of 20 characters; empty if it is NONE.
  std::string text_of(std::string_view line, std::size_t from) const {
    const std::string text = recorded_text(field(line, from, 20), file_.file);
    return text == "NONE" || text == "none" ? std::string() : text;
  }

  UffFunction head() {
    UffFunction function;
    for (int i = 0; i < 5; ++i) {
      const std::string text = recorded_text(expect_line("the five lines of text"), file_.file);
      if (i == 0 && text != "NONE") function.title = text;
    }
    const std::string_view dof = expect_line("the degrees of freedom");
    function.line = line_;
    function.kind = integer(dof, 0, 5, "the type of the function");
    function.point = integer(dof, 41, 10, "the response's point");
    function.direction = integer(dof, 51, 4, "the response's direction");
    function.reference_point = integer(dof, 66, 10, "the reference's point");
    function.reference_direction = integer(dof, 76, 4, "the reference's direction");
    const std::string_view form = expect_line("the form of the numbers");
    const long type = integer(form, 0, 10, "the type of the numbers");
    if (type != 2 && type != 4 && type != 5 && type != 6)
      fail(
          fmt::format("has numbers of type {}, expected 2, 4, 5 or 6: real or complex, in single "
                      "or double precision",
                      type));
    function.layout.is_double = type == 4 || type == 6;
    function.layout.is_complex = type >= 5;
    const long samples = integer(form, 10, 10, "the number of samples");
    if (samples < 0) fail(fmt::format("states {} samples, expected 0 or more", samples));
    function.samples = static_cast<std::size_t>(samples);
    expect_room(function.samples, kLeastBytes);
    function.layout.is_even = integer(form, 20, 10, "1 for an even abscissa") != 0;
    function.first = number(form, 30, 13, "the first abscissa");
    function.step = number(form, 43, 13, "the step of the abscissa");
    if (function.layout.is_even && samples > 1 && !(function.step > 0.0))
      fail(fmt::format("has a step of the abscissa of {:g}, expected a number above 0",
                       function.step));
    function.abscissa = axis(expect_line("the abscissa"));
    function.ordinate = axis(expect_line("the ordinate"));
    function.denominator = axis(expect_line("the denominator"));
    expect_line("the third axis");
    return function;
  }

  /// Throws if the samples need more bytes than are left in the file.
  void expect_room(std::size_t samples, std::size_t bytes_each) const {
    const std::size_t left = bytes_.size() - std::min(at_, bytes_.size());
    if (samples > left / bytes_each)
      fail(
          fmt::format("states {} samples, which are {:.0f} bytes or more, but {} bytes are left: "
                      "the file is cut off",
                      samples,
                      static_cast<double>(samples) * static_cast<double>(bytes_each),
                      left));
  }

  void take_text() {
    UffFunction function = head();
    const std::size_t wanted = function.samples * function.layout.per_sample();
    expect_room(function.samples, function.layout.per_sample() * kLeastBytes);
    budget_.take(wanted);
    function.numbers.reserve(wanted);
    const std::vector<std::size_t> widths = function.layout.widths();
    while (function.numbers.size() < wanted) {
      const std::string_view line = expect_line("all its numbers");
      if (!take_uff_line(line, widths, wanted - function.numbers.size(), function.numbers))
        fail(fmt::format("is {}, expected {} numbers",
                         shown_bytes(line),
                         std::min(widths.size(), wanted - function.numbers.size())));
    }
    expect_end(function);
    functions_.push_back(std::move(function));
  }

  void expect_end(const UffFunction& function) {
    std::string_view line;
    while (next(line) && trimmed(line).empty()) continue;
    if (!is_mark(line))
      fail(fmt::format("follows the {} samples of the function, expected \"    -1\"",
                       function.samples));
  }

  void take_binary(std::string_view first) {
    const long order = integer(first, 7, 6, "the order of the bytes");
    const long format = integer(first, 13, 6, "the format of the numbers");
    const long lines = integer(first, 19, 12, "the number of lines before the numbers");
    const long stated = integer(first, 31, 12, "the number of bytes");
    if (order != 1 && order != 2)
      fail(fmt::format("has order of bytes {}, expected 1 (little-endian) or 2 (big-endian)",
                       order));
    if (format != 2)
      fail(
          fmt::format("has numbers of format {}, expected 2 (IEEE 754); 1 is that of VAX", format));
    if (lines < static_cast<long>(kHeadLines) || static_cast<std::size_t>(lines) > bytes_.size())
      fail(fmt::format(
          "states {} lines before the numbers, expected {} or more", lines, kHeadLines));
    UffFunction function = head();
    for (long i = static_cast<long>(kHeadLines); i < lines; ++i) expect_line("the numbers");
    bool is_short = false;
    const std::size_t size = binary_size(function, stated, is_short);
    budget_.take(function.samples * function.layout.per_sample());
    function.numbers = uff_binary(
        bytes_.substr(at_, size), function.layout, function.samples, order == 2, is_short);
    at_ += size;
    expect_end_of_binary(function);
    functions_.push_back(std::move(function));
  }

  /// Returns the number of bytes of a function's numbers: behind them the data set must end.
  std::size_t binary_size(const UffFunction& function, long stated, bool& is_short) const {
    const std::size_t left = bytes_.size() - std::min(at_, bytes_.size());
    std::size_t least = 0;
    for (const bool try_short : {false, true}) {
      const std::size_t each = uff_sample_bytes(function.layout, try_short);
      if (function.samples > left / each) continue;
      const std::size_t size = each * function.samples;
      least = std::max(least, size);
      if (!ends_at(at_ + size)) continue;
      is_short = try_short;
      return size;
    }
    if (least == 0) expect_room(function.samples, uff_sample_bytes(function.layout, true));
    fail(
        fmt::format("states {} bytes for {} samples, but no end of the data set follows their "
                    "numbers: the file is cut off",
                    stated,
                    function.samples));
  }

  /// True if the mark that ends a data set is here, behind line ends and blanks.
  bool ends_at(std::size_t at) const {
    constexpr std::size_t kMostBlanks = 16;
    const std::string_view rest = bytes_.substr(at, kMostBlanks);
    return trimmed(rest.substr(0, rest.find("-1") == rest.npos ? 0 : rest.find("-1"))).empty() &&
           rest.find("-1") != rest.npos;
  }

  void expect_end_of_binary(const UffFunction& function) {
    std::string_view line;
    while (next(line) && trimmed(line).empty()) continue;
    if (!is_mark(line))
      fail(fmt::format("follows the {} samples of the function, expected \"    -1\"",
                       function.samples));
  }

  std::string_view bytes_;
  RecordedFile& file_;
  NumberBudget budget_;
  UffChannels channels_;
  std::size_t at_ = 0;
  int line_ = 0;
  std::map<long, int> skipped_;
  std::vector<UffFunction> functions_;
};

}  // namespace

RecordedFile parse_uff(std::string_view bytes, std::string file) {
  RecordedFile result;
  result.file = std::move(file);
  result.kind = "Universal file (data set 58)";
  UffReading(bytes, result).run();
  for (RecordedGroup& group : result.groups)
    for (RecordedChannel& channel : group.channels)
      for (double& value : channel.values)
        if (!std::isfinite(value)) value = std::nan("");
  check_recorded(result);
  return result;
}

}  // namespace latsch::formats
