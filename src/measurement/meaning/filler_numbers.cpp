// SPDX-License-Identifier: Apache-2.0
#include "measurement/meaning/filler_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace latsch {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();
// magnitude above which no channel in any usual unit has a value
constexpr double kBeyondAll = 1e30;
// relative tolerance, because a number is converted to SI and back
constexpr double kRounding = 1e-9;

/// Absolute values of fillers, in increasing order.
constexpr std::array kFillers = {999.0,        999.9,      999.99,       999.999,      7777.0,
                                 8888.0,       9999.0,     9999.9,       9999.99,      32767.0,
                                 32768.0,      65535.0,    77777.0,      88888.0,      99999.0,
                                 99999.9,      999999.0,   8388607.0,    8388608.0,    9999999.0,
                                 16777215.0,   99999999.0, 2147483647.0, 2147483648.0, 4294967295.0,
                                 9999999999.0, 1e15,       1e20,         1e25};

bool is_converter_end(double size) {
  constexpr std::array kEnds = {32767.0,
                                32768.0,
                                65535.0,
                                8388607.0,
                                8388608.0,
                                16777215.0,
                                2147483647.0,
                                2147483648.0,
                                4294967295.0};
  return std::any_of(
      kEnds.begin(), kEnds.end(), [&](double end) { return std::abs(size - end) < 0.5; });
}

bool is_filler(double value) {
  const double size = std::abs(value);
  if (size >= kBeyondAll) return true;
  if (size < kFillers.front() * (1.0 - kRounding)) return false;
  const auto next = std::lower_bound(kFillers.begin(), kFillers.end(), size * (1.0 - kRounding));
  return next != kFillers.end() && std::abs(*next - size) <= kRounding * size;
}

/// Range of the values that are no filler numbers, and their usual change from sample to sample.
struct Others {
  double low = kNoLimit, high = -kNoLimit;
  double largest_step = 0.0;
  std::size_t count = 0, steps = 0, repeats = 0, longest_run = 0;

  double span() const { return high - low; }
  double size() const { return std::max(std::abs(low), std::abs(high)); }
  /// True if neighboring values are hardly ever equal, as in a measured channel with noise.
  bool vary() const { return steps >= 10 && 2 * repeats < steps; }
};

template <class IsLeftOut>
Others others_of(const std::vector<double>& values, const IsLeftOut& is_left_out) {
  Others others;
  double before = std::nan("");
  std::size_t run = 0;
  for (const double value : values) {
    if (std::isnan(value) || is_left_out(value)) {
      before = std::nan("");
      continue;
    }
    ++others.count;
    others.low = std::min(others.low, value);
    others.high = std::max(others.high, value);
    run = value == before ? run + 1 : 1;
    others.longest_run = std::max(others.longest_run, run);
    if (!std::isnan(before)) {
      ++others.steps;
      others.repeats += value == before ? 1 : 0;
      others.largest_step = std::max(others.largest_step, std::abs(value - before));
    }
    before = value;
  }
  return others;
}

/// True if the number is far from the values before and after it wherever it occurs.
bool stands_alone(const std::vector<double>& values,
                  const FillerNumber& filler,
                  double largest_step) {
  constexpr double kFar = 5.0;
  const auto is_far = [&](std::size_t i) {
    return std::isnan(values[i]) || std::abs(values[i] - filler.number) > kFar * largest_step;
  };
  const auto is_same = [&](std::size_t i) {
    return std::abs(values[i] - filler.number) <= kRounding * std::abs(filler.number);
  };
  bool has_neighbor = false;
  for (const std::size_t i : filler.samples) {
    if (i > 0 && !is_same(i - 1)) {
      if (!is_far(i - 1)) return false;
      has_neighbor = true;
    }
    if (i + 1 < values.size() && !is_same(i + 1)) {
      if (!is_far(i + 1)) return false;
      has_neighbor = true;
    }
  }
  return has_neighbor;
}

/// Decides how certain it is that a known filler number is not a measured value. Returns false if
/// it may well be measured.
bool judge(const std::vector<double>& values, const Others& others, FillerNumber& filler) {
  constexpr double kOutside = 0.1;  // share of the span of the other values
  const double size = std::abs(filler.number);
  filler.reason = is_converter_end(size) ? "the end of a converter's range"
                                         : "a usual filler for a missing value";
  if (others.count == 0) {
    filler.is_certain = size >= kBeyondAll || filler.number < 0.0;
    return filler.is_certain || filler.samples.size() > 1;
  }
  // least number of other values that show which values are usual
  constexpr std::size_t kFewest = 3;
  if (others.count < kFewest && size < kBeyondAll) return false;
  const double outside = std::max({others.low - filler.number, filler.number - others.high, 0.0});
  filler.is_certain = size >= kBeyondAll ||
                      (outside > others.span() && outside > 0.5 * others.size()) ||
                      (others.vary() && stands_alone(values, filler, others.largest_step));
  return filler.is_certain || outside > kOutside * others.span() ||
         (filler.samples.size() >= 3 && others.vary() && others.longest_run < 3);
}

std::vector<FillerNumber> known_fillers(const std::vector<double>& values) {
  std::map<double, FillerNumber> found;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i]) || !is_filler(values[i])) continue;
    const auto like = found.lower_bound(values[i] - kRounding * std::abs(values[i]));
    const bool is_known =
        like != found.end() && std::abs(like->first - values[i]) <= kRounding * std::abs(values[i]);
    FillerNumber& filler = is_known ? like->second : found[values[i]];
    if (filler.samples.empty()) filler.number = values[i];
    filler.samples.push_back(i);
  }
  std::vector<FillerNumber> fillers;
  if (found.empty()) return fillers;
  const Others others = others_of(values, is_filler);
  for (auto& [number, filler] : found)
    if (judge(values, others, filler)) fillers.push_back(std::move(filler));
  return fillers;
}

/// Examines the largest or the smallest value of a channel.
void judge_end(const std::vector<double>& values,
               double end,
               bool may_saturate,
               std::vector<FillerNumber>& fillers) {
  constexpr std::size_t kFewest = 3, kSuccessive = 5;
  FillerNumber filler{end, {}, "", false};
  std::size_t run = 0, longest = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    run = values[i] == end ? run + 1 : 0;
    longest = std::max(longest, run);
    if (run > 0) filler.samples.push_back(i);
  }
  if (end == 0.0 || filler.samples.size() < kFewest) return;
  const Others others = others_of(values, [&](double value) { return value == end; });
  if (!others.vary()) return;
  const double outside = std::max(others.low - end, end - others.high);
  if (outside > 2.0 * others.span()) {
    filler.reason = "the same in all of them and far from every other value";
    fillers.push_back(std::move(filler));
  } else if (may_saturate && longest >= kSuccessive && others.longest_run < 3) {
    filler.reason = fmt::format(
        "its {} value, in {} successive samples where no other value stands in three: a sensor "
        "that saturates?",
        end > others.high ? "largest" : "smallest",
        longest);
    fillers.push_back(std::move(filler));
  }
}

}  // namespace

std::vector<FillerNumber> filler_numbers(const std::vector<double>& written, bool may_saturate) {
  std::vector<FillerNumber> fillers = known_fillers(written);
  std::vector<double> values = written;
  for (const FillerNumber& filler : fillers)
    for (const std::size_t i : filler.samples) values[i] = std::nan("");
  const Others all = others_of(values, [](double) { return false; });
  if (all.count == 0 || !(all.span() > 0.0)) return fillers;
  judge_end(values, all.low, may_saturate, fillers);
  judge_end(values, all.high, may_saturate, fillers);
  return fillers;
}

std::string runs_in_words(const std::vector<long>& numbers) {
  constexpr int kMostRuns = 8;
  std::string text;
  int runs = 0;
  std::size_t i = 0;
  while (i < numbers.size() && runs < kMostRuns) {
    std::size_t end = i + 1;
    while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) ++end;
    // two neighboring samples are written as two numbers, not as a range
    if (end - i == 2) end = i + 1;
    text += (runs++ == 0 ? "" : ", ") +
            (end - i == 1 ? fmt::format("{}", numbers[i])
                          : fmt::format("{} to {}", numbers[i], numbers[end - 1]));
    i = end;
  }
  return i < numbers.size() ? text + fmt::format(" and {} more", numbers.size() - i) : text;
}

}  // namespace latsch
