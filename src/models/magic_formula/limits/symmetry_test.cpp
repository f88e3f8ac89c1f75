// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/limits/symmetry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>
#include <string>
#include <utility>

#include "models/magic_formula/magic_formula.h"

namespace latsch::magic_formula {
namespace {

/// A symmetric tire in which every factor of another coefficient is different from 0.
Parameters symmetric_tire(Version version) {
  Parameters p;
  p.version = version;
  for (const auto& [name, value] :
       std::initializer_list<std::pair<const char*, double>>{{"UNLOADED_RADIUS", 0.316},
                                                             {"FNOMIN", 4e3},
                                                             {"NOMPRES", 2.4e5},
                                                             {"INFLPRES", 2.4e5},
                                                             {"LONGVL", 16.7},
                                                             {"WIDTH", 0.205},
                                                             {"PCX1", 1.6},
                                                             {"PDX1", 1.15},
                                                             {"PKX1", 25},
                                                             {"PEX1", 0.2},
                                                             {"PHX1", 0.002},
                                                             {"RBX1", 12},
                                                             {"RBX2", -10},
                                                             {"RCX1", 1.1},
                                                             {"PCY1", 1.3},
                                                             {"PDY1", 1},
                                                             {"PEY1", -1},
                                                             {"PKY1", -20},
                                                             {"PKY2", 1.5},
                                                             {"PKY4", 2},
                                                             {"PKY6", -0.9},
                                                             {"RBY1", 7},
                                                             {"RBY2", 2.5},
                                                             {"RCY1", 1.05},
                                                             {"RVY4", 5},
                                                             {"RVY5", 1.9},
                                                             {"RVY6", -10},
                                                             {"QBZ1", 8},
                                                             {"QBZ9", 10},
                                                             {"QCZ1", 1.1},
                                                             {"QDZ1", 0.17},
                                                             {"QEZ1", -1},
                                                             {"QSX2", 0.5},
                                                             {"QSX3", 0.1},
                                                             {"SSZ2", 0.01},
                                                             {"QSY1", 0.01},
                                                             {"VERTICAL_STIFFNESS", 2.2e5}})
    p.*find_parameter(name)->member = value;
  return p;
}

/// Largest difference between the forces of a state and the mirrored forces of its mirror image,
/// over the load.
double asymmetry(const Parameters& p) {
  const MagicFormula tire(p);
  double worst = 0.0;
  for (const double Fz : {2e3, 5.5e3})
    for (const double kappa : {0.0, 0.05, -0.1})
      for (const double alpha : {0.0, 0.04, -0.15})
        for (const double gamma : {0.0, 0.06}) {
          const SteadyState a = tire.evaluate({Fz, kappa, alpha, gamma, 0, 16, 2.4e5});
          const SteadyState b = tire.evaluate({Fz, kappa, -alpha, -gamma, 0, 16, 2.4e5});
          for (const double off : {a.Fx - b.Fx, a.Fy + b.Fy, a.Mx + b.Mx, a.My - b.My, a.Mz + b.Mz})
            worst = std::max(worst, std::abs(off) / Fz);
        }
  return worst;
}

TEST(Symmetry, TheseCoefficientsAndNoOthersMakeATireDifferFromItsMirrorImage) {
  for (const Version version : {Version::mf52, Version::mf61, Version::mf62}) {
    const Parameters whole = symmetric_tire(version);
    ASSERT_EQ(asymmetry(whole), 0.0);
    EXPECT_TRUE(asymmetric_coefficients(whole).empty());
    int asymmetric = 0;
    for (const ParameterField& field : parameter_fields()) {
      if (field.unit != ParameterUnit::one || std::isinf(whole.*field.member)) continue;
      Parameters changed = whole;
      changed.*field.member += 0.01;
      const bool is_told = !asymmetric_coefficients(changed).empty();
      EXPECT_EQ(asymmetry(changed) > 1e-9, is_told) << field.name;
      asymmetric += is_told ? 1 : 0;
    }
    EXPECT_EQ(asymmetric, 18);
  }
}

}  // namespace
}  // namespace latsch::magic_formula
