// SPDX-License-Identifier: Apache-2.0
// Checks the options of a method and reports faults in the same words for all methods.
#pragma once

#include <string_view>

namespace latsch {

class OptionCheck {
 public:
  explicit OptionCheck(std::string_view method) : method_(method) {}

  /// Throws InputError unless `holds`, with a message such as "GSS: contraction is 2, expected
  /// between 0 and 1".
  void require(bool holds, std::string_view name, double found, std::string_view expected) const;

  /// Requires 0 < tolerance < initial <= longest, all as shares of the range. `first` is the word
  /// by which the method calls its initial length, for example "step".
  void lengths(double initial,
               double tolerance,
               double longest,
               std::string_view first = "initial step") const;

 private:
  std::string_view method_;
};

}  // namespace latsch
