// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/duration_limit.h"

#include <fmt/format.h>

namespace latsch::experiment {

void check_duration(const Node& test, std::string_view key, double seconds, double step) {
  constexpr double kMostSteps = 2e7;
  if (seconds <= kMostSteps * step) return;
  test.reject(
      key,
      fmt::format("makes the test last {:.4g} s, which is {:.3g} steps of {:.4g} ms; expected "
                  "at most {:.0g} steps",
                  seconds,
                  seconds / step,
                  1e3 * step,
                  kMostSteps));
}

}  // namespace latsch::experiment
