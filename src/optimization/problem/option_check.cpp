// SPDX-License-Identifier: Apache-2.0
#include "optimization/problem/option_check.h"

#include <fmt/format.h>

#include "base/error.h"

namespace latsch {

void OptionCheck::require(bool holds,
                          std::string_view name,
                          double found,
                          std::string_view expected) const {
  if (holds) return;
  throw InputError(fmt::format("{}: {} is {}, expected {}", method_, name, found, expected));
}

void OptionCheck::lengths(double initial,
                          double tolerance,
                          double longest,
                          std::string_view first) const {
  require(initial > 0.0 && initial <= longest,
          first,
          initial,
          fmt::format("a share of the range, above 0 and up to {}", longest));
  require(tolerance > 0.0 && tolerance < initial,
          "step tolerance",
          tolerance,
          fmt::format("above 0 and below the {}", first));
}

}  // namespace latsch
