// SPDX-License-Identifier: Apache-2.0
// Random numbers without state: number i of the stream (seed, trial) is a function of these three.
//
// Philox4x32-10: ten rounds of multiplication and exclusive or turn a counter of 128 bits and a key
// of 64 into 128 random bits [Salmon, Moraes, Dror & Shaw 2011, "Parallel random numbers: as easy
// as 1, 2, 3", SC'11]. The key is the seed; the counter holds the trial and the position in its
// stream, so streams never overlap and no worker depends on what another has drawn.
#pragma once

#include <array>
#include <cstdint>

namespace latsch {

/// Returns 128 random bits for this counter and key, by ten rounds.
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key);

/// Numbers of the stream (seed, trial), in the order of the calls.
class RandomStream {
 public:
  /// Begins the stream. Streams of different seeds or trials are independent of each other.
  RandomStream(std::uint64_t seed, std::uint64_t trial) : seed_(seed), trial_(trial) {}

  /// Uniform on 0 <= value < 1; every multiple of 2^-53 is equally likely.
  double uniform();
  /// Normal with mean 0 and standard deviation 1 [Box & Muller 1958].
  double normal();
  /// Uniform on 0 .. count - 1. Requires count >= 1.
  std::uint64_t below(std::uint64_t count);

 private:
  std::uint64_t bits();

  std::uint64_t seed_, trial_;
  std::uint64_t drawn_ = 0;  // blocks of 64 bits drawn so far
  std::array<std::uint32_t, 4> block_ = {};
};

}  // namespace latsch
