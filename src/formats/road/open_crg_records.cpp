// SPDX-License-Identifier: Apache-2.0
#include "formats/road/open_crg_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/text.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kLine = 80;  // columns of a line of digits, bytes of a line of binary data
constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

class RecordReading {
 public:
  RecordReading(std::string_view bytes, const OpenCrgHeader& header)
      : bytes_(bytes), header_(header) {
    const std::string& format = header.format;
    const auto is = [&](std::size_t at, std::string_view letters) {
      return at < format.size() && letters.find(format[at]) != letters.npos;
    };
    if (format.size() != 4 || !is(0, "LK") || !is(1, "DR") || !is(2, "FB") || format[3] != 'I') {
      throw InputError(
          {header.file, header.format_line},
          "format is " + in_quotes(format) + R"(, expected one such as "LRFI", "KRBI")");
    }
    padded_ = format[0] == 'L';
    double_ = format[1] == 'D';
    digits_ = format[2] == 'F';
  }

  OpenCrgRecords run(std::optional<long> rows) {
    records_.columns = header_.channels.size();
    if (digits_) {
      read_digits();
    } else {
      read_binary(rows);
    }
    if (rows && records_.rows != *rows) {
      throw InputError(
          {header_.file, 0},
          fmt::format(
              "holds {} records, expected {} as the u of the header say", records_.rows, *rows));
    }
    if (records_.rows < 2) {
      throw InputError(
          {header_.file, header_.data_line},
          fmt::format("is followed by {} whole records, expected at least 2", records_.rows));
    }
    return std::move(records_);
  }

 private:
  void read_digits() {
    const std::size_t width = double_ ? 20 : 10;
    std::size_t at = header_.data_begin;
    int line = header_.data_line;
    std::size_t column = 0;
    while (at < bytes_.size()) {
      const std::size_t end = std::min(bytes_.find('\n', at), bytes_.size());
      std::string_view text = bytes_.substr(at, end - at);
      at = end + 1;
      ++line;
      if (text.ends_with('\r')) text.remove_suffix(1);
      if (column == 0 && trimmed(text).empty()) continue;
      const std::size_t left = records_.columns - column;
      // A record begins on a new line, except that a compact record may share a line with the next
      // one.
      std::size_t fields = std::min(kLine / width, left);
      if (!padded_) fields = (text.size() + width - 1) / width;
      if (padded_ && text.size() > fields * width &&
          !trimmed(text.substr(fields * width)).empty()) {
        fail(
            line,
            fmt::format("continues behind column {}, expected {} numbers", fields * width, fields));
      }
      for (std::size_t i = 0; i < fields; ++i) {
        if (text.size() <= i * width) {
          fail(line, fmt::format("has {} numbers, expected {}", i, fields));
        }
        records_.values.push_back(number(text.substr(i * width, width), line));
        if (++column < records_.columns) continue;
        column = 0;
        ++records_.rows;
      }
    }
    if (column != 0) fail(line, "ends within a record: the file is incomplete");
  }

  double number(std::string_view field, int line) const {
    field = trimmed(field);
    if (const auto value = parse_number(field); value && std::isfinite(*value)) return *value;
    if (field.empty() || field.starts_with('*') || field == "NaN" || field == "nan")
      return kMissing;
    std::string plain(field);
    for (char& c : plain)
      if (c == 'D' || c == 'd') c = 'e';
    const auto value = parse_number(plain);
    if (!value || !std::isfinite(*value)) {
      fail(line,
           fmt::format("has {}, expected a number of {} columns, or *missing*",
                       in_quotes(field),
                       double_ ? 20 : 10));
    }
    return *value;
  }

  void read_binary(std::optional<long> rows) {
    const std::size_t size = double_ ? 8 : 4;
    std::size_t record = records_.columns * size;
    if (padded_) record = (record + kLine - 1) / kLine * kLine;
    const std::size_t there =
        (bytes_.size() - std::min(header_.data_begin, bytes_.size())) / record;
    // The last line may be padded, so only the header can state where the data end.
    const std::size_t count = rows ? std::min<std::size_t>(there, *rows) : there;
    records_.rows = static_cast<int>(count);
    records_.values.reserve(count * records_.columns);
    for (std::size_t row = 0; row < count; ++row) {
      const char* from = bytes_.data() + header_.data_begin + row * record;
      for (std::size_t i = 0; i < records_.columns; ++i, from += size) {
        records_.values.push_back(double_ ? big_endian<double, std::uint64_t>(from)
                                          : big_endian<float, std::uint32_t>(from));
        if (std::isinf(records_.values.back())) {
          throw InputError({header_.file, 0},
                           fmt::format("record {} has an infinite number", row + 1));
        }
      }
    }
  }

  template <class Number, class Bits>
  static double big_endian(const char* from) {
    Bits bits = 0;
    for (std::size_t i = 0; i < sizeof(Bits); ++i) {
      bits = static_cast<Bits>(bits << 8) | static_cast<unsigned char>(from[i]);
    }
    return std::bit_cast<Number>(bits);
  }

  [[noreturn]] void fail(int line, const std::string& message) const {
    throw InputError({header_.file, line}, message);
  }

  std::string_view bytes_;
  const OpenCrgHeader& header_;
  bool padded_ = false, double_ = false, digits_ = false;
  OpenCrgRecords records_;
};

}  // namespace

OpenCrgRecords read_open_crg_records(std::string_view bytes,
                                     const OpenCrgHeader& header,
                                     std::optional<long> rows) {
  return RecordReading(bytes, header).run(rows);
}

}  // namespace latsch::formats
