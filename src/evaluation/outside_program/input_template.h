// SPDX-License-Identifier: Apache-2.0
// Input file of an outside program with holes for the design variables.
//
//   *ELASTIC
//   {modulus}, 0.3                    writes the shortest text that reproduces the value exactly
//   {modulus:%.6e}, 0.3               writes it in a format of printf(3): e, f or g
//   {{modulus}}                       writes the text {modulus}
//
// Values are written in the unit that the study declares for the variable. Braces around anything
// but a name stay unchanged.
#pragma once

#include <string>
#include <vector>

#include "optimization/problem/design_space.h"

namespace latsch {

class InputTemplate {
 public:
  /// Throws InputError naming `file` and line for a hole that names no variable or has an invalid
  /// format.
  InputTemplate(std::string text, const std::string& file, const DesignSpace& space);

  /// Returns the text with values in place of the holes.
  std::string filled(const DesignSpace& space, const DesignPoint& point) const;

  /// True if a hole names the given variable.
  bool uses(int variable) const;

  /// Returns the text as read.
  const std::string& text() const { return text_; }

 private:
  struct Part {
    std::string before;  // text before the hole
    int variable = -1;   // index of the variable; -1: the end of the file
    std::string format;  // printf format; empty: exact
  };
  std::string text_;
  std::vector<Part> parts_;
};

}  // namespace latsch
