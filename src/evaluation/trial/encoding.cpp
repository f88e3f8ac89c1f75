// SPDX-License-Identifier: Apache-2.0
#include "evaluation/trial/encoding.h"

#include <bit>
#include <cstring>
#include <vector>

namespace latsch {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie");

template <class T>
void put(std::string& bytes, const T& number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void put_text(std::string& bytes, std::string_view text) {
  put(bytes, static_cast<std::uint64_t>(text.size()));
  bytes.append(text);
}

void put_numbers(std::string& bytes, const std::vector<double>& numbers) {
  put(bytes, static_cast<std::uint64_t>(numbers.size()));
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double));
}

/// Reads encoded values from the front of `rest`. If a count or number is missing, ok becomes
/// false.
struct Reader {
  std::string_view rest;
  bool ok = true;

  const char* take(std::uint64_t count, std::size_t size) {
    if (!ok || count > rest.size() / size) {
      ok = false;
      return nullptr;
    }
    const char* front = rest.data();
    rest.remove_prefix(count * size);
    return front;
  }

  template <class T>
  T number() {
    T value{};
    if (const char* front = take(1, sizeof value)) std::memcpy(&value, front, sizeof value);
    return value;
  }

  std::string text() {
    const auto size = number<std::uint64_t>();
    const char* front = take(size, 1);
    return front ? std::string(front, size) : std::string();
  }

  std::vector<double> numbers() {
    const auto size = number<std::uint64_t>();
    const char* front = take(size, sizeof(double));
    std::vector<double> values(front ? size : 0);
    if (!values.empty()) std::memcpy(values.data(), front, size * sizeof(double));
    return values;
  }

  bool finished() const { return ok && rest.empty(); }
};

// Kind of an encoded outcome: channels, or a failure by its cause. Journals of format 1, which
// stored no causes, have only the first two kinds.
enum Kind : std::uint8_t {
  kPoint = 0,
  kChannels = 1,
  kTimeout = 2,
  kBadOutput = 3,
  kTransient = 4,
  kNotBegun = 5,
  // This bit is added to the kind if the CPU time of outside programs follows; journals have it
  // from format 3 on.
  kWithPrograms = 0x80
};

// This bit is added to the count of channels if each channel is followed by its slopes; journals
// have it from format 5 on.
constexpr std::uint64_t kWithSlopes = std::uint64_t{1} << 63;

bool is_table(const std::vector<double>& slopes, std::size_t rows) {
  return slopes.empty() || (rows > 0 && slopes.size() % rows == 0);
}

Kind kind_of(const Result<Channels>& result) {
  if (result) return kChannels;
  switch (result.failure().cause) {
    case Cause::timeout:
      return kTimeout;
    case Cause::bad_output:
      return kBadOutput;
    case Cause::transient:
      return kTransient;
    case Cause::not_begun:
      return kNotBegun;
    case Cause::point:
      break;
  }
  return kPoint;
}

std::optional<Cause> cause_of(std::uint8_t kind) {
  switch (kind) {
    case kPoint:
      return Cause::point;
    case kTimeout:
      return Cause::timeout;
    case kBadOutput:
      return Cause::bad_output;
    case kTransient:
      return Cause::transient;
    case kNotBegun:
      return Cause::not_begun;
    default:
      return std::nullopt;
  }
}

Channels read_channels(Reader& reader) {
  Channels channels;
  auto count = reader.number<std::uint64_t>();
  const bool slopes = count & kWithSlopes;
  count &= ~kWithSlopes;
  for (std::uint64_t i = 0; i < count && reader.ok; ++i) {
    Channel channel{.name = reader.text(), .unit = reader.text(), .values = reader.numbers()};
    if (slopes) channel.slopes = reader.numbers();
    if (!is_table(channel.slopes, channel.values.size())) reader.ok = false;
    // Names of channels must be unique.
    if (channels.find(channel.name) != nullptr) reader.ok = false;
    if (reader.ok) channels.add(std::move(channel));
  }
  // Every value must have only one encoding.
  if (slopes && !channels.has_slopes()) reader.ok = false;
  return channels;
}

}  // namespace

std::string encode(const DesignPoint& point) {
  std::string bytes;
  put_numbers(bytes, point.values);
  return bytes;
}

std::string encode(const Channels& channels) {
  std::string bytes;
  const bool slopes = channels.has_slopes();
  put(bytes, static_cast<std::uint64_t>(channels.all().size()) | (slopes ? kWithSlopes : 0));
  for (const Channel& channel : channels.all()) {
    put_text(bytes, channel.name);
    put_text(bytes, channel.unit);
    put_numbers(bytes, channel.values);
    if (slopes) put_numbers(bytes, channel.slopes);
  }
  return bytes;
}

std::string encode(const Outcome& outcome) {
  std::string bytes;
  put(bytes, outcome.wall_time);
  put(bytes, outcome.cpu_time);
  put(bytes, static_cast<std::int32_t>(outcome.worker));
  const bool programs = outcome.program_time != 0.0;
  put(bytes, static_cast<std::uint8_t>(kind_of(outcome.result) | (programs ? kWithPrograms : 0)));
  if (programs) put(bytes, outcome.program_time);
  if (outcome.result) {
    bytes += encode(*outcome.result);
  } else {
    put_text(bytes, outcome.result.failure().reason);
  }
  return bytes;
}

std::optional<DesignPoint> decode_point(std::string_view bytes) {
  Reader reader{bytes};
  DesignPoint point{reader.numbers()};
  if (!reader.finished()) return std::nullopt;
  return point;
}

std::optional<Outcome> decode_outcome(std::string_view bytes) {
  Reader reader{bytes};
  Outcome outcome{.result = Failure{}};
  outcome.wall_time = reader.number<double>();
  outcome.cpu_time = reader.number<double>();
  outcome.worker = reader.number<std::int32_t>();
  auto kind = reader.number<std::uint8_t>();
  if (kind & kWithPrograms) {
    kind &= static_cast<std::uint8_t>(~kWithPrograms);
    outcome.program_time = reader.number<double>();
    if (outcome.program_time == 0.0) reader.ok = false;  // every value must have only one encoding
  }
  const std::optional<Cause> cause = cause_of(kind);
  if (kind == kChannels) {
    outcome.result = read_channels(reader);
  } else if (cause) {
    outcome.result = Failure{reader.text(), *cause};
  }
  if (!reader.finished() || (kind != kChannels && !cause)) return std::nullopt;
  return outcome;
}

std::uint64_t hash(std::string_view bytes, std::uint64_t before) {
  std::uint64_t state = before;
  for (const char byte : bytes) {
    state = (state ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  }
  return state;
}

}  // namespace latsch
