// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/motion/standing_wave.h"

namespace latsch::fe_tire {
namespace {

constexpr double kExact = 1e-7;  // relative width of the last interval of a speed

/// True if K - speed^2 W is positive definite.
bool is_held(const numerics::BandedHermitian& K, const numerics::BandedHermitian& W, double speed) {
  numerics::BandedHermitian at = K;
  at.lower() -= speed * speed * W.lower();
  return numerics::BandedCholesky().factorize(at);
}

}  // namespace

bool holds_every_wave(const SectorBlocks& K,
                      const SectorFlow& flow,
                      const Ring& ring,
                      double speed) {
  for (int n = 0; n <= ring.sectors() / 2; ++n) {
    if (!is_held(K.harmonic(n), flow.W.harmonic(n), speed)) return false;
  }
  return true;
}

std::optional<CriticalWave> critical_wave(const SectorBlocks& K,
                                          const SectorFlow& flow,
                                          const Ring& ring,
                                          double highest) {
  CriticalWave lowest{highest, -1};
  for (int n = 0; n <= ring.sectors() / 2; ++n) {
    const numerics::BandedHermitian K_n = K.harmonic(n), W_n = flow.W.harmonic(n);
    if (is_held(K_n, W_n, lowest.speed)) continue;
    double held = 0.0, lost = lowest.speed;
    if (!is_held(K_n, W_n, held)) return std::nullopt;
    while (lost - held > kExact * lost) {
      const double middle = 0.5 * (held + lost);
      (is_held(K_n, W_n, middle) ? held : lost) = middle;
    }
    lowest = {lost, n};
  }
  if (lowest.n < 0) return std::nullopt;
  return lowest;
}

}  // namespace latsch::fe_tire
