// SPDX-License-Identifier: Apache-2.0
// Differences of a measured quantity, such as a deviation or a scale, as a file states them. A unit
// with a zero of its own, as that of "5 degC", states a point of a scale and no difference.
#pragma once

#include <string>

#include "base/document.h"

namespace latsch::correlation {

/// Throws InputError if `written`, the value of the key or a part of it, is in a unit with a zero
/// of its own, or if it is a share of a quantity with such units: a share of a temperature counts
/// from absolute zero. `unit`: SI unit of the quantity.
void expect_difference(const Node& table,
                       const std::string& key,
                       const std::string& written,
                       const std::string& unit);

/// Reads a difference above 0, SI. Throws as expect_difference() does.
double read_difference(const Node& table, const std::string& key, const std::string& unit);

}  // namespace latsch::correlation
