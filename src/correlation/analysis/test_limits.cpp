// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/test_limits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "correlation/target/predictions.h"
#include "experiment/language/known_limits.h"

namespace latsch::correlation {

namespace {

/// Sentences, each with the tests to which it belongs.
class LimitsByTest {
 public:
  void add(const std::string& limit, const std::string& test) {
    auto known = std::find_if(
        limits_.begin(), limits_.end(), [&](const auto& one) { return one.first == limit; });
    if (known == limits_.end()) known = limits_.insert(known, {limit, {}});
    known->second.push_back(test);
  }
  std::vector<std::string> sentences() const {
    std::vector<std::string> all;
    for (const auto& [limit, tests] : limits_)
      all.push_back(fmt::format("{}: {}", fmt::join(tests, ", "), limit));
    return all;
  }

 private:
  std::vector<std::pair<std::string, std::vector<std::string>>> limits_;
};

}  // namespace

std::vector<std::string> limits_of_tests(const Study& study) {
  LimitsByTest limits;
  std::unique_ptr<experiment::Specimen> specimen;
  for (const StudyTest& test : study.tests) {
    const auto* tells = dynamic_cast<const experiment::TellsLimits*>(test.test.get());
    if (!tells) continue;
    try {
      if (!specimen) specimen = study.specimens->at(study, study.space.initial(), nullptr);
      for (const std::string& limit : tells->limits(*specimen)) limits.add(limit, test.in_words());
    } catch (const InputError&) {
      return {};
    }
  }
  return limits.sentences();
}

std::vector<std::string> limits_met_at(const Study& study, const DesignPoint& point) {
  LimitsByTest limits;
  const Study whole = with_predictions(study);
  const auto asked = tests_asked_for(whole);
  for (const StudyTest& test : whole.tests) {
    if (std::find(asked.begin(), asked.end(), test.name) == asked.end()) continue;
    try {
      const auto specimen = whole.specimens->at(whole, point, nullptr);
      if (!specimen->find<experiment::KnowsLimits>()) return {};
      if (!test.test->run(*specimen)) continue;
      for (const std::string& limit : experiment::limits_met(*specimen))
        limits.add(limit, test.in_words());
    } catch (const InputError&) {
      continue;  // a predicted test that does not accept the point reports this itself
    }
  }
  return limits.sentences();
}

}  // namespace latsch::correlation
