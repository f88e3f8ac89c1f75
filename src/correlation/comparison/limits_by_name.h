// SPDX-License-Identifier: Apache-2.0
// Sentences on limits of a model, each with the names of the tests or cases in which it counts.
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
  /// Returns each sentence followed by its name in the form `one`, or its names in the form
  /// `several`; "{}" stands for the names.
  std::vector<std::string> sentences(std::string_view one, std::string_view several) const {
    std::vector<std::string> all;
    for (const auto& [limit, names] : limits_)
      all.push_back(limit + fmt::format(fmt::runtime(names.size() == 1 ? one : several),
                                        fmt::format("{}", fmt::join(names, ", "))));
    return all;
  }

 private:
  std::vector<std::pair<std::string, std::vector<std::string>>> limits_;
};

}  // namespace latsch::correlation
