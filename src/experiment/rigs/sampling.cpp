// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/sampling.h"

#include <fmt/format.h>

#include <algorithm>

namespace latsch::experiment {

void refuse_coarse_samples(const Node& test, const char* key, double highest, double sample_step) {
  constexpr double kRounding = 1e-9;
  const double samples = 1.0 / (highest * sample_step);
  if (samples >= kSamplesOfPeriod * (1.0 - kRounding)) return;
  test.reject(
      key,
      fmt::format("reaches {:.4g} Hz, of whose period a sample every {:.4g} ms sees {:.3g}; "
                  "expected {:g} at least: frequencies to {:.4g} Hz, or a sample_step of at most "
                  "{:.3g} ms",
                  highest,
                  1e3 * sample_step,
                  samples,
                  kSamplesOfPeriod,
                  1.0 / (kSamplesOfPeriod * sample_step),
                  1e3 / (kSamplesOfPeriod * highest)));
}

std::string note_on_samples(double sample_step, double speed) {
  constexpr double kRounding = 1.0 + 1e-9;
  if (speed == 0.0) return "";
  const double most = std::min(0.5 / kTireVibrates, kFootprint / speed);
  if (sample_step <= most * kRounding) return "";
  return fmt::format(
      "sample_step is {:.4g} ms, in which the tire rolls {:.3g} mm: the record holds frequencies "
      "to "
      "{:.3g} Hz, while a tire on an obstacle vibrates at up to some {:g} Hz and leaves it within "
      "some {:g} mm, which the samples show at other frequencies or not at all; at most {:.3g} ms "
      "hold both",
      1e3 * sample_step,
      1e3 * speed * sample_step,
      0.5 / sample_step,
      kTireVibrates,
      1e3 * kFootprint,
      1e3 * most);
}

}  // namespace latsch::experiment
