// SPDX-License-Identifier: Apache-2.0
#include "exchange/package/zip_archive.h"

#include <zlib.h>

#include <stdexcept>

namespace latsch::exchange {
namespace {

// takes a third of the time of level 9; the result is a few percent larger
constexpr int kDeflateLevel = 3;
constexpr std::uint16_t kVersion = 20;   // the first version of the format with deflated files
constexpr std::uint16_t kUnix = 3 << 8;  // system whose file attributes are stated
constexpr std::uint16_t kNamesInUtf8 = 0x800;  // flag
constexpr std::uint16_t kDeflated = 8;
constexpr std::uint16_t kEpoch = (1 << 5) | 1;           // January 1, 1980
constexpr std::uint32_t kReadableFile = 0100644u << 16;  // a regular file that everybody may read
constexpr std::uint64_t kMostBytes = 0xffffffff;         // larger archives are ZIP64
constexpr std::uint32_t kMostFiles = 0xfffe;

/// Returns numbers of these sizes as bytes, the lowest first.
template <class... Number>
std::string little_endian(Number... numbers) {
  std::string bytes;
  const auto append = [&](auto number) {
    for (std::size_t i = 0; i < sizeof number; ++i)
      bytes += static_cast<char>(static_cast<std::uint64_t>(number) >> (8 * i) & 0xff);
  };
  (append(numbers), ...);
  return bytes;
}

/// Returns the bytes deflated, without the header of zlib.
std::string deflated(std::string_view bytes) {
  z_stream stream{};
  constexpr int kRaw = -MAX_WBITS, kMemory = 8;
  if (deflateInit2(&stream, kDeflateLevel, Z_DEFLATED, kRaw, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("the package cannot be made: out of memory");
  std::string result(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  const int status = deflate(&stream, Z_FINISH);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("the package cannot be made: zlib failed");
  return result;
}

}  // namespace

void ZipArchive::add(std::string_view name, std::string_view bytes) {
  const std::uint64_t about = bytes.size() + 2 * name.size() + directory_.size() + 1000;
  if (files_.size() + about > kMostBytes || count_ == kMostFiles || name.size() > 0xffff)
    throw std::runtime_error("the package cannot be made: it would have more than 4 GB");
  const std::string packed = deflated(bytes);
  const auto crc = static_cast<std::uint32_t>(crc32_z(
      0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<z_size_t>(bytes.size())));
  const auto offset = static_cast<std::uint32_t>(files_.size());
  constexpr std::uint16_t kNone = 0;
  const std::string common = little_endian(kVersion,
                                           kNamesInUtf8,
                                           kDeflated,
                                           kNone,  // midnight
                                           kEpoch,
                                           crc,
                                           static_cast<std::uint32_t>(packed.size()),
                                           static_cast<std::uint32_t>(bytes.size()),
                                           static_cast<std::uint16_t>(name.size()),
                                           kNone);  // length of the extra field
  files_ += "PK\x03\x04" + common;
  files_ += name;
  files_ += packed;
  directory_ += "PK\x01\x02" + little_endian(static_cast<std::uint16_t>(kUnix | kVersion)) +
                common +
                little_endian(kNone,  // length of the comment
                              kNone,  // number of the disk
                              kNone,  // internal attributes
                              kReadableFile,
                              offset);
  directory_ += name;
  ++count_;
}

std::string ZipArchive::bytes() const {
  const auto count = static_cast<std::uint16_t>(count_);
  constexpr std::uint16_t kNone = 0;
  return files_ + directory_ + "PK\x05\x06" +
         little_endian(kNone,  // number of the disk
                       kNone,  // number of the directory's disk
                       count,
                       count,
                       static_cast<std::uint32_t>(directory_.size()),
                       static_cast<std::uint32_t>(files_.size()),
                       kNone);  // length of the comment
}

}  // namespace latsch::exchange
