// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/study_slopes.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "correlation/study/study_optimizer.h"

namespace latsch::correlation {
namespace {

const StudyTest* find_test(const Study& study, const std::string& name) {
  for (const StudyTest& test : study.tests)
    if (test.name == name) return &test;
  return nullptr;
}

bool uses_slopes(const OptimizerSettings& settings, const ProblemTraits& traits) {
  switch (method_of(settings, traits).method) {
    case Method::levenberg_marquardt:
      return true;
    case Method::sqp:
      return !traits.has_nonlinear_constraints;
    case Method::ensemble:
      return std::any_of(settings.members.begin(), settings.members.end(), [&](const auto& member) {
        return uses_slopes(member.settings, traits);
      });
    default:
      return false;
  }
}

}  // namespace

std::optional<std::string> reason_without_slopes(const Study& study) {
  const experiment::SpecimenKind* kind = study.specimens->kind();
  if (!kind) return "an outside program reports no slopes";
  const MovedNumbers moved(study.space);
  for (const std::string& path : moved.paths())
    if (!kind->knows_slopes_in(path))
      return fmt::format("a {} does not know its slopes in {}", kind->in_words(), in_quotes(path));
  for (const StudyExperiment& experiment : study.experiments) {
    if (!experiment.fitted) continue;
    if (!experiment.observable->passes_slopes())
      return fmt::format("experiment {} compares {}, whose slopes are not known",
                         experiment.name,
                         experiment.observable->compared(experiment.objective));
    for (const std::string& channel : experiment.observable->asks()) {
      const StudyTest* test = find_test(study, test_of(channel));
      if (!test || !test->test->tells_slopes(*kind, channel.substr(test->name.size() + 1)))
        return fmt::format("experiment {} compares {}, for which that test has no slopes",
                           experiment.name,
                           channel);
      const std::string why = kind->why_without_slopes(study.model, *test->test, moved.paths());
      if (!why.empty()) return fmt::format("{}: {}", test->in_words(), why);
    }
  }
  return std::nullopt;
}

bool asks_slopes(const Study& study) {
  if (reason_without_slopes(study)) return false;
  ProblemTraits traits = traits_of_residuals(study.space, !study.constraints.empty());
  traits.has_jacobian = true;
  return uses_slopes(study.optimizer, traits);
}

MovedNumbers::MovedNumbers(const DesignSpace& space)
    : variables_(static_cast<std::size_t>(space.size())) {
  for (std::size_t i = 0; i < variables_; ++i) {
    const DesignVariable& variable = space.variables()[i];
    for (const std::string& path : variable.paths) add(path, {i, 1.0});
    for (const Follower& follower : variable.followers)
      for (const std::string& path : follower.paths) add(path, {i, follower.factor});
  }
}

void MovedNumbers::add(const std::string& path, const Moved& by) {
  paths_.push_back(path);
  moved_.push_back(by);
}

experiment::Asked MovedNumbers::asked_of(const Study& study, const StudyTest& test) const {
  experiment::Asked asked{{}, paths_};
  for (const StudyExperiment& experiment : study.experiments) {
    if (!experiment.fitted) continue;
    for (const std::string& channel : experiment.observable->asks()) {
      if (test_of(channel) == test.name)
        asked.channels.push_back(channel.substr(test.name.size() + 1));
    }
  }
  return asked;
}

std::vector<double> MovedNumbers::in_variables(const std::vector<double>& slopes) const {
  const std::size_t rows = slopes.size() / moved_.size();
  std::vector<double> of_variables(rows * variables_, 0.0);
  for (std::size_t k = 0; k < moved_.size(); ++k) {
    double* column = &of_variables[moved_[k].variable * rows];
    for (std::size_t i = 0; i < rows; ++i) column[i] += moved_[k].factor * slopes[k * rows + i];
  }
  return of_variables;
}

}  // namespace latsch::correlation
