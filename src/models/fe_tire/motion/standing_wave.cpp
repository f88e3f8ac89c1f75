// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/motion/standing_wave.h"

namespace latsch::fe_tire {
namespace {

constexpr double kNarrow = 1e-7;  // relative width of the last interval of a speed

/// K and W of one circumferential number.
struct StillWave {
  numerics::BandedHermitian K, W;

  /// True if K - speed^2 W is positive definite.
  bool is_held_at(double speed) const {
    numerics::BandedHermitian at = K;
    at.lower() -= speed * speed * W.lower();
    return numerics::BandedCholesky().factorize(at);
  }
};

}  // namespace

int most_waves(const Ring& ring) { return ring.sectors() / 3; }

bool holds_every_wave(const SectorBlocks& K,
                      const SectorFlow& flow,
                      const Ring& ring,
                      double speed) {
  for (int n = 0; n <= most_waves(ring); ++n) {
    if (!StillWave{K.harmonic(n), flow.W.harmonic(n)}.is_held_at(speed)) return false;
  }
  return true;
}

std::optional<CriticalWave> critical_wave(const SectorBlocks& K,
                                          const SectorFlow& flow,
                                          const Ring& ring,
                                          double highest) {
  CriticalWave lowest{highest, -1};
  for (int n = 0; n <= most_waves(ring); ++n) {
    const StillWave wave{K.harmonic(n), flow.W.harmonic(n)};
    if (wave.is_held_at(lowest.speed)) continue;
    double held = 0.0, lost = lowest.speed;
    if (!wave.is_held_at(held)) return std::nullopt;
    while (lost - held > kNarrow * lost) {
      const double middle = 0.5 * (held + lost);
      (wave.is_held_at(middle) ? held : lost) = middle;
    }
    lowest = {lost, n};
  }
  if (lowest.n < 0) return std::nullopt;
  return lowest;
}

}  // namespace latsch::fe_tire
