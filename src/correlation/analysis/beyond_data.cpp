// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/beyond_data.h"

#include <fmt/format.h>

#include <algorithm>

#include "correlation/analysis/coefficient_levels.h"
#include "correlation/study/variables.h"

namespace latsch::correlation {
namespace {

/// Returns " at its bound" if the variable of the given path is at a bound, "" otherwise.
std::string bound_in_words(const Study& study, const DesignPoint& point, const std::string& path) {
  constexpr double kAtBound = 1e-3;  // share of the range
  for (int i = 0; i < study.space.size(); ++i) {
    const DesignVariable& v = study.space[i];
    if (std::find(v.paths.begin(), v.paths.end(), path) == v.paths.end()) continue;
    const double u = study.space.to_unit(point)[static_cast<std::size_t>(i)];
    return u < kAtBound || u > 1.0 - kAtBound ? " at its bound" : "";
  }
  return "";
}

}  // namespace

std::string in_words(const experiment::FaultBeyondData& fault,
                     const Study* study,
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

std::vector<std::string> faults_beyond_data(const Study& study, const DesignPoint& point) {
  const experiment::SpecimenKind* kind = study.specimens->kind();
  if (!kind) return {};
  std::vector<std::string> all;
  for (const auto& fault : kind->faults_beyond_data(
           at(study.model, study.space, point), [&](const std::string& condition) {
             return driven_at(study, condition, /*fitted_only=*/true);
           }))
    all.push_back(in_words(fault, &study, point));
  return all;
}

std::vector<std::string> untold_in_words(const Study& study) {
  std::vector<std::string> all;
  for (const UntoldCoefficient& one : untold_coefficients(study))
    all.push_back("variable " + one.variable + " is free" +
                  (one.stage.empty() ? "" : " in stage " + one.stage) + ", but " + one.reason +
                  ": the measurement does not determine it; leave it out, or measure more levels");
  return all;
}

}  // namespace latsch::correlation
