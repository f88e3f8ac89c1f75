// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/specimen.h"

#include <fmt/format.h>

#include <algorithm>

namespace latsch::experiment {

bool SpecimenKind::has(const std::string& ability) const {
  const auto all = abilities();
  return std::find(all.begin(), all.end(), ability) != all.end();
}

std::string SpecimenKind::text(const Document& numbers) const { return numbers.text(); }

std::string SpecimenKind::describe(const Document& numbers) const {
  return fmt::format("{}, {} numbers", in_words(), numbers.paths().size());
}

std::optional<SpecimenKind::Size> SpecimenKind::size(const Document& numbers) const {
  std::optional<double> outer, rim;
  for (const std::string& path : numbers.paths()) {
    if (path.ends_with("UNLOADED_RADIUS")) outer = numbers.get(path);
    if (path.ends_with("RIM_RADIUS")) rim = numbers.get(path);
  }
  if (!outer || !rim || !(*outer > *rim)) return std::nullopt;
  return Size{*outer, *outer - *rim};
}

}  // namespace latsch::experiment
