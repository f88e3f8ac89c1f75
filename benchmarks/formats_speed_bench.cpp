// SPDX-License-Identifier: Apache-2.0
// Measures how fast recordings of recorders are read on one core: MDF 4 raw, deflated and
// transposed, universal files as text and binary, TDMS channel by channel and interleaved, RPC III,
// and MoTeC logs, from memory to numbers.
//
//   ./bench.sh formats_speed
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "cpu_time.h"
#include "formats/recorders/mdf_file.h"
#include "formats/recorders/motec_file.h"
#include "formats/recorders/rpc_file.h"
#include "formats/recorders/tdms_file.h"
#include "formats/recorders/uff_file.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

constexpr double kMegabyte = 1e6;  // bytes
constexpr std::size_t kChannels = 8;

template <class Number>
void put(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

/// Appends a block of MDF 4 and returns its position.
std::uint64_t block(std::string& file,
                    const char* id,
                    std::initializer_list<std::uint64_t> links,
                    const std::string& data) {
  file.resize((file.size() + 7) / 8 * 8, '\0');
  const std::uint64_t at = file.size();
  file += std::string("##") + id + std::string(4, '\0');
  put<std::uint64_t>(file, 24 + 8 * links.size() + data.size());
  put<std::uint64_t>(file, links.size());
  for (const std::uint64_t link : links) put(file, link);
  file += data;
  return at;
}

/// Returns a number of the signal that is recorded: two sines and a little noise, as a force has.
double signal(std::size_t i, std::size_t channel) {
  const double t = 5e-4 * static_cast<double>(i);
  return 4000.0 + 200.0 * std::sin(30.0 * t + static_cast<double>(channel)) +
         static_cast<double>((i * 2654435761u >> 7) % 64) / 16.0;
}

/// Returns records of a time (8 bytes) and channels of 32-bit numbers.
std::string records(std::size_t count) {
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i) {
    put(bytes, 5e-4 * static_cast<double>(i));
    for (std::size_t k = 0; k < kChannels; ++k) put(bytes, static_cast<float>(signal(i, k)));
  }
  return bytes;
}

constexpr std::size_t kRecord = 8 + 4 * kChannels;  // bytes

std::string deflated(const std::string& plain, bool transposed) {
  std::string turned = plain;
  const std::size_t rows = plain.size() / kRecord;
  if (transposed)
    for (std::size_t i = 0; i < rows * kRecord; ++i)
      turned[i % kRecord * rows + i / kRecord] = plain[i];
  std::string packed(compressBound(turned.size()), '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()),
           &size,
           reinterpret_cast<const Bytef*>(turned.data()),
           turned.size());
  packed.resize(size);
  std::string data = "DT";
  data += static_cast<char>(transposed ? 1 : 0);
  data += '\0';
  put<std::uint32_t>(data, transposed ? kRecord : 0);
  put<std::uint64_t>(data, plain.size());
  put<std::uint64_t>(data, packed.size());
  return data + packed;
}

std::string channel(std::size_t index) {
  std::string data;
  data += static_cast<char>(index == 0 ? 2 : 0);
  data += static_cast<char>(index == 0 ? 1 : 0);
  data += '\4';
  data += '\0';
  put(data, static_cast<std::uint32_t>(index == 0 ? 0 : 4 + 4 * index));
  put<std::uint32_t>(data, index == 0 ? 64 : 32);
  data.resize(72, '\0');
  return data;
}

/// Returns an MDF 4 file with the data block of the given kind, "DT" or "DZ".
std::string mdf_file(std::size_t count, const char* kind, const std::string& data) {
  std::string file = "MDF     4.10    bench   ";
  file.resize(28, '\0');
  put<std::uint16_t>(file, 410);
  file.resize(64 + 104, '\0');
  std::uint64_t next = 0;
  for (std::size_t k = kChannels + 1; k-- > 0;) {
    const auto name = block(file, "TX", {}, fmt::format("channel_{}", k) + '\0');
    next = block(file, "CN", {next, 0, name, 0, 0, 0, 0, 0}, channel(k));
  }
  std::string group;
  put<std::uint64_t>(group, 0);
  put<std::uint64_t>(group, count);
  put<std::uint64_t>(group, 0);
  put<std::uint32_t>(group, kRecord);
  put<std::uint32_t>(group, 0);
  const auto records_at = block(file, "CG", {0, next, 0, 0, 0, 0}, group);
  const auto data_at = block(file, kind, {}, data);
  const auto data_group = block(file, "DG", {0, records_at, data_at, 0}, std::string(8, '\0'));
  std::string header;
  block(header, "HD", {data_group, 0, 0, 0, 0, 0}, std::string(32, '\0'));
  file.replace(64, 104, header);
  return file;
}

/// Returns a universal file with one function of single precision, as text or binary.
std::string uff_file(std::size_t count, bool is_text) {
  const std::string blank(80, ' ');
  std::string numbers;
  for (std::size_t i = 0; i < count; ++i) {
    if (is_text) {
      numbers += fmt::format("{:13.5e}", signal(i, 0));
      if (i % 6 == 5 || i + 1 == count) numbers += '\n';
    } else {
      put(numbers, static_cast<float>(signal(i, 0)));
    }
  }
  std::string file =
      is_text ? "    -1\n    58\n"
              : fmt::format("    -1\n    58b{:6d}{:6d}{:12d}{:12d}\n", 1, 2, 11, numbers.size());
  for (int i = 0; i < 5; ++i) file += "NONE\n";
  file += fmt::format("{:5d}{:10d}{:5d}{:10d} {:10}{:10d}{:4d} {:10}{:10d}{:4d}\n",
                      1,
                      0,
                      0,
                      0,
                      "NONE",
                      1,
                      3,
                      "NONE",
                      0,
                      0);
  file += fmt::format("{:10d}{:10d}{:10d}{:13.5e}{:13.5e}{:13.5e}\n", 2, count, 1, 0.0, 5e-4, 0.0);
  for (const char* unit : {"s", "N", "NONE", "NONE"})
    file += fmt::format("{:10d}{:5d}{:5d}{:5d} {:20} {:20}\n", 0, 0, 0, 0, "NONE", unit);
  return file + numbers + (is_text ? "" : "\n") + "    -1\n";
}

/// Returns a TDMS file of one segment with channels of 32-bit numbers.
std::string tdms_file(std::size_t count, bool is_interleaved) {
  std::string objects;
  const auto put_text = [&](const std::string& text) {
    put(objects, static_cast<std::uint32_t>(text.size()));
    objects += text;
  };
  put(objects, static_cast<std::uint32_t>(kChannels));
  for (std::size_t k = 0; k < kChannels; ++k) {
    put_text(fmt::format("/'rig'/'channel_{}'", k));
    for (const std::uint32_t word : {20u, 9u, 1u}) put(objects, word);
    put<std::uint64_t>(objects, count);
    put<std::uint32_t>(objects, 1);
    put_text("wf_increment");
    put<std::uint32_t>(objects, 10);
    put(objects, 5e-4);
  }
  std::string numbers;
  for (std::size_t i = 0; i < count * kChannels; ++i)
    put(numbers,
        static_cast<float>(is_interleaved ? signal(i / kChannels, i % kChannels)
                                          : signal(i % count, i / count)));
  std::string file = "TDSm";
  put<std::uint32_t>(file, is_interleaved ? 2 + 4 + 8 + 32 : 2 + 4 + 8);
  put<std::uint32_t>(file, 4713);
  put<std::uint64_t>(file, objects.size() + numbers.size());
  put<std::uint64_t>(file, objects.size());
  return file + objects + numbers;
}

/// Returns an RPC III time history of 16-bit integers with groups of `group` samples.
std::string rpc_file(std::size_t groups, std::size_t group) {
  std::string header;
  const auto put_record = [&](const std::string& key, const std::string& value) {
    header +=
        key + std::string(32 - key.size(), '\0') + value + std::string(96 - value.size(), '\0');
  };
  const std::size_t records = 10 + kChannels, blocks = (records + 3) / 4;
  put_record("FORMAT", "BINARY");
  put_record("NUM_HEADER_BLOCKS", std::to_string(blocks));
  put_record("NUM_PARAMS", std::to_string(records));
  put_record("FILE_TYPE", "TIME_HISTORY");
  put_record("DATA_TYPE", "SHORT_INTEGER");
  put_record("DELTA_T", "5.000000E-04");
  put_record("CHANNELS", std::to_string(kChannels));
  put_record("PTS_PER_FRAME", std::to_string(group));
  put_record("PTS_PER_GROUP", std::to_string(group));
  put_record("FRAMES", std::to_string(groups));
  for (std::size_t k = 0; k < kChannels; ++k)
    put_record(fmt::format("SCALE.CHAN_{}", k + 1), "0.25");
  header.resize(512 * blocks, '\0');
  for (std::size_t i = 0; i < groups; ++i)
    for (std::size_t k = 0; k < kChannels; ++k)
      for (std::size_t j = 0; j < group; ++j)
        put(header, static_cast<std::int16_t>(4.0 * signal(i * group + j, k)));
  return header;
}

/// Returns a MoTeC log with channels of 32-bit numbers.
std::string motec_file(std::size_t count) {
  constexpr std::size_t kHead = 2048, kBlock = 124;
  std::string file(kHead, '\0');
  file[0] = 0x40;
  const std::uint32_t first = kHead;
  std::memcpy(file.data() + 8, &first, sizeof(first));
  std::string numbers;
  for (std::size_t k = 0; k < kChannels; ++k) {
    const std::size_t begin = file.size();
    put<std::uint32_t>(file, 0);
    put<std::uint32_t>(file, k + 1 < kChannels ? static_cast<std::uint32_t>(begin + kBlock) : 0);
    put(file, static_cast<std::uint32_t>(kHead + kBlock * kChannels + numbers.size()));
    put(file, static_cast<std::uint32_t>(count));
    for (const int word : {0, 7, 4, 2000, 0, 1, 1, 0}) put(file, static_cast<std::int16_t>(word));
    file += fmt::format("channel_{}", k);
    file.resize(begin + kBlock, '\0');
    for (std::size_t i = 0; i < count; ++i) put(numbers, static_cast<float>(signal(i, k)));
  }
  return file + numbers;
}

using RecordedReader = formats::RecordedFile (*)(std::string_view, std::string);

/// Adds a row with the megabytes of `bytes` read a second: the best of three times.
void measure(const char* what,
             const std::string& file,
             std::size_t bytes,
             std::size_t samples,
             double least,
             RecordedReader read,
             Table& table) {
  double seconds = INFINITY;
  bool is_whole = true;
  for (int i = 0; i < 3; ++i) {
    const double begin = cpu_seconds();
    const formats::RecordedFile recorded = read(file, "bench");
    seconds = std::min(seconds, cpu_seconds() - begin);
    is_whole = is_whole && recorded.groups.front().samples() == samples &&
               recorded.groups.front().channels.back().values.back() > 3000.0;
  }
  table.row(fmt::format("{}: every sample", what), is_whole ? "yes" : "no", "yes", is_whole);
  const double rate = static_cast<double>(bytes) / kMegabyte / seconds;
  table.full_row(
      what, fmt::format("{:.0f} MB/s", rate), fmt::format(">= {:.0f} MB/s", least), rate >= least);
}

int formats_speed(const Options& options) {
  Table table("formats_speed", options);
  const std::size_t count = options.size<std::size_t>(1'500'000, 2'000);
  const std::string plain = records(count);
  measure("MDF 4, raw",
          mdf_file(count, "DT", plain),
          plain.size(),
          count,
          100.0,
          formats::parse_mdf,
          table);
  for (const bool transposed : {false, true})
    measure(transposed ? "MDF 4, transposed and deflated, unpacked bytes"
                       : "MDF 4, deflated, unpacked bytes",
            mdf_file(count, "DZ", deflated(plain, transposed)),
            plain.size(),
            count,
            40.0,
            formats::parse_mdf,
            table);
  const std::string text = uff_file(count, true), binary = uff_file(count, false);
  measure("universal file, text", text, text.size(), count, 15.0, formats::parse_uff, table);
  measure("universal file, binary", binary, binary.size(), count, 100.0, formats::parse_uff, table);
  for (const bool is_interleaved : {false, true}) {
    const std::string tdms = tdms_file(count, is_interleaved);
    measure(is_interleaved ? "TDMS, interleaved" : "TDMS, channel by channel",
            tdms,
            tdms.size(),
            count,
            100.0,
            formats::parse_tdms,
            table);
  }
  constexpr std::size_t kGroup = 1024;
  const std::size_t groups = (count + kGroup - 1) / kGroup;
  const std::string rpc = rpc_file(groups, kGroup), log = motec_file(count);
  measure("RPC III", rpc, rpc.size(), groups * kGroup, 100.0, formats::parse_rpc, table);
  measure("MoTeC", log, log.size(), count, 100.0, formats::parse_motec, table);
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::formats_speed);
}
