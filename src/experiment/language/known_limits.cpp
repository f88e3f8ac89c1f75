// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/known_limits.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"

namespace latsch::experiment {

void KnowsLimits::record(const std::string& sentence) {
  if (!sentence.empty() && std::ranges::find(recorded_, sentence) == recorded_.end())
    recorded_.push_back(sentence);
}

std::vector<std::string> limits_met(Specimen& specimen) {
  const auto* knows = specimen.find<KnowsLimits>();
  if (!knows) return {};
  std::vector<std::string> all = knows->limits_met();
  all.insert(all.end(), knows->recorded().begin(), knows->recorded().end());
  return all;
}

void record_limit(Specimen& specimen, const std::string& sentence) {
  if (auto* knows = specimen.find<KnowsLimits>()) knows->record(sentence);
}

void stood_under(Specimen& specimen, const std::vector<double>& loads) {
  if (auto* knows = specimen.find<KnowsLimits>())
    for (const double load : loads) knows->stood_under(load);
}

void refuse_high_cleat(Specimen& specimen, const std::optional<Cleat>& cleat) {
  const auto* knows = specimen.find<KnowsLimits>();
  const auto section = knows ? knows->section_height() : std::nullopt;
  if (!cleat || !section || cleat->height < *section) return;
  throw InputError(
      fmt::format("cleat.height is {:.4g} mm, but the section of this tire is {:.4g} mm high: the "
                  "rim would hit "
                  "the cleat; expected a lower one",
                  1e3 * cleat->height,
                  1e3 * *section));
}

}  // namespace latsch::experiment
