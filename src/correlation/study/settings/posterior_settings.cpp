// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/settings/posterior_settings.h"

#include <fmt/format.h>

#include <limits>

namespace latsch::correlation {
namespace {

constexpr long kFewestPosteriorSamples = 100, kMostPosteriorSamples = 40'000;
// Two batches of six trials and the check of ten are the fewest that can end well.
constexpr long kFewestPosteriorRuns = 22, kMostPosteriorRuns = 1000;

int read_runs(const Node& table) {
  const long runs = table.integer("runs", 0, kMostPosteriorRuns, PosteriorSettings{}.runs);
  if (runs > 0 && runs < kFewestPosteriorRuns)
    table.reject(
        "runs",
        fmt::format("is {}, expected 0 for none, or at least {}: two batches of six trials "
                    "and the check of ten",
                    runs,
                    kFewestPosteriorRuns));
  return static_cast<int>(runs);
}

}  // namespace

PosteriorSettings read_posterior(const Node& table) {
  PosteriorSettings settings;
  settings.samples = static_cast<int>(
      table.integer("samples", kFewestPosteriorSamples, kMostPosteriorSamples, settings.samples));
  settings.runs = read_runs(table);
  settings.seed = table.integer("seed", 0, std::numeric_limits<int>::max(), 0);
  return settings;
}

}  // namespace latsch::correlation
