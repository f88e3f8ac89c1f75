// SPDX-License-Identifier: Apache-2.0
#include "optimization/problem/ending_claim.h"

#include <fmt/format.h>

namespace latsch {

std::vector<EndingClaim> claims_in(const std::string& ending) {
  if (ending.empty()) return {};
  const auto colon = ending.find(": ");
  if (colon == std::string::npos) return {{.statement = ending, .test = ""}};
  return {{.statement = ending.substr(0, colon), .test = ending.substr(colon + 2)}};
}

std::string numbers_in_words(const EndingClaim& claim) {
  if (claim.numbers.empty()) return "";
  std::string words = claim.statement;
  if (!claim.variables.empty()) words += " in " + listed(claim.variables);
  const char* between = ": ";
  for (const ClaimNumber& number : claim.numbers) {
    words += fmt::format("{}{} {:.2g}", between, number.name, number.value);
    if (!number.unit.empty()) words += " " + number.unit;
    if (number.at_most) words += fmt::format(" (at most {:.2g})", *number.at_most);
    if (number.at_least) words += fmt::format(" (at least {:.2g})", *number.at_least);
    between = ", ";
  }
  return words;
}

std::vector<std::string> tests_in_words(const std::vector<EndingClaim>& claims) {
  std::vector<std::string> tests;
  for (const EndingClaim& claim : claims)
    if (!claim.numbers.empty()) tests.push_back(numbers_in_words(claim));
  return tests;
}

std::string listed(const std::vector<std::string>& names) {
  std::string words;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) words += i + 1 < names.size() ? ", " : " and ";
    words += '"' + names[i] + '"';
  }
  return words;
}

}  // namespace latsch
