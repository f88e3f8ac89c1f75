// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/identification_rounds.h"

#include <map>
#include <set>
#include <utility>

#include "correlation/analysis/in_rounds.h"
#include "correlation/target/residuals.h"

namespace latsch::correlation {
namespace {

constexpr double kRefitTolerance = 0.02;  // share of the threshold that ends an interval

/// Omits each experiment in turn, except for residuals that the identification does not use.
class UsedRows {
 public:
  UsedRows(CrossValidation& validation, const std::vector<Eigen::Index>& rows)
      : validation_(validation), rows_(rows) {}

  const std::vector<DesignPoint>& wanted() const { return validation_.wanted(); }
  void observe(std::vector<Result<Evaluated>> evaluated) {
    for (auto& one : evaluated) {
      if (one) one = one->of(rows_);
    }
    validation_.observe(evaluated);
  }

 private:
  CrossValidation& validation_;
  const std::vector<Eigen::Index>& rows_;
};

WorkDone omitting(const CrossValidation& validation) {
  return {"fits that omit one experiment", validation.share_done(), 0};
}

/// Omits each experiment in turn, using the reduced rows of the trials (reduced_rows.h).
bool cross_validate_reduced(const IdentificationTrials& trials,
                            Identifiability& result,
                            const std::vector<int>& group,
                            double tolerance) {
  const Study& study = trials.study;
  const Identification& identification = result.identification;
  const std::vector<Eigen::Index>& used = identification.residuals_used();
  std::map<int, std::size_t> place;
  std::vector<int> names;
  RowGroups rows, places;  // indices among all residuals and among the used ones
  for (std::size_t k = 0; k < group.size(); ++k) {
    const auto [at, is_new] = place.emplace(group[k], rows.size());
    if (is_new) {
      rows.emplace_back();
      places.emplace_back();
      names.push_back(group[k]);
    }
    rows[at->second].push_back(used[k]);
    places[at->second].push_back(static_cast<Eigen::Index>(k));
  }
  const Linearization& at = identification.refitted();
  const Evaluated best = reduced_rows({at.r, at.J}, places);
  std::vector<int> reduced_group;
  for (const int g : groups_of_reduced_rows(places, at.J.cols()))
    reduced_group.push_back(names[static_cast<std::size_t>(g)]);
  std::map<int, Eigen::Index> values;
  for (std::size_t g = 0; g < names.size(); ++g) values[names[g]] = std::ssize(places[g]);
  result.cross_validation.emplace(study.space,
                                  Linearization{at.u, best.r, best.J, true},
                                  reduced_group,
                                  tolerance,
                                  study.free,
                                  values);
  CrossValidation& validation = *result.cross_validation;
  RefitTrials refits = trials.refits(rows, at);
  InRounds<CrossValidation> rounds(study.space, validation, /*reduced=*/true);
  return trials.drive(rounds, &refits, [&] { return omitting(validation); });
}

WorkDone standing_of(const Identification& identification) {
  switch (identification.phase()) {
    case Identification::Phase::derivatives:
      return {"derivatives around the best trial", 0.0, identification.expected_left()};
    case Identification::Phase::refit:
      return {"refit of all variables", 0.0, identification.expected_left()};
    case Identification::Phase::profiles:
      break;
  }
  return {"profiles, the other variables refitted",
          identification.share_done(),
          identification.expected_left()};
}

bool cross_validate(const IdentificationTrials& trials, Identifiability& result) {
  const Study& study = trials.study;
  const Identification& identification = result.identification;
  const auto rows = residual_rows(study);
  std::vector<int> group;
  for (Eigen::Index row : identification.residuals_used()) group.push_back(rows[row].owner());
  std::set<int> groups(group.begin(), group.end());
  groups.erase(-1);  // priors
  if (groups.size() < 2) return true;
  const double tolerance = kRefitTolerance * identification.confidence().threshold();
  if (identification.refitted().is_exact)
    return cross_validate_reduced(trials, result, group, tolerance);
  result.cross_validation.emplace(
      study.space, identification.refitted(), group, tolerance, study.free);
  UsedRows used(*result.cross_validation, identification.residuals_used());
  InRounds<UsedRows> rounds(study.space, used);
  return trials.drive(rounds, nullptr, [&] { return omitting(*result.cross_validation); });
}

}  // namespace

IdentificationOptions options_for(const Study& study, Depth depth) {
  constexpr double kLeastNoise = 1e-5;  // residuals are relative if no noise is stated
  IdentificationOptions options;
  options.confidence.sigma = residual_sigma(study);
  options.confidence.least_noise = kLeastNoise;
  options.confidence.traits = residual_traits(study);
  options.profiles = depth == Depth::profiles;
  if (depth == Depth::at_the_point) options.most_centers = 1;
  options.free = study.free;
  return options;
}

RefitTrials IdentificationTrials::refits(const RowGroups& groups, const Linearization& at) const {
  return RefitTrials(study, journal, groups, at, writable);
}

bool analyze(const IdentificationTrials& trials, Identifiability& result) {
  Identification& identification = result.identification;
  while (!identification.wanted().empty()) {
    const bool profiling = identification.is_profiling();
    const bool reduced = profiling && identification.refitted().is_exact;
    std::optional<RefitTrials> refits;
    if (reduced)
      refits.emplace(trials.refits({identification.residuals_used()}, identification.refitted()));
    const auto ends = [&] { return identification.is_profiling() != profiling; };
    InRounds<Identification> rounds(trials.study.space, identification, reduced, ends);
    const auto standing = [&] { return standing_of(identification); };
    if (!trials.drive(rounds, refits ? &*refits : nullptr, standing)) return false;
  }
  if (identification.profiles().empty()) return true;
  return cross_validate(trials, result);
}

Drive reading(const Study& study, const Journal& journal) {
  return [&study, &journal](Optimizer& optimizer, RefitTrials* refits, const AsksWorkDone&) {
    const TrialStore& store = refits ? static_cast<const TrialStore&>(*refits) : journal;
    const Objective objective = refits ? refits->objective() : residual_objective(study);
    return replay(optimizer, objective, store, kMostIdentificationTrials).end == RunEnd::converged;
  };
}

}  // namespace latsch::correlation
