// SPDX-License-Identifier: Apache-2.0
#include "base/random.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace latsch {
namespace {

std::uint32_t low(std::uint64_t bits) { return static_cast<std::uint32_t>(bits); }
std::uint32_t high(std::uint64_t bits) { return static_cast<std::uint32_t>(bits >> 32); }

}  // namespace

std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key) {
  constexpr std::uint64_t kM0 = 0xD2511F53, kM1 = 0xCD9E8D57;  // multipliers
  constexpr std::uint32_t kW0 = 0x9E3779B9, kW1 = 0xBB67AE85;  // Weyl increments of the key
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t product0 = kM0 * counter[0], product1 = kM1 * counter[2];
    counter = {high(product1) ^ counter[1] ^ key[0],
               low(product1),
               high(product0) ^ counter[3] ^ key[1],
               low(product0)};
    key[0] += kW0;
    key[1] += kW1;
  }
  return counter;
}

std::uint64_t RandomStream::bits() {
  const std::uint64_t place = drawn_ / 2;
  const bool first = drawn_++ % 2 == 0;
  if (first)
    block_ =
        philox4x32({low(place), high(place), low(trial_), high(trial_)}, {low(seed_), high(seed_)});
  const int at = first ? 0 : 2;
  return static_cast<std::uint64_t>(block_[at + 1]) << 32 | block_[at];
}

double RandomStream::uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

double RandomStream::normal() {
  const double u1 = 1.0 - uniform();  // never 0
  const double u2 = uniform();
  return std::sqrt(-2.0 * std::log(u1)) * std::cos(2.0 * std::numbers::pi * u2);
}

std::uint64_t RandomStream::below(std::uint64_t count) {
  assert(count > 0);
  // Draws above the largest multiple of `count` are repeated, because they would make small values
  // likelier.
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  const std::uint64_t limit = kMost - kMost % count;
  std::uint64_t drawn = bits();
  while (drawn >= limit) drawn = bits();
  return drawn % count;
}

}  // namespace latsch
