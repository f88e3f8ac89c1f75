// SPDX-License-Identifier: Apache-2.0
// Sentences about limits of a model, each with the names of the tests or cases in which the limit
// was met.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace latsch::correlation {

class LimitsByName {
 public:
  void add(const std::string& limit, const std::string& name) {
    auto known = std::find_if(
        limits_.begin(), limits_.end(), [&](const auto& one) { return one.first == limit; });
    if (known == limits_.end()) known = limits_.insert(known, {limit, {}});
    if (std::ranges::find(known->second, name) == known->second.end())
      known->second.push_back(name);
  }
  /// Returns "name, name: sentence" for each sentence.
  std::vector<std::string> after_names() const {
    std::vector<std::string> all;
    for (const auto& [limit, names] : limits_)
      all.push_back(fmt::format("{}: {}", fmt::join(names, ", "), limit));
    return all;
  }
  /// Returns "sentence (name, name)" for each sentence.
  std::vector<std::string> before_names() const {
    std::vector<std::string> all;
    for (const auto& [limit, names] : limits_)
      all.push_back(fmt::format("{} ({})", limit, fmt::join(names, ", ")));
    return all;
  }

 private:
  std::vector<std::pair<std::string, std::vector<std::string>>> limits_;
};

}  // namespace latsch::correlation
