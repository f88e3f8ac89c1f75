// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/settings/posterior_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace latsch::correlation {
namespace {

constexpr long kFewestPosteriorSamples = 100, kMostPosteriorSamples = 40'000;
// Two batches of six trials and the check of ten are the fewest that can end well.
constexpr long kFewestPosteriorRuns = 22, kMostPosteriorRuns = 1000;

constexpr long kFewestChainRuns = 2000, kMostChainRuns = 90'000;

PosteriorMethod read_method(const Node& table) {
  const std::vector<std::string> names{"surrogate", "delayed", "model"};
  const std::string name = table.choice("method", names, names.front());
  return static_cast<PosteriorMethod>(std::find(names.begin(), names.end(), name) - names.begin());
}

long read_chain_runs(const Node& table, PosteriorMethod method) {
  if (method == PosteriorMethod::surrogate) {
    if (table.has("chain_runs"))
      table.reject("chain_runs",
                   "is given for the method \"surrogate\", whose chains run no trial; expected "
                   "method = \"delayed\" or \"model\", or no chain_runs");
    return 0;
  }
  return table.integer("chain_runs",
                       kFewestChainRuns,
                       kMostChainRuns,
                       method == PosteriorMethod::delayed ? kDelayedRuns : kModelRuns);
}

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

const char* name(PosteriorMethod method) {
  switch (method) {
    case PosteriorMethod::surrogate:
      return "surrogate";
    case PosteriorMethod::delayed:
      return "delayed";
    case PosteriorMethod::model:
      break;
  }
  return "model";
}

PosteriorSettings read_posterior(const Node& table) {
  PosteriorSettings settings;
  settings.samples = static_cast<int>(
      table.integer("samples", kFewestPosteriorSamples, kMostPosteriorSamples, settings.samples));
  settings.method = read_method(table);
  settings.runs = read_runs(table);
  if (settings.method == PosteriorMethod::model) {
    if (table.has("runs"))
      table.reject("runs",
                   "is given for the method \"model\", which has no surrogate that could learn; "
                   "expected chain_runs, the most trials of its chains");
    settings.runs = 0;
  }
  settings.chain_runs = read_chain_runs(table, settings.method);
  settings.seed = table.integer("seed", 0, std::numeric_limits<int>::max(), 0);
  return settings;
}

}  // namespace latsch::correlation
