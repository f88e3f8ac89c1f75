// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/limits/symmetry.h"

namespace latsch::magic_formula {

std::vector<std::string_view> asymmetric_coefficients(const Parameters& parameters) {
  std::vector<std::string_view> found;
  for (const std::string_view name : {"RHX1",
                                      "QSX1",
                                      "PEY3",
                                      "PHY1",
                                      "PHY2",
                                      "PVY1",
                                      "PVY2",
                                      "RBY3",
                                      "RVY1",
                                      "RVY2",
                                      "QBZ4",
                                      "QDZ3",
                                      "QDZ6",
                                      "QDZ7",
                                      "QEZ4",
                                      "QHZ1",
                                      "QHZ2",
                                      "SSZ1"})
    if (parameters.*find_parameter(name)->member != 0.0) found.push_back(name);
  return found;
}

}  // namespace latsch::magic_formula
