// SPDX-License-Identifier: Apache-2.0
#include "cli/console/tire_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/console/console.h"
#include "correlation/analysis/coefficient_levels.h"
#include "correlation/study/variables.h"

namespace latsch::cli {
namespace {

/// Returns " at its bound" if the variable of that path is at an end of its range.
std::string bound_in_words(const correlation::Study& study,
                           const DesignPoint& point,
                           const std::string& path) {
  constexpr double kAtBound = 1e-3;  // share of the range
  for (int i = 0; i < study.space.size(); ++i) {
    const DesignVariable& v = study.space[i];
    if (std::find(v.paths.begin(), v.paths.end(), path) == v.paths.end()) continue;
    const double u = study.space.to_unit(point)[static_cast<std::size_t>(i)];
    return u < kAtBound || u > 1.0 - kAtBound ? " at its bound" : "";
  }
  return "";
}

std::string in_words(const experiment::FaultBeyondData& fault,
                     const correlation::Study* study,
                     const DesignPoint& point) {
  std::string text;
  for (const auto& [name, value] : fault.numbers)
    text += fmt::format("{}{} = {:+.3g}{}",
                        text.empty() ? "" : ", ",
                        name,
                        value,
                        study ? bound_in_words(*study, point, name) : "");
  return "beyond the data, in ranges 1.5 times as wide: " + (text.empty() ? "" : text + ": ") +
         fault.words;
}

}  // namespace

void warn_beyond_data(const correlation::Study& study, const DesignPoint& point) {
  const experiment::SpecimenKind* kind = study.specimens->kind();
  if (!kind) return;
  const auto faults = kind->faults_beyond_data(
      correlation::at(study.model, study.space, point), [&](const std::string& condition) {
        return correlation::driven_at(study, condition, /*fitted_only=*/true);
      });
  for (const auto& fault : faults) warn(in_words(fault, &study, point), {study.file.string(), 0});
}

void warn_beyond_data(const experiment::SpecimenKind& kind,
                      const Document& numbers,
                      const std::string& file) {
  for (const auto& fault : kind.faults_beyond_data(numbers))
    warn(in_words(fault, nullptr, {}), {file, 0});
}

}  // namespace latsch::cli
