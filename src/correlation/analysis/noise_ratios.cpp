// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/noise_ratios.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "correlation/target/residuals.h"

namespace latsch::correlation {

std::vector<NoiseRatio> noise_ratios(const Study& study, const Identification& identification) {
  constexpr double kFar = 3.0;  // deviations of a prior
  const Confidence& c = identification.confidence();
  const Eigen::VectorXd& r = identification.linearization().r;
  const auto& used = identification.residuals_used();
  const std::vector<ResidualRow> rows = residual_rows(study);
  if (std::ssize(used) != r.size()) return {};
  std::vector<NoiseRatio> all(study.experiments.size());
  for (Eigen::Index k = 0; k < r.size(); ++k) {
    const ResidualRow& row = rows[static_cast<std::size_t>(used[static_cast<std::size_t>(k)])];
    const double ratio = std::abs(r[k]) * c.excess / c.sigma;
    if (row.experiment < 0) {
      if (ratio > kFar) all.push_back({row.name, ratio, 1.0});
      continue;
    }
    NoiseRatio& one = all[static_cast<std::size_t>(row.experiment)];
    one.ratio += ratio * ratio;
    one.values += 1.0;
  }
  for (std::size_t e = 0; e < study.experiments.size(); ++e) {
    const double weight = study.experiments[e].objective.weight;
    if (weight > 0.0 && all[e].values > 0.0)
      all[e].ratio = std::sqrt(all[e].ratio / (all[e].values * weight));
    else
      all[e].values = 0.0;
    all[e].name = study.experiments[e].name;
  }
  std::erase_if(all, [](const NoiseRatio& one) { return one.values == 0.0; });
  std::stable_sort(
      all.begin(), all.end(), [](const auto& x, const auto& y) { return x.ratio > y.ratio; });
  return all;
}

std::string in_words(const std::vector<NoiseRatio>& ratios) {
  constexpr std::size_t kMostNamed = 6;
  if (ratios.size() < 2) return "";
  std::string text;
  for (std::size_t k = 0; k < std::min(ratios.size(), kMostNamed); ++k)
    text += fmt::format(", {} {:.2g}", ratios[k].name, ratios[k].ratio);
  if (ratios.size() > kMostNamed)
    text += fmt::format(", others at most {:.2g}", ratios[kMostNamed].ratio);
  return " (by source" + text.substr(1) + ")";
}

std::string large_noise_in_words(const Study& study, const std::vector<NoiseRatio>& ratios) {
  constexpr double kFewest = 20.0, kSmall = 0.5;
  std::vector<std::string> named;
  for (const NoiseRatio& one : ratios)
    for (const StudyExperiment& experiment : study.experiments)
      if (experiment.name == one.name && experiment.noise && !experiment.estimates_noise &&
          one.values >= kFewest && one.ratio < kSmall)
        named.push_back(fmt::format("{} {:.2g}", one.name, one.ratio));
  if (named.empty()) return "";
  return fmt::format(
      "Residuals are much less than their stated noise: {} times. That noise is stated too large, "
      "which weighs these values too little, or the values were smoothed.",
      fmt::join(named, ", "));
}

}  // namespace latsch::correlation
