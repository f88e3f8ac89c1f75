// SPDX-License-Identifier: Apache-2.0
// What is wrong with the options of a method, in the same words for all of them.
#pragma once

#include <string_view>

namespace latsch {

class OptionCheck {
 public:
  explicit OptionCheck(std::string_view method) : method_(method) {}

  /// Throws InputError: "GSS: contraction is 2, expected between 0 and 1".
  void require(bool holds, std::string_view name, double found, std::string_view expected) const;

  /// 0 < tolerance < initial <= longest, shares of the range; `first` is what the method calls its
  /// first length: "step".
  void lengths(double initial,
               double tolerance,
               double longest,
               std::string_view first = "initial step") const;

 private:
  std::string_view method_;
};

}  // namespace latsch
