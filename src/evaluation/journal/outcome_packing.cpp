// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal/outcome_packing.h"

#include <zlib.h>

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "evaluation/trial/encoding.h"
#include "numerics/dense/orthogonal_factors.h"

namespace latsch {
namespace {

// Ways to pack a row. A row of kind `single` is packed alone, and no other row may refer to it.
enum class Kind : std::uint8_t { plain, alone, referring, single };

// Coding of a channel: by differences (kDifferences plus the order), or by reference to earlier
// rows.
enum Coding : std::uint8_t { kDifferences = 0, kSame = 8, kCombined = 9 };

// Smallest number of values that is packed.
constexpr std::size_t kLeastValues = 64;
// Smallest number of values of an outcome that may refer to other rows. For fewer, the room saved
// is not worth the loss if one row is damaged.
constexpr std::size_t kLeastToRefer = 1000;
constexpr std::size_t kMostValues = std::size_t{8} << 20;  // values in a block, 64 MB
// Smallest number of samples of a channel that is coded as a combination of earlier channels.
constexpr std::size_t kLeastSamples = 32;
constexpr int kHighestOrder = 2;
// Largest ratio of the packed size with references to that without them. Above it, the row is
// packed alone.
constexpr double kWorthReferring = 0.9;
constexpr int kMostRows = 16;  // largest number of earlier rows in a combination
// Number of samples used to fit the coefficients of a combination.
constexpr Eigen::Index kMostFitted = 128;
constexpr int kDeflateLevel = 1;  // lowest effort, because the remainder is nearly noise
// Largest accepted ratio of inflated to deflated size. The limit of zlib's format is 1032.
constexpr std::uint64_t kMostInflated = 1100;

using Row = OutcomeBlock::Row;

template <class T>
void append_bytes(std::string& bytes, const T& number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

template <class T>
bool take(std::string_view& bytes, T& number) {
  if (bytes.size() < sizeof number) return false;
  std::memcpy(&number, bytes.data(), sizeof number);
  bytes.remove_prefix(sizeof number);
  return true;
}

/// Maps numbers to integers in the same order, so that neighboring floating-point numbers differ by
/// one.
std::uint64_t place_of(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  return bits >> 63 ? ~bits : bits | std::uint64_t{1} << 63;
}
double at_place(std::uint64_t place) {
  return std::bit_cast<double>(place >> 63 ? place & ~(std::uint64_t{1} << 63) : ~place);
}

/// Maps the differences 0, -1, 1, -2, ... to 0, 1, 2, 3, ..., so that small differences become
/// small numbers.
std::uint64_t folded(std::uint64_t difference) {
  return difference << 1 ^ (0 - (difference >> 63));
}
std::uint64_t unfolded(std::uint64_t number) { return number >> 1 ^ (0 - (number & 1)); }

using Rest = std::vector<std::uint64_t>;
using Numbers = std::span<const double>;

/// Returns the integer predicted for a sample from the samples before it.
std::uint64_t expected(Numbers x, std::size_t i, int order) {
  order = std::min(order, static_cast<int>(i));
  if (order == 0) return place_of(0.0);
  if (order == 1) return place_of(x[i - 1]);
  return 2 * place_of(x[i - 1]) - place_of(x[i - 2]);
}

Rest rest_of_differences(Numbers x, int order) {
  Rest rest(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    rest[i] = folded(place_of(x[i]) - expected(x, i, order));
  }
  return rest;
}

/// The values of one channel in earlier rows, the latest row first.
using Before = std::vector<Numbers>;

std::vector<double> combination(const Before& rows, const std::vector<double>& a) {
  std::vector<double> x(rows.front().begin(), rows.front().end());
  for (std::size_t j = 0; j < a.size(); ++j) {
    const Numbers base = rows.front(), other = rows[j + 1];
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += a[j] * (other[i] - base[i]);
  }
  return x;
}

Rest rest_of_combination(Numbers x, const Before& rows, const std::vector<double>& a) {
  const std::vector<double> y = combination(rows, a);
  Rest rest(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) rest[i] = folded(place_of(x[i]) - place_of(y[i]));
  return rest;
}

/// Returns the coefficients of the combination with the least relative error at samples that are
/// spread evenly.
std::vector<double> coefficients(Numbers x, const Before& rows) {
  const auto n = static_cast<Eigen::Index>(x.size());
  const Eigen::Index fitted = std::min(n, kMostFitted);
  const auto m = static_cast<Eigen::Index>(rows.size()) - 1;
  Eigen::MatrixXd A(fitted, m);
  Eigen::VectorXd b(fitted);
  for (Eigen::Index k = 0; k < fitted; ++k) {
    const auto i = static_cast<std::size_t>(k * n / fitted);
    const double base = rows.front()[i];
    const double weight = x[i] != 0.0 ? 1.0 / std::abs(x[i]) : 1.0;
    b[k] = weight * (x[i] - base);
    for (Eigen::Index j = 0; j < m; ++j) {
      A(k, j) = weight * (rows[static_cast<std::size_t>(j) + 1][i] - base);
    }
  }
  if (m == 0 || !A.allFinite() || !b.allFinite()) return {};
  const Eigen::VectorXd a = numerics::shortest_solution(A, b);
  if (!a.allFinite()) return {};
  return {a.begin(), a.end()};
}

/// Returns the approximate number of bits that a remainder needs.
double cost(const Rest& rest) {
  double bits = 0.0;
  for (const std::uint64_t number : rest) bits += std::bit_width(number);
  return bits;
}

/// Writes the bytes of all remainders in groups of equal significance, the most significant first.
void put_planes(std::string& bytes, const Rest& rest) {
  for (int plane = 7; plane >= 0; --plane) {
    for (const std::uint64_t number : rest) {
      bytes.push_back(static_cast<char>(number >> (8 * plane)));
    }
  }
}

std::optional<Rest> take_planes(std::string_view& bytes, std::size_t count) {
  if (count > bytes.size() / 8) return std::nullopt;
  Rest rest(count, 0);
  for (int plane = 7; plane >= 0; --plane) {
    for (std::size_t i = 0; i < count; ++i) {
      rest[i] |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * plane);
    }
    bytes.remove_prefix(count);
  }
  return rest;
}

/// Numbers that are coded together: the values of a channel, or its derivatives with respect to one
/// variable.
struct Column {
  std::size_t channel;
  std::optional<std::size_t> variable = {};
};

std::optional<Numbers> numbers_of(const Row& row, const Column& column, std::size_t count) {
  const auto& channels = row.channels.all();
  if (column.channel >= channels.size()) return std::nullopt;
  const Channel& channel = channels[column.channel];
  if (channel.values.size() != count) return std::nullopt;
  if (!column.variable) return channel.values;
  if ((*column.variable + 1) * count > channel.slopes.size()) return std::nullopt;
  return Numbers(channel.slopes).subspan(*column.variable * count, count);
}

/// Returns the values of the column in the rows of the block, the latest row first; rows without
/// such a channel are left out.
Before before(const OutcomeBlock& block, const Column& column, std::size_t count) {
  Before rows;
  for (auto row = block.rows.rbegin(); row != block.rows.rend(); ++row) {
    if (std::ssize(rows) > kMostRows) break;
    if (const auto numbers = numbers_of(*row, column, count)) rows.push_back(*numbers);
  }
  return rows;
}

bool same_bits(Numbers a, Numbers b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

/// Returns the distance to an earlier row with identical values; 0 if there is none.
std::uint8_t places_back(const OutcomeBlock& block,
                         std::int64_t number,
                         const Column& column,
                         Numbers x) {
  for (auto row = block.rows.rbegin(); row != block.rows.rend(); ++row) {
    const auto numbers = numbers_of(*row, column, x.size());
    if (numbers && same_bits(*numbers, x)) return static_cast<std::uint8_t>(number - row->number);
  }
  return 0;
}

void put_column(std::string& bytes,
                Numbers x,
                const Column& column,
                std::int64_t number,
                const OutcomeBlock& block) {
  append_bytes(bytes, static_cast<std::uint64_t>(x.size()));
  if (const std::uint8_t back = places_back(block, number, column, x)) {
    append_bytes(bytes, kSame);
    append_bytes(bytes, back);
    return;
  }
  auto coding = static_cast<std::uint8_t>(kDifferences);
  Rest best = rest_of_differences(x, 0);
  double least = cost(best);
  for (int order = 1; order <= kHighestOrder; ++order) {
    Rest rest = rest_of_differences(x, order);
    if (const double bits = cost(rest); bits < least) {
      least = bits;
      best = std::move(rest);
      coding = static_cast<std::uint8_t>(kDifferences + order);
    }
  }
  const Before rows = x.size() >= kLeastSamples ? before(block, column, x.size()) : Before{};
  std::vector<double> a;
  if (!rows.empty()) {
    a = coefficients(x, rows);
    Rest rest = rest_of_combination(x, rows, a);
    const double bits = cost(rest) + 64.0 * static_cast<double>(a.size());
    if (bits < kWorthReferring * least) {
      best = std::move(rest);
      coding = kCombined;
    }
  }
  append_bytes(bytes, coding);
  if (coding == kCombined) {
    append_bytes(bytes, static_cast<std::uint8_t>(a.size()));
    for (const double factor : a) append_bytes(bytes, factor);
  }
  put_planes(bytes, best);
}

std::optional<std::vector<double>> take_same(std::string_view& bytes,
                                             const Column& column,
                                             std::size_t count,
                                             std::int64_t number,
                                             const OutcomeBlock& block) {
  std::uint8_t back = 0;
  if (!take(bytes, back)) return std::nullopt;
  for (const Row& row : block.rows) {
    if (row.number != number - back) continue;
    if (const auto numbers = numbers_of(row, column, count))
      return std::vector<double>(numbers->begin(), numbers->end());
  }
  return std::nullopt;
}

std::optional<std::vector<double>> take_combined(std::string_view& bytes,
                                                 const Column& column,
                                                 std::size_t count,
                                                 const OutcomeBlock& block) {
  std::uint8_t factors = 0;
  if (!take(bytes, factors)) return std::nullopt;
  const Before rows = before(block, column, count);
  if (rows.empty() || factors + 1u > rows.size()) return std::nullopt;
  std::vector<double> a(factors);
  for (double& factor : a) {
    if (!take(bytes, factor)) return std::nullopt;
  }
  const auto rest = take_planes(bytes, count);
  if (!rest) return std::nullopt;
  std::vector<double> x = combination(rows, a);
  for (std::size_t i = 0; i < count; ++i) x[i] = at_place(place_of(x[i]) + unfolded((*rest)[i]));
  return x;
}

std::optional<std::vector<double>> take_column(std::string_view& bytes,
                                               const Column& column,
                                               std::int64_t number,
                                               const OutcomeBlock& block) {
  std::uint64_t count = 0;
  std::uint8_t coding = 0;
  if (!take(bytes, count) || !take(bytes, coding)) return std::nullopt;
  if (coding == kSame) return take_same(bytes, column, count, number, block);
  if (coding == kCombined) return take_combined(bytes, column, count, block);
  if (coding > kDifferences + kHighestOrder) return std::nullopt;
  const auto rest = take_planes(bytes, count);
  if (!rest) return std::nullopt;
  std::vector<double> x(count);
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = at_place(expected(x, i, coding) + unfolded((*rest)[i]));
  }
  return x;
}

void put_slopes(std::string& bytes,
                const Channel& channel,
                std::size_t place,
                std::int64_t number,
                const OutcomeBlock& block) {
  const std::size_t rows = channel.values.size();
  const std::size_t variables = channel.slopes.empty() ? 0 : channel.slopes.size() / rows;
  append_bytes(bytes, static_cast<std::uint64_t>(variables));
  for (std::size_t v = 0; v < variables; ++v) {
    const Numbers column = Numbers(channel.slopes).subspan(v * rows, rows);
    put_column(bytes, column, {place, v}, number, block);
  }
}

/// Reads the slopes of a channel from the front of `bytes`. Returns false if they are missing.
bool take_slopes(std::string_view& bytes,
                 Channel& channel,
                 std::size_t place,
                 std::int64_t number,
                 const OutcomeBlock& block) {
  std::uint64_t variables = 0;
  if (!take(bytes, variables)) return false;
  for (std::uint64_t v = 0; v < variables; ++v) {
    const auto column = take_column(bytes, {place, v}, number, block);
    if (!column || column->empty() || column->size() != channel.values.size()) return false;
    channel.slopes.insert(channel.slopes.end(), column->begin(), column->end());
  }
  return true;
}

std::string deflated(const std::string& bytes) {
  uLongf size = ::compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  ::compress2(reinterpret_cast<Bytef*>(packed.data()),
              &size,
              reinterpret_cast<const Bytef*>(bytes.data()),
              static_cast<uLong>(bytes.size()),
              kDeflateLevel);
  packed.resize(size);
  return packed;
}

std::optional<std::string> inflated(std::string_view packed, std::uint64_t size) {
  if (size > kMostInflated * (packed.size() + 1)) return std::nullopt;
  std::string bytes(size, '\0');
  uLongf found = size;
  const int status = ::uncompress(reinterpret_cast<Bytef*>(bytes.data()),
                                  &found,
                                  reinterpret_cast<const Bytef*>(packed.data()),
                                  static_cast<uLong>(packed.size()));
  if (status != Z_OK || found != size) return std::nullopt;
  return bytes;
}

std::uint32_t checksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      ::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

std::size_t values_of(const Channels& channels) {
  std::size_t count = 0;
  for (const Channel& channel : channels.all())
    count += channel.values.size() + channel.slopes.size();
  return count;
}

/// Returns the outcome with the names of its channels, but without their numbers.
Outcome without_values(const Outcome& outcome) {
  Outcome bare = outcome;
  Channels channels;
  for (const Channel& channel : outcome.result->all())
    channels.add({channel.name, channel.unit, {}});
  bare.result = std::move(channels);
  return bare;
}

void remember(OutcomeBlock& block, std::int64_t number, const Channels& channels) {
  block.rows.push_back({number, channels});
  block.values += values_of(channels);
}

bool is_full(const OutcomeBlock& block, std::int64_t number) {
  return block.rows.empty() || number - block.rows.front().number >= kLongestBlock ||
         block.values > kMostValues;
}

}  // namespace

std::string OutcomePacker::pack(std::int64_t number, const Outcome& outcome) {
  const std::string whole = encode(outcome);
  std::string bytes;
  if (!outcome.result || values_of(*outcome.result) < kLeastValues) {
    append_bytes(bytes, Kind::plain);
    return bytes + whole;
  }
  const bool is_single = values_of(*outcome.result) < kLeastToRefer;
  if (is_single || is_full(block_, number)) block_ = {};
  append_bytes(bytes,
               is_single             ? Kind::single
               : block_.rows.empty() ? Kind::alone
                                     : Kind::referring);
  append_bytes(bytes, checksum(whole));
  std::string body;
  const std::string head = encode(without_values(outcome));
  append_bytes(body, static_cast<std::uint64_t>(head.size()));
  body += head;
  const auto& channels = outcome.result->all();
  for (std::size_t c = 0; c < channels.size(); ++c) {
    put_column(body, channels[c].values, {c}, number, block_);
  }
  if (outcome.result->has_slopes()) {
    for (std::size_t c = 0; c < channels.size(); ++c)
      put_slopes(body, channels[c], c, number, block_);
  }
  append_bytes(bytes, static_cast<std::uint64_t>(body.size()));
  bytes += deflated(body);
  if (!is_single) remember(block_, number, *outcome.result);
  return bytes;
}

std::optional<Outcome> OutcomeUnpacker::unpack(std::int64_t number, std::string_view bytes) {
  Kind kind{};
  if (!take(bytes, kind)) return std::nullopt;
  if (kind == Kind::plain) return decode_outcome(bytes);
  std::uint32_t sum = 0;
  std::uint64_t size = 0, head_size = 0;
  if (!take(bytes, sum) || !take(bytes, size)) return std::nullopt;
  if (kind == Kind::alone || kind == Kind::single) block_ = {};
  const auto body = inflated(bytes, size);
  if (!body) return std::nullopt;
  std::string_view rest = *body;
  if (!take(rest, head_size) || head_size > rest.size()) return std::nullopt;
  auto outcome = decode_outcome(rest.substr(0, head_size));
  rest.remove_prefix(head_size);
  if (!outcome || !outcome->result) return std::nullopt;
  std::vector<Channel> found = outcome->result->all();
  for (std::size_t c = 0; c < found.size(); ++c) {
    auto values = take_column(rest, {c}, number, block_);
    if (!values) return std::nullopt;
    found[c].values = std::move(*values);
  }
  for (std::size_t c = 0; c < found.size() && !rest.empty(); ++c) {
    if (!take_slopes(rest, found[c], c, number, block_)) return std::nullopt;
  }
  Channels channels;
  for (Channel& channel : found) channels.add(std::move(channel));
  outcome->result = std::move(channels);
  if (!rest.empty() || checksum(encode(*outcome)) != sum) return std::nullopt;
  if (kind != Kind::single) remember(block_, number, *outcome->result);
  return outcome;
}

}  // namespace latsch
