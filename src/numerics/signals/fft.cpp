// SPDX-License-Identifier: Apache-2.0
#include "numerics/signals/fft.h"

#include <algorithm>
#include <cassert>
#include <unsupported/Eigen/FFT>

namespace latsch::numerics {
namespace {

/// Returns the thread's transform, which stores the twiddle factors of lengths used before.
Eigen::FFT<double>& transform() {
  thread_local Eigen::FFT<double> fft(Eigen::default_fft_impl<double>(),
                                      Eigen::FFT<double>::HalfSpectrum);
  return fft;
}

}  // namespace

Spectrum real_fft(std::span<const double> x, int length) {
  assert(length > 0 && static_cast<std::size_t>(length) >= x.size());
  std::vector<double> padded(length, 0.0);
  std::copy(x.begin(), x.end(), padded.begin());
  Spectrum half(length / 2 + 1);
  if (length == 1) {
    half[0] = padded[0];
  } else {
    transform().fwd(half.data(), padded.data(), length);
  }
  return half;
}

std::vector<double> inverse_real_fft(const Spectrum& half, int length) {
  assert(length > 0 && static_cast<int>(half.size()) == length / 2 + 1);
  std::vector<double> x(length);
  if (length == 1) {
    x[0] = half[0].real();
  } else {
    transform().inv(x.data(), half.data(), length);
  }
  return x;
}

int fast_length(int at_least) {
  int best = 4;
  while (best < at_least) best *= 2;
  for (int five = 4; five < best; five *= 5) {
    for (int three = five; three < best; three *= 3) {
      int length = three;
      while (length < at_least) length *= 2;
      best = std::min(best, length);
    }
  }
  return best;
}

}  // namespace latsch::numerics
