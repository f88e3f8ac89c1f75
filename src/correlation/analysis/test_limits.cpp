// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/test_limits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "experiment/language/known_limits.h"

namespace latsch::correlation {

std::vector<std::string> limits_of_tests(const Study& study) {
  std::vector<std::pair<std::string, std::vector<std::string>>> limits;  // with their tests
  std::unique_ptr<experiment::Specimen> specimen;
  for (const StudyTest& test : study.tests) {
    const auto* tells = dynamic_cast<const experiment::TellsLimits*>(test.test.get());
    if (!tells) continue;
    try {
      if (!specimen) specimen = study.specimens->at(study, study.space.initial(), nullptr);
      for (const std::string& limit : tells->limits(*specimen)) {
        auto known = std::find_if(
            limits.begin(), limits.end(), [&](const auto& one) { return one.first == limit; });
        if (known == limits.end()) known = limits.insert(known, {limit, {}});
        known->second.push_back(test.in_words());
      }
    } catch (const InputError&) {
      return {};
    }
  }
  std::vector<std::string> sentences;
  for (const auto& [limit, tests] : limits)
    sentences.push_back(fmt::format("{}: {}", fmt::join(tests, ", "), limit));
  return sentences;
}

}  // namespace latsch::correlation
