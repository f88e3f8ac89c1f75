// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal/journal_pages.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

namespace latsch {
namespace {

using journal_format::Row;

constexpr std::size_t kFileHeader = 100;
constexpr std::size_t kLogHeader = 32;
constexpr std::size_t kFrameHeader = 24;
constexpr std::size_t kUsualPage = 4096;
constexpr std::uint64_t kLargestRow = std::uint64_t{1} << 30;

std::uint32_t big_endian(std::string_view bytes, std::size_t at, std::size_t size = 4) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  }
  return value;
}

bool is_page_size(std::size_t size) {
  return size >= 512 && size <= 65536 && (size & (size - 1)) == 0;
}

std::size_t page_size_of(const std::string& database) {
  if (database.size() < kFileHeader) return kUsualPage;
  const std::size_t written = big_endian(database, 16, 2);
  const std::size_t size = written == 1 ? 65536 : written;
  return is_page_size(size) ? size : kUsualPage;
}

/// Pages of the file by their number, counted from 1.
using Pages = std::map<std::uint32_t, std::string_view>;

Pages pages_of(const std::string& database, std::size_t page_size) {
  Pages pages;
  for (std::size_t at = 0; at + page_size <= database.size(); at += page_size) {
    pages[static_cast<std::uint32_t>(at / page_size + 1)] =
        std::string_view(database).substr(at, page_size);
  }
  return pages;
}

/// Reads SQLite's integers of variable length: seven bits per byte, high bits first; a ninth byte
/// contributes all of its eight bits.
struct Cursor {
  std::string_view bytes;
  std::size_t at;
  bool ok = true;

  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int i = 0; i < 9; ++i) {
      if (at >= bytes.size()) break;
      const auto byte = static_cast<unsigned char>(bytes[at++]);
      if (i == 8) return value << 8 | byte;
      value = value << 7 | (byte & 0x7Fu);
      if (byte < 0x80) return value;
    }
    ok = false;
    return 0;
  }
};

/// Lengths of the columns of a row of the table `trials`. The row number is stored before the
/// record.
struct Shape {
  std::size_t header, point, outcome, finished, content, hash;
};

std::optional<std::size_t> integer_size(std::uint64_t type) {
  static constexpr std::array<std::size_t, 10> kSizes{0, 1, 2, 3, 4, 6, 8, 0, 0, 0};
  if (type == 0 || type == 7 || type > 9) return std::nullopt;
  return kSizes[type];
}

std::optional<Shape> shape_of(std::string_view record) {
  Cursor cursor{record, 0};
  const std::uint64_t header = cursor.varint();
  std::array<std::uint64_t, 6> types{};
  for (std::uint64_t& type : types) type = cursor.varint();
  if (!cursor.ok || cursor.at != header) return std::nullopt;
  const auto is_blob = [](std::uint64_t type) { return type >= 12 && type % 2 == 0; };
  const bool text = types[3] >= 13 && types[3] % 2 == 1;
  const auto content = integer_size(types[4]);
  const auto hash = integer_size(types[5]);
  if (types[0] != 0 || !is_blob(types[1]) || !is_blob(types[2]) || !text || !content || !hash) {
    return std::nullopt;
  }
  return Shape{
      header, (types[1] - 12) / 2, (types[2] - 12) / 2, (types[3] - 13) / 2, *content, *hash};
}

std::int64_t read_integer(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  }
  const unsigned unused = static_cast<unsigned>(64 - 8 * size);
  return size == 0 ? 0 : static_cast<std::int64_t>(value << unused) >> unused;
}

/// Returns how many bytes of a record of the given size lie on the page of the row itself; a page
/// has `usable` bytes.
std::size_t local_size(std::uint64_t size, std::size_t usable) {
  const std::size_t most = usable - 35;
  if (size <= most) return size;
  const std::size_t least = (usable - 12) * 32 / 255 - 23;
  const std::size_t fitting = least + (size - least) % (usable - 4);
  return fitting <= most ? fitting : least;
}

/// Returns the record that begins at `at`, with its tail from the overflow pages.
std::optional<std::string> gather(const Pages& pages,
                                  std::string_view page,
                                  std::size_t at,
                                  std::uint64_t size) {
  const std::size_t local = local_size(size, page.size());
  if (at + local + (local < size ? 4 : 0) > page.size()) return std::nullopt;
  std::string record(page.substr(at, local));
  std::uint32_t next = local < size ? big_endian(page, at + local) : 0;
  while (record.size() < size) {
    const auto overflow = pages.find(next);
    if (overflow == pages.end()) return std::nullopt;
    const std::size_t rest = size - record.size();
    record += overflow->second.substr(4, std::min(rest, overflow->second.size() - 4));
    next = big_endian(overflow->second, 0);
  }
  return record;
}

std::optional<Row> row_at(const Pages& pages, std::string_view page, std::size_t at) {
  Cursor cursor{page, at};
  const std::uint64_t size = cursor.varint();
  const std::uint64_t number = cursor.varint();
  if (!cursor.ok || size > kLargestRow || number == 0) return std::nullopt;
  const auto shape = shape_of(page.substr(cursor.at));
  if (!shape || shape->header + shape->point + shape->outcome + shape->finished + shape->content +
                        shape->hash !=
                    size) {
    return std::nullopt;
  }
  const auto record = gather(pages, page, cursor.at, size);
  if (!record) return std::nullopt;
  std::size_t from = shape->header;
  const auto take = [&](std::size_t length) {
    from += length;
    return record->substr(from - length, length);
  };
  Row row{static_cast<std::int64_t>(number),
          take(shape->point),
          take(shape->outcome),
          take(shape->finished)};
  row.content = read_integer(*record, from, shape->content);
  row.hash = read_integer(*record, from + shape->content, shape->hash);
  if (row.content != journal_format::stored(row.own_hash())) return std::nullopt;
  return row;
}

void find_rows(const Pages& pages, std::map<std::int64_t, Row>& rows) {
  for (const auto& [number, page] : pages) {
    for (std::size_t at = 0; at < page.size(); ++at) {
      if (auto row = row_at(pages, page, at)) rows.emplace(row->number, std::move(*row));
    }
  }
}

/// Visits the pages of the write-ahead log that were written since its present header. Pages of an
/// older header may follow them.
template <class Visit>
void for_each_frame(const std::string& log, const Visit& visit) {
  if (log.size() < kLogHeader) return;
  const std::size_t page_size = big_endian(log, 8);
  if (!is_page_size(page_size)) return;
  const std::string_view salt = std::string_view(log).substr(16, 8);
  for (std::size_t at = kLogHeader; at + kFrameHeader + page_size <= log.size();
       at += kFrameHeader + page_size) {
    const std::string_view frame = std::string_view(log).substr(at, kFrameHeader + page_size);
    if (frame.substr(8, 8) == salt) visit(frame);
  }
}

struct Checksum {
  std::uint32_t s0 = 0, s1 = 0;
  bool big = false;  // true if checksums are big-endian, which the magic number states

  void add(std::string_view bytes) {
    for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
      s0 += word(bytes, at) + s1;
      s1 += word(bytes, at + 4) + s0;
    }
  }
  std::uint32_t word(std::string_view bytes, std::size_t at) const {
    const std::uint32_t value = big_endian(bytes, at);
    return big ? value : __builtin_bswap32(value);
  }
};

}  // namespace

std::vector<Row> rows_on_pages(const std::string& database, const std::string& log) {
  std::map<std::int64_t, Row> rows;
  Pages pages = pages_of(database, page_size_of(database));
  find_rows(pages, rows);
  // Rows are then searched on all pages of the log as well, whether damaged or not, in place of
  // those of the file.
  Pages with_log = pages;
  for_each_frame(log, [&](std::string_view frame) {
    with_log[big_endian(frame, 0)] = frame.substr(kFrameHeader);
  });
  if (!log.empty()) find_rows(with_log, rows);
  std::vector<Row> sorted;
  for (auto& [number, row] : rows) sorted.push_back(std::move(row));
  return sorted;
}

LogState check_log(const std::string& log) {
  LogState state;
  if (log.size() < kLogHeader) return state;
  Checksum sum{.big = (big_endian(log, 0) & 1u) != 0};
  sum.add(std::string_view(log).substr(0, 24));
  bool intact = sum.s0 == big_endian(log, 24) && sum.s1 == big_endian(log, 28);
  for_each_frame(log, [&](std::string_view frame) {
    ++state.frames;
    sum.add(frame.substr(0, 8));
    sum.add(frame.substr(kFrameHeader));
    intact = intact && sum.s0 == big_endian(frame, 16) && sum.s1 == big_endian(frame, 20);
    state.intact += intact;
  });
  return state;
}

}  // namespace latsch
