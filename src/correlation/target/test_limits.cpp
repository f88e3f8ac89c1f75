// SPDX-License-Identifier: Apache-2.0
#include "correlation/target/test_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <mutex>

#include "correlation/target/limits_by_name.h"
#include "correlation/target/predictions.h"
#include "experiment/language/known_limits.h"

namespace latsch::correlation {

namespace {

/// The limits of a study or at one of its points, kept because terminal, page and report request
/// them one after the other.
struct KnownLimits {
  std::string of;  // identity of the study and the point
  std::vector<std::string> sentences;
};

/// Returns a text that differs for studies and points whose tests differ.
std::string identity_text(const Study& study, const DesignPoint& point) {
  std::string text;
  for (const IdentityPart& part : identity(study)) text += part.name + "\n" + part.text + "\n";
  return text + point.bits();
}

/// Returns the sentences that were kept for the point `of`. If there are none, finds them and keeps
/// them; only the most recent few are kept.
template <class Find>
std::vector<std::string> known_or(const std::string& of, const Find& find) {
  constexpr std::size_t kKept = 8;
  static std::mutex mutex;
  static std::vector<KnownLimits> kept;
  {
    const std::lock_guard lock(mutex);
    const auto known = std::ranges::find(kept, of, &KnownLimits::of);
    if (known != kept.end()) return known->sentences;
  }
  std::vector<std::string> sentences = find();
  const std::lock_guard lock(mutex);
  if (kept.size() == kKept) kept.erase(kept.begin());
  kept.push_back({of, sentences});
  return sentences;
}

/// Returns the limits that a test can state without a simulation.
std::vector<std::string> told_by(const StudyTest& test, experiment::Specimen& specimen) {
  const auto* tells = dynamic_cast<const experiment::TellsLimits*>(test.test.get());
  return tells ? tells->limits(specimen) : std::vector<std::string>();
}

/// Returns the point with the initial values, but one variable at a bound.
DesignPoint at_bound(const Study& study, int variable, bool is_upper) {
  DesignPoint point = study.space.initial();
  const DesignVariable& varied = study.space[variable];
  point.values[static_cast<std::size_t>(variable)] = is_upper ? varied.upper : varied.lower;
  return point;
}

/// Adds the limits of a test that trials meet only if they move the limit itself, because the study
/// varies an end of a range of the tire's file: those with this variable at its bounds.
void add_moved(const Study& study,
               const StudyTest& test,
               experiment::Specimen& initial,
               const std::vector<std::string>& known,
               LimitsByName& limits) {
  const auto* knows = initial.find<experiment::KnowsLimits>();
  for (int i = 0; knows && i < study.space.size(); ++i) {
    const DesignVariable& variable = study.space[i];
    if (std::ranges::none_of(variable.paths,
                             [&](const std::string& path) { return knows->is_limit(path); }))
      continue;
    for (const bool is_upper : {false, true}) {
      const auto moved = study.specimens->at(study, at_bound(study, i, is_upper), nullptr);
      for (const std::string& limit : told_by(test, *moved))
        if (std::ranges::find(known, limit) == known.end())
          limits.add(limit,
                     fmt::format("{}, in trials with {} at its {} bound",
                                 test.in_words(),
                                 variable.name,
                                 is_upper ? "upper" : "lower"));
    }
  }
}

std::vector<std::string> told_limits(const Study& study) {
  LimitsByName limits;
  std::unique_ptr<experiment::Specimen> specimen;
  for (const StudyTest& test : study.tests) {
    if (!dynamic_cast<const experiment::TellsLimits*>(test.test.get())) continue;
    try {
      if (!specimen) specimen = study.specimens->at(study, study.space.initial(), nullptr);
      const std::vector<std::string> known = told_by(test, *specimen);
      for (const std::string& limit : known) limits.add(limit, test.in_words());
      add_moved(study, test, *specimen, known, limits);
    } catch (const InputError&) {
      return {};
    }
  }
  return limits.after_names();
}

std::vector<std::string> found_limits(const Study& whole, const DesignPoint& point) {
  LimitsByName limits;
  const auto asked = tests_asked_for(whole);
  for (const StudyTest& test : whole.tests) {
    if (std::find(asked.begin(), asked.end(), test.name) == asked.end()) continue;
    try {
      const auto specimen = whole.specimens->at(whole, point, nullptr);
      for (const std::string& limit : told_by(test, *specimen)) limits.add(limit, test.in_words());
      if (!specimen->find<experiment::KnowsLimits>() || !test.test->run(*specimen)) continue;
      for (const std::string& limit : experiment::limits_met(*specimen))
        limits.add(limit, test.in_words());
    } catch (const InputError&) {
      continue;  // a predicted test that does not accept the point reports this itself
    }
  }
  return limits.after_names();
}

}  // namespace

std::vector<std::string> limits_of_tests(const Study& study) {
  return known_or("tests of\n" + identity_text(study, study.space.initial()),
                  [&] { return told_limits(study); });
}

std::vector<std::string> limits_met_at(const Study& study, const DesignPoint& point) {
  if (!study.specimens->may_repeat()) return {};
  const Study whole = with_predictions(study);
  return known_or(identity_text(whole, point), [&] { return found_limits(whole, point); });
}

}  // namespace latsch::correlation
