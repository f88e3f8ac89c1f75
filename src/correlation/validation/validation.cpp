// SPDX-License-Identifier: Apache-2.0
#include "correlation/validation/validation.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/units.h"
#include "evaluation/trial/trial.h"
#include "experiment/language/known_limits.h"

namespace latsch::correlation {
namespace {

constexpr int kDigits = 4;
// Relative tolerance of limits: a limit stated in percent and an error from a division may differ
// in their last bits.
constexpr double kRounding = 1e-12;

/// Returns false for NaN.
bool is_within(double value,
               const std::optional<double>& lower,
               const std::optional<double>& upper) {
  if (!std::isfinite(value)) return false;
  const auto room = [](double limit) { return kRounding * std::abs(limit); };
  return (!lower || value >= *lower - room(*lower)) && (!upper || value <= *upper + room(*upper));
}

/// Recordings of the tests, and the reasons why some tests have none.
struct Recorded {
  Channels channels;
  std::map<std::string, std::string> failures;  // keyed by test
};

std::vector<std::string> channels_of(const Check& check) {
  return check.experiment ? check.experiment->observable->asks()
                          : std::vector<std::string>{check.number.channel};
}

bool is_asked_for(const Suite& suite, const StudyTest& test) {
  for (const Check& check : suite.checks)
    for (const std::string& channel : channels_of(check))
      if (test_of(channel) == test.name) return true;
  return false;
}

Recorded record(const Suite& suite,
                experiment::Specimen& specimen,
                const std::function<void(const std::string&)>& tell) {
  Recorded all;
  for (const StudyTest& test : suite.tests) {
    if (!is_asked_for(suite, test)) continue;
    tell(test.name);
    const auto recording = [&]() -> Result<Channels> {
      try {
        return test.test->run(specimen);
      } catch (const InputError& error) {
        return Failure{error.what()};
      }
    }();
    if (!recording) {
      all.failures[test.name] = test.test->in_words() + ": " + recording.failure().reason;
      continue;
    }
    for (Channel channel : recording->all()) {
      channel.name = test.name + "/" + channel.name;
      all.channels.add(std::move(channel));
    }
  }
  return all;
}

/// Returns the results of a check before they have values: one for each limit.
std::vector<CheckResult> limits_of(const Check& check) {
  std::vector<CheckResult> results;
  if (!check.experiment) {
    const ChannelConstraint& number = check.number;
    results.push_back({check.name,
                       number.of + " " + number.channel,
                       {},
                       number.lower,
                       number.upper,
                       number.unit,
                       check.source,
                       {}});
    return results;
  }
  const StudyExperiment& experiment = *check.experiment;
  const std::string of = " error of " + experiment.observable->compared(experiment.objective);
  if (check.mean_error)
    results.push_back({check.name, "mean" + of, {}, {}, check.mean_error, "%", check.source, {}});
  if (check.largest_error)
    results.push_back(
        {check.name, "largest" + of, {}, {}, check.largest_error, "%", check.source, {}});
  return results;
}

/// Returns the values of the results of a check; a Failure if there are none.
Result<std::vector<double>> values_of(const Check& check,
                                      const std::vector<StudyTest>& tests,
                                      const Recorded& recorded,
                                      report::StudyReport& page) {
  for (const std::string& channel : channels_of(check)) {
    const auto failure = recorded.failures.find(test_of(channel));
    if (failure != recorded.failures.end()) return Failure{failure->second};
    Channels asked;
    if (const Channel* found = recorded.channels.find(channel)) asked.add(*found);
    const auto numbers = finite(std::move(asked));
    if (!numbers) return numbers.failure();
  }
  if (!check.experiment) {
    const auto value = value_of(check.number, recorded.channels);
    if (!value) return value.failure();
    return std::vector<double>{*value};
  }
  const StudyExperiment& experiment = *check.experiment;
  const auto comparison = comparison_of(experiment, {experiment}, recorded.channels);
  if (!comparison) return comparison.failure();
  experiment.observable->draw({.name = check.name,
                               .conditions = conditions_of(experiment, tests),
                               .fitted = false,
                               .found = recorded.channels,
                               .comparison = *comparison},
                              page);
  std::vector<double> values;
  if (check.mean_error) values.push_back(comparison->mean_error);
  if (check.largest_error) values.push_back(comparison->largest_error);
  return values;
}

}  // namespace

bool Validation::accepted() const {
  return std::all_of(
      results.begin(), results.end(), [](const CheckResult& one) { return one.accepted; });
}

Validation validate(const Suite& suite,
                    const experiment::SpecimenKind& kind,
                    const Document& numbers,
                    const std::function<void(const std::string& test)>& tell) {
  Validation validation;
  report::StudyReport& page = validation.page;
  page.title = suite.title;
  page.study_file = suite.file.string();
  page.tire = kind.describe(numbers);
  const auto specimen = kind.build(numbers);
  const Recorded recorded = record(suite, *specimen, tell);
  validation.notes = experiment::limits_met(*specimen);
  for (const StudyTest& test : suite.tests) {
    const auto* tells = dynamic_cast<const experiment::TellsLimits*>(test.test.get());
    if (!tells || !is_asked_for(suite, test) || recorded.failures.contains(test.name)) continue;
    for (const std::string& limit : tells->limits(*specimen))
      validation.notes.push_back(test.in_words() + ": " + limit);
  }
  for (const Check& check : suite.checks) {
    const auto values = values_of(check, suite.tests, recorded, page);
    auto results = limits_of(check);
    for (std::size_t i = 0; i < results.size(); ++i) {
      CheckResult& one = results[i];
      if (values) {
        one.value = (*values)[i];
        one.accepted = is_within(*one.value, one.lower, one.upper);
      } else {
        one.reason = values.failure().reason;
      }
      page.checks.push_back({one.check,
                             one.what,
                             value_text(one),
                             limit_text(one),
                             one.source,
                             one.reason,
                             one.accepted});
      validation.results.push_back(std::move(one));
    }
  }
  return validation;
}

std::string value_text(const CheckResult& result) {
  return result.value ? format_quantity(*result.value, result.unit, kDigits) : "–";
}

std::string limit_text(const CheckResult& result) {
  const auto text = [&](double limit) { return format_quantity(limit, result.unit, kDigits); };
  if (result.lower && result.upper) return text(*result.lower) + " .. " + text(*result.upper);
  return result.lower ? "at least " + text(*result.lower) : "at most " + text(*result.upper);
}

}  // namespace latsch::correlation
