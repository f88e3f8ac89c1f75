// SPDX-License-Identifier: Apache-2.0
// Sets single coefficients of shipped tires to values that no tire has. One of the faults that are
// reported must name the coefficient that was changed.
#include "experiment/kinds/tire_sanity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "base/document.h"
#include "experiment/kinds/tir_numbers.h"

namespace latsch::experiment {
namespace {

struct WrongCoefficient {
  const char* name;
  double value;
};

std::string list_of_faults(const std::vector<FaultBeyondData>& faults) {
  std::string text;
  for (const auto& fault : faults) {
    text += "\n  " + fault.words + ":";
    for (const auto& [name, value] : fault.numbers) text += " " + name;
  }
  return text;
}

/// Faults of one coefficient each, in every class: shape, friction, stiffness, curvature, load,
/// camber, pressure, combined slip, trail, overturning moment.
const std::vector<WrongCoefficient>& wrong_coefficients() {
  static const std::vector<WrongCoefficient> all = {
      {"PCX1", 2.9}, {"PCX1", 2.3},  {"PDX1", 4.5}, {"PDX1", 0.1},  {"PDX2", 0.6},  {"PKX1", -40},
      {"PKX2", -90}, {"PPX1", -9},   {"PPX3", -9},  {"PCY1", 2.9},  {"PCY1", 2.3},  {"PDY1", 4.5},
      {"PDY1", 0.1}, {"PDY2", 0.6},  {"PDY3", 400}, {"PKY1", 30},   {"PKY2", 0.05}, {"PKY3", 30},
      {"PKY6", 30},  {"PPY1", -9},   {"PPY3", -9},  {"RBX1", 150},  {"RBY1", 150},  {"RCX1", 2.5},
      {"QCZ1", 2.5}, {"QDZ1", -0.1}, {"QDZ2", -5},  {"QDZ4", -900}, {"QBZ4", -30},  {"PPZ1", 9},
      {"QSX1", 3},   {"PFZ1", 9},    {"QBZ1", 0.3}};
  return all;
}

class SingleFaults : public testing::TestWithParam<const char*> {};

TEST_P(SingleFaults, NameTheCoefficientThatWasChanged) {
  const Document shipped =
      read_tir_numbers(std::filesystem::path(LATSCH_SOURCE_DIR) / "studies" / GetParam());
  const auto before = tire_faults(shipped, nullptr);
  for (const WrongCoefficient& wrong : wrong_coefficients()) {
    Document changed = shipped;
    changed.set(wrong.name, wrong.value);
    const auto faults = tire_faults(changed, nullptr);
    EXPECT_TRUE(std::ranges::any_of(faults,
                                    [&](const FaultBeyondData& fault) {
                                      return std::ranges::any_of(
                                          fault.numbers,
                                          [&](const auto& one) { return one.first == wrong.name; });
                                    }))
        << wrong.name << " = " << wrong.value << list_of_faults(faults);
  }
  EXPECT_TRUE(before.empty()) << list_of_faults(before);
}

INSTANTIATE_TEST_SUITE_P(ShippedTires, SingleFaults, testing::Values("kerb/slick.tir"));

/// The load of the largest cornering stiffness is so low that heavy loads leave almost none. Other
/// numbers hide the fault as well; that of the most unusual value comes first.
TEST(TireSanity, TheMostUnusualOfSeveralPossibleCausesComesFirst) {
  Document tire = read_tir_numbers(std::filesystem::path(LATSCH_SOURCE_DIR) /
                                   "studies/tire_model_comparison/magic_formula.tir");
  tire.set("PKY2", 0.05);
  const auto faults = tire_faults(tire, nullptr);
  EXPECT_TRUE(std::ranges::any_of(faults, [](const FaultBeyondData& fault) {
    return fault.numbers.size() > 1 && fault.numbers.front().first == "PKY2";
  })) << list_of_faults(faults);
}

}  // namespace
}  // namespace latsch::experiment
