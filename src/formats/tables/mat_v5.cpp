// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/mat_v5.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "base/error.h"
#include "base/text.h"
#include "formats/text/text_encoding.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kHeader = 128;  // bytes
// bytes; limit for the unpacked contents of a file
constexpr std::size_t kMostUnpacked = 512u << 20;
constexpr std::size_t kMostVariables = 100000;
constexpr int kDeepest = 16;
constexpr std::size_t kMostDimensions = 8;

/// Data types of elements, named as in the description of the format.
enum Type : std::uint32_t {
  miINT8 = 1,
  miUINT8 = 2,
  miINT16 = 3,
  miUINT16 = 4,
  miINT32 = 5,
  miUINT32 = 6,
  miSINGLE = 7,
  miDOUBLE = 9,
  miINT64 = 12,
  miUINT64 = 13,
  miMATRIX = 14,
  miCOMPRESSED = 15,
  miUTF8 = 16,
  miUTF16 = 17,
  miUTF32 = 18
};
/// Classes of MATLAB arrays.
enum Class : std::uint32_t {
  mxCELL = 1,
  mxSTRUCT = 2,
  mxOBJECT = 3,
  mxCHAR = 4,
  mxSPARSE = 5,
  mxDOUBLE = 6,
  mxUINT64 = 15
};
constexpr std::uint32_t kComplex = 0x0800;

struct MatElement {
  std::uint32_t type = 0;
  std::string_view contents;
};

class MatReading {
 public:
  explicit MatReading(MatFile& file) : file_(file) {}

  void run(std::string_view bytes) {
    if (bytes.size() < kHeader) fail("is too short for a MAT file of version 5");
    const std::string_view mark = bytes.substr(126, 2);
    if (mark != "IM" && mark != "MI")
      fail("is no MAT file of version 5: its mark of byte order is missing");
    swapped_ = (mark == "MI") == (std::endian::native == std::endian::little);
    bytes.remove_prefix(kHeader);
    while (!bytes.empty()) {
      const MatElement element = next(bytes, /*aligned=*/true);
      if (element.type == miCOMPRESSED) {
        const std::string unpacked = unpack(element.contents);
        std::string_view rest = unpacked;
        const MatElement inner = next(rest, true);
        if (inner.type != miMATRIX) fail("has a compressed element that is no array");
        take_array(inner.contents, "", 0);
      } else if (element.type == miMATRIX) {
        take_array(element.contents, "", 0);
      } else {
        fail(fmt::format("has an element of type {} where an array is expected", element.type));
      }
    }
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError({file_.file, 0}, message);
  }

  template <class Number>
  Number number_at(std::string_view bytes, std::size_t at) const {
    char copy[sizeof(Number)];
    std::memcpy(copy, bytes.data() + at, sizeof(Number));
    if (swapped_) std::reverse(copy, copy + sizeof(Number));
    Number number;
    std::memcpy(&number, copy, sizeof(Number));
    return number;
  }

  /// Returns the element at the beginning of `bytes`, and removes it from `bytes`.
  MatElement next(std::string_view& bytes, bool aligned) const {
    if (bytes.size() < 8) fail("ends within the head of an element");
    const auto first = number_at<std::uint32_t>(bytes, 0);
    // Elements with at most four bytes of data take eight bytes in total.
    if (const std::uint32_t size = first >> 16; size > 0) {
      if (size > 4) fail(fmt::format("has a small element of {} bytes, expected at most 4", size));
      const MatElement element{first & 0xffff, bytes.substr(4, size)};
      bytes.remove_prefix(8);
      return element;
    }
    const std::size_t size = number_at<std::uint32_t>(bytes, 4);
    if (size > bytes.size() - 8) {
      fail(fmt::format("has an element of {} bytes where {} are left", size, bytes.size() - 8));
    }
    const MatElement element{first, bytes.substr(8, size)};
    // Elements begin at multiples of eight bytes, except after compressed ones.
    const std::size_t padded = first == miCOMPRESSED || !aligned ? size : (size + 7) / 8 * 8;
    bytes.remove_prefix(std::min(bytes.size(), 8 + padded));
    return element;
  }

  std::string unpack(std::string_view packed) {
    z_stream stream = {};
    if (inflateInit(&stream) != Z_OK) fail("cannot be unpacked");
    std::string result;
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    int state = Z_OK;
    while (state == Z_OK && result.size() + unpacked_ <= kMostUnpacked) {
      char block[1 << 14];
      stream.next_out = reinterpret_cast<Bytef*>(block);
      stream.avail_out = sizeof(block);
      state = inflate(&stream, Z_NO_FLUSH);
      const std::size_t made = sizeof(block) - stream.avail_out;
      result.append(block, made);
      if (made == 0 && stream.avail_in == 0) break;
    }
    inflateEnd(&stream);
    unpacked_ += result.size();
    if (unpacked_ > kMostUnpacked) fail("is larger than 512 MB when unpacked");
    if (state != Z_STREAM_END) fail("has compressed data that are broken or cut off");
    return result;
  }

  /// Reads an array. It consists of flags, size, name, and then contents that depend on its class.
  void take_array(std::string_view bytes, const std::string& path, int depth) {
    if (bytes.empty()) return;  // an empty cell
    if (depth > kDeepest) fail("has structs in structs deeper than 16");
    const MatElement flags = next(bytes, true);
    if (flags.type != miUINT32 || flags.contents.size() != 8) fail("has an array without flags");
    const auto word = number_at<std::uint32_t>(flags.contents, 0);
    const std::uint32_t kind = word & 0xff;
    MatVariable variable;
    variable.size = size_of(next(bytes, true));
    const MatElement name = next(bytes, true);
    variable.name = path.empty() ? std::string(name.contents.substr(0, 63)) : path;
    if (kind == mxSTRUCT) return take_struct(bytes, variable, depth);
    if (kind == mxCELL) return take_cells(bytes, variable, depth);
    if ((word & kComplex) || (kind != mxCHAR && (kind < mxDOUBLE || kind > mxUINT64))) {
      file_.left_out.push_back(printable(variable.name));
      return;
    }
    const MatElement data = next(bytes, true);
    const std::vector<double> values = data.type == miUTF8 ? characters(data) : numbers(data);
    if (values.size() != count(variable)) {
      fail(in_quotes(variable.name) +
           fmt::format(" has {} numbers, expected {}", values.size(), count(variable)));
    }
    if (kind == mxCHAR) {
      variable.is_text = true;
      variable.text = text_of(values, variable.size);
    } else {
      variable.values = values;
    }
    add(std::move(variable));
  }

  void add(MatVariable variable) {
    variable.name = printable(variable.name);
    if (file_.variables.size() == kMostVariables) fail("has more than 100,000 variables");
    file_.variables.push_back(std::move(variable));
  }

  /// Returns the name; characters other than ASCII are damage and are replaced.
  static std::string printable(std::string name) {
    for (char& c : name)
      if (static_cast<unsigned char>(c) < 0x21 || static_cast<unsigned char>(c) > 0x7e) c = '?';
    return name;
  }

  std::vector<std::size_t> size_of(const MatElement& element) const {
    const std::size_t dimensions = element.contents.size() / 4;
    if (element.type != miINT32 || dimensions < 2 || dimensions > kMostDimensions) {
      fail("has an array without a size");
    }
    std::vector<std::size_t> size;
    double product = 1.0;
    for (std::size_t i = 0; i < dimensions; ++i) {
      const auto length = number_at<std::int32_t>(element.contents, 4 * i);
      if (length < 0) fail(fmt::format("has an array of length {}", length));
      size.push_back(length);
      product *= std::max(length, 1);
    }
    if (product > 1e9) fail("has an array of more than 1e9 numbers");
    return size;
  }

  static std::size_t count(const MatVariable& variable) {
    std::size_t product = 1;
    for (const std::size_t length : variable.size) product *= length;
    return product;
  }

  template <class Number>
  std::vector<double> numbers_as(std::string_view bytes) const {
    std::vector<double> values(bytes.size() / sizeof(Number));
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = static_cast<double>(number_at<Number>(bytes, i * sizeof(Number)));
    }
    return values;
  }

  /// Returns the character codes of UTF-8 text.
  static std::vector<double> characters(const MatElement& element) {
    std::vector<double> codes;
    for (std::string_view rest = element.contents; !rest.empty();) {
      const std::string_view character = columns_of(rest, 0, 1);
      const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
      const bool two = character.size() == 2 && byte(0) >= 0xc0;
      codes.push_back(character.size() == 1 ? byte(0)
                      : two                 ? (byte(0) & 0x1f) << 6 | (byte(1) & 0x3f)
                                            : 0xfffd);
      rest.remove_prefix(character.size());
    }
    return codes;
  }

  std::vector<double> numbers(const MatElement& element) const {
    switch (element.type) {
      case miINT8:
        return numbers_as<std::int8_t>(element.contents);
      case miUINT8:
        return numbers_as<std::uint8_t>(element.contents);
      case miINT16:
        return numbers_as<std::int16_t>(element.contents);
      case miUINT16:
      case miUTF16:
        return numbers_as<std::uint16_t>(element.contents);
      case miINT32:
        return numbers_as<std::int32_t>(element.contents);
      case miUINT32:
      case miUTF32:
        return numbers_as<std::uint32_t>(element.contents);
      case miSINGLE:
        return numbers_as<float>(element.contents);
      case miDOUBLE:
        return numbers_as<double>(element.contents);
      case miINT64:
        return numbers_as<std::int64_t>(element.contents);
      case miUINT64:
        return numbers_as<std::uint64_t>(element.contents);
      default:
        fail(fmt::format("has numbers of type {}, which is unknown", element.type));
    }
  }

  /// Returns the text, with one line for each row of the character array. Only characters below
  /// U+0800, which include Latin and Greek, occur.
  static std::string text_of(const std::vector<double>& codes,
                             const std::vector<std::size_t>& size) {
    std::string text;
    const std::size_t rows = std::max<std::size_t>(size[0], 1);
    for (std::size_t row = 0; row < size[0]; ++row) {
      if (row > 0) text += '\n';
      for (std::size_t i = row; i < codes.size(); i += rows) {
        const auto code =
            static_cast<unsigned>(codes[i] < 0x800 && codes[i] >= 0x20 ? codes[i] : '?');
        if (code < 0x80) {
          text += static_cast<char>(code);
        } else {
          text += static_cast<char>(0xc0 | (code >> 6));
          text += static_cast<char>(0x80 | (code & 0x3f));
        }
      }
    }
    return text;
  }

  void take_struct(std::string_view bytes, const MatVariable& owner, int depth) {
    const MatElement length = next(bytes, true);
    if (length.type != miINT32 || length.contents.size() != 4) fail("has a struct without fields");
    const auto width = number_at<std::int32_t>(length.contents, 0);
    const MatElement names = next(bytes, true);
    if (width <= 0 || width > 64) fail(fmt::format("has names of fields of {} bytes", width));
    const std::size_t fields = names.contents.size() / width;
    const std::size_t members = count(owner);
    for (std::size_t k = 0; k < members && fields > 0; ++k) {
      const std::string stem = members == 1 ? owner.name : fmt::format("{}({})", owner.name, k + 1);
      for (std::size_t field = 0; field < fields; ++field) {
        std::string_view name = names.contents.substr(field * width, width);
        name = name.substr(0, name.find('\0'));
        take_member(bytes, stem + "." + std::string(name), depth);
      }
    }
  }

  void take_cells(std::string_view bytes, const MatVariable& owner, int depth) {
    for (std::size_t k = 0; k < count(owner); ++k) {
      take_member(bytes, fmt::format("{}{{{}}}", owner.name, k + 1), depth);
    }
  }

  /// Every member must occupy bytes of the file, so that a large size in a damaged header cannot
  /// make the loop long.
  void take_member(std::string_view& bytes, const std::string& path, int depth) {
    if (bytes.empty()) fail(in_quotes(path) + " is missing: the file is cut off");
    const MatElement member = next(bytes, true);
    if (member.type != miMATRIX) fail(in_quotes(path) + " is no array");
    take_array(member.contents, path, depth + 1);
  }

  MatFile& file_;
  bool swapped_ = false;
  std::size_t unpacked_ = 0;
};

}  // namespace

void read_mat_v5(std::string_view bytes, MatFile& file) { MatReading(file).run(bytes); }

}  // namespace latsch::formats
