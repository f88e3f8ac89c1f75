// SPDX-License-Identifier: Apache-2.0
#include "studio/views/weights.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "base/error.h"
#include "base/unit_words/c_locale.h"

namespace latsch::studio {

std::vector<double> weights_of(const std::string& text, const correlation::PartedTarget& target) {
  std::vector<double> weights = target.weights();
  const std::vector<std::string> names = target.experiments();
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t colon = part.find_last_of(':');
    const std::string name = part.substr(0, colon);
    const auto found = std::find(names.begin(), names.end(), name);
    if (colon == std::string::npos || found == names.end())
      throw InputError(fmt::format(
          "weights: \"{}\" is not EXPERIMENT:NUMBER of a fitted experiment; those are {}",
          part,
          fmt::join(names, ", ")));
    const std::string number = part.substr(colon + 1);
    [[maybe_unused]] const CLocale decimal_points;
    char* end = nullptr;
    weights[static_cast<std::size_t>(found - names.begin())] = std::strtod(number.c_str(), &end);
    if (number.empty() || *end != '\0')
      throw InputError(fmt::format("weights: \"{}\" of {} is not a number", number, name));
  }
  return weights;
}

correlation::PartedTarget::Weighting weighting_of(const std::string& text,
                                                  const correlation::PartedTarget& target) {
  return target.weighting(weights_of(text, target));
}

}  // namespace latsch::studio
