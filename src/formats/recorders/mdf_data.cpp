// SPDX-License-Identifier: Apache-2.0
#include "formats/recorders/mdf_data.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <memory>

#include "base/error.h"
#include "base/text.h"
#include "formats/recorders/recorded_file.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kMostUnpackedMdf = std::size_t{1} << 30;  // bytes

/// Unpacks a deflated text. Memory grows with what was unpacked, never by what the file promises.
std::string inflated(std::string_view packed, std::size_t expected, const MdfBlock& block) {
  z_stream stream = {};
  if (inflateInit(&stream) != Z_OK) block.fail("cannot be unpacked");
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, inflateEnd);
  std::string result;
  constexpr std::size_t kStep = std::size_t{1} << 20;  // bytes; later half of what there is
  std::size_t made = 0;
  int state = Z_OK;
  while (state == Z_OK) {
    // zlib counts input in 32 bits
    if (stream.avail_in == 0) {
      const std::size_t part = std::min<std::size_t>(packed.size(), std::size_t{1} << 30);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
      stream.avail_in = static_cast<uInt>(part);
      packed.remove_prefix(part);
    }
    if (made == result.size()) {
      if (made >= expected + 1) break;
      result.resize(std::min(expected + 1, made + std::max(kStep, made / 2)));
    }
    const std::size_t space = std::min<std::size_t>(result.size() - made, std::size_t{1} << 30);
    stream.next_out = reinterpret_cast<Bytef*>(result.data() + made);
    stream.avail_out = static_cast<uInt>(space);
    state = inflate(&stream, Z_NO_FLUSH);
    const std::size_t gained = space - stream.avail_out;
    made += gained;
    if (gained == 0 && stream.avail_in == 0 && packed.empty()) break;
  }
  if (state != Z_STREAM_END || made != expected)
    block.fail(fmt::format("has deflated data that are broken: {} bytes, expected {}{}",
                           made,
                           expected,
                           made > expected ? " and no more" : ""));
  result.resize(made);
  return result;
}

/// Undoes the transposition of `columns` bytes of each record; bytes behind the last whole record
/// were not moved.
std::string turned_back(const std::string& transposed, std::size_t columns) {
  const std::size_t rows = transposed.size() / columns;
  std::string result = transposed;
  // in strips of rows, so that the lines of the result stay in the cache
  constexpr std::size_t kStrip = 512;
  for (std::size_t begin = 0; begin < rows; begin += kStrip)
    for (std::size_t column = 0; column < columns; ++column) {
      const char* from = transposed.data() + column * rows;
      for (std::size_t row = begin; row < std::min(rows, begin + kStrip); ++row)
        result[row * columns + column] = from[row];
    }
  return result;
}

}  // namespace

MdfBytes MdfData::read(std::uint64_t position) {
  MdfBytes bytes;
  if (position == 0) return bytes;
  MdfChain chain;
  take(position, chain, bytes);
  return bytes;
}

void MdfData::take(std::uint64_t position, MdfChain& chain, MdfBytes& bytes) {
  const MdfBlock block = blocks_.at(position, is_unfinished_);
  chain.visit(block);
  if (block.id() == "DT" || block.id() == "DV") {
    used_ += block.data().size();
    if (used_ > blocks_.bytes().size()) block.fail("overlaps other blocks of data");
    append(block.data(), bytes);
  } else if (block.id() == "DZ") {
    unpack(block, bytes);
  } else if (block.id() == "HL") {
    if (block.link(0) != 0) take_list(blocks_.at(block.link(0), "DLLD"), chain, bytes);
  } else if (block.id() == "DL" || block.id() == "LD") {
    take_list(block, chain, bytes);
  } else {
    block.fail("is where data are expected: DT, DV, DZ, DL, LD or HL");
  }
}

void MdfData::take_list(MdfBlock list, MdfChain& chain, MdfBytes& bytes) {
  constexpr std::uint32_t kHasInvalidation = 0x80000000u;
  MdfChain lists;
  for (;;) {
    lists.visit(list);
    std::size_t links = list.link_count();
    if (list.id() == "LD" && (list.number<std::uint32_t>(0) & kHasInvalidation) && links > 1) {
      const std::size_t parts = list.number<std::uint32_t>(4);
      if (parts > links - 1)
        list.fail(fmt::format("states {} blocks and has {} links", parts, links));
      links = parts + 1;
    }
    for (std::size_t i = 1; i < links; ++i)
      if (list.link(i) != 0) {
        const MdfBlock part = blocks_.at(list.link(i), is_unfinished_);
        if (part.id() == "DL" || part.id() == "LD" || part.id() == "HL")
          part.fail("is a list in a list");
        take(list.link(i), chain, bytes);
      }
    if (list.link(0) == 0) return;
    list = blocks_.at(list.link(0), "DLLD");
  }
}

void MdfData::append(std::string_view part, MdfBytes& bytes) {
  if (bytes.in_file.empty() && bytes.copy.empty()) {
    bytes.in_file = part;
    return;
  }
  if (bytes.copy.empty()) bytes.copy = bytes.in_file;
  bytes.copy += part;
}

void MdfData::unpack(const MdfBlock& block, MdfBytes& bytes) {
  const auto kind = block.number<std::uint8_t>(2);
  const auto columns = block.number<std::uint32_t>(4);
  const auto size = block.number<std::uint64_t>(8), packed = block.number<std::uint64_t>(16);
  constexpr std::size_t kHead = 24;
  if (const auto original = block.data().substr(0, 2); original != "DT" && original != "DV")
    block.fail(fmt::format("packs a block {}, expected DT or DV", shown_bytes(original)));
  if (kind > 1) block.fail(fmt::format("is packed by method {}, expected 0 or 1, deflate", kind));
  if (packed > block.data().size() - kHead)
    block.fail(fmt::format(
        "states {} packed bytes where {} are left", packed, block.data().size() - kHead));
  if (size > kMostUnpackedMdf - std::min(unpacked_, kMostUnpackedMdf))
    block.fail("makes the file larger than 1 GiB when unpacked");
  if (kind == 1 && columns == 0) block.fail("is transposed with a record of 0 bytes");
  used_ += packed;
  if (used_ > blocks_.bytes().size()) block.fail("overlaps other blocks of data");
  std::string plain = inflated(block.data().substr(kHead, packed), size, block);
  unpacked_ += plain.size();
  if (kind == 1) plain = turned_back(plain, columns);
  if (bytes.in_file.empty() && bytes.copy.empty()) {
    bytes.copy = std::move(plain);
  } else {
    append(plain, bytes);
  }
}

}  // namespace latsch::formats
