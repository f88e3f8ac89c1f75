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

std::string unlike_spreads_in_words(const Study& study, const Identification& identification) {
  constexpr double kRare = 3.3;    // deviations of the logarithm of a ratio; chance: 1 in 1000
  constexpr double kUnlike = 2.0;  // ratio of the spreads below which intervals differ little
  constexpr double kFewest = 3.0;  // values that show a spread
  const Confidence& c = identification.confidence();
  const bool is_known =
      std::any_of(study.experiments.begin(), study.experiments.end(), [](const auto& one) {
        return one.noise || one.estimates_noise;
      });
  if (is_known || !std::isfinite(c.sigma) || c.with_loss > 0) return "";
  const Eigen::VectorXd& r = identification.linearization().r;
  const auto& used = identification.residuals_used();
  const std::vector<ResidualRow> rows = residual_rows(study);
  std::vector<NoiseRatio> all(study.experiments.size());
  for (Eigen::Index k = 0; k < r.size(); ++k) {
    const auto place = static_cast<std::size_t>(used[static_cast<std::size_t>(k)]);
    if (rows[place].experiment < 0) continue;
    const auto e = static_cast<std::size_t>(rows[place].experiment);
    const double d = rows[place].unit * r[k];
    all[e].name = study.experiments[e].name;
    all[e].ratio += d * d;
    all[e].values += 1.0;
  }
  std::erase_if(all, [](const NoiseRatio& one) { return one.values < kFewest; });
  if (all.size() < 2) return "";
  for (NoiseRatio& one : all) one.ratio = std::sqrt(one.ratio / one.values);
  const auto [quiet, loud] = std::minmax_element(
      all.begin(), all.end(), [](const auto& a, const auto& b) { return a.ratio < b.ratio; });
  const double unlike = loud->ratio / quiet->ratio;
  const double by_chance = std::sqrt(0.5 / quiet->values + 0.5 / loud->values);
  if (!(unlike > kUnlike) || !(std::log(unlike) > kRare * by_chance)) return "";
  return fmt::format(
      "No experiment states its noise, so all share one spread, but {} scatters by {:.2g} % and {} "
      "by "
      "{:.2g} %: intervals of what {} determines are too wide, and of what {} determines too "
      "narrow. State the noise of each experiment, or noise = \"estimated\".",
      quiet->name,
      100.0 * quiet->ratio,
      loud->name,
      100.0 * loud->ratio,
      quiet->name,
      loud->name);
}

std::string scarce_estimates_in_words(const Study& study, const Confidence& c) {
  constexpr double kFewest =
      1.5;  // values left; with fewer, 95 % intervals hold in some 70 to 90 %
  std::vector<std::string> named;
  int group = 0;
  for (const StudyExperiment& experiment : study.experiments) {
    if (!counts(experiment)) continue;
    const auto found = c.group_freedoms.find(group++);
    if (found != c.group_freedoms.end() && found->second < kFewest)
      named.push_back(fmt::format("{} ({:.1f} values left)", experiment.name, found->second));
  }
  if (named.empty()) return "";
  return fmt::format(
      "The fit uses up nearly all values of {}, so they hardly show their noise: a fit weighs such "
      "values by a noise that it may itself have made small, and the intervals contain the truth "
      "less often than they say. State the noise of these experiments.",
      fmt::join(named, ", "));
}

}  // namespace latsch::correlation
