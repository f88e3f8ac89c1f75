// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/sanity/sanity.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

namespace latsch::magic_formula {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;

constexpr double kDegree = std::numbers::pi / 180.0;

/// Returns a tire whose coefficients have the size of those of published passenger car tires.
Parameters sane_tire() {
  Parameters p;
  p.UNLOADED_RADIUS = 0.32;
  p.FNOMIN = 4000.0;
  p.VERTICAL_STIFFNESS = 2e5;
  p.NOMPRES = p.INFLPRES = 2.2e5;
  p.PCX1 = 1.6;
  p.PDX1 = 1.2;
  p.PDX2 = -0.1;
  p.PKX1 = 22.0;
  p.PCY1 = 1.35;
  p.PDY1 = 1.0;
  p.PDY2 = -0.1;
  p.PEY1 = -0.8;
  p.PKY1 = -18.0;
  p.PKY2 = 1.8;
  p.RBX1 = p.RBY1 = 10.0;
  p.RBX2 = p.RBY2 = 8.0;
  p.RCX1 = p.RCY1 = 1.0;
  p.QBZ1 = 9.0;
  p.QCZ1 = 1.15;
  p.QDZ1 = 0.11;
  p.QEZ1 = -2.0;
  return p;
}

constexpr DataRange kData{
    2000.0, 6000.0, 12.0 * kDegree, 0.2, -3.0 * kDegree, 3.0 * kDegree, 2.0e5, 2.4e5};

std::vector<std::string> rows_of(const std::vector<SanityFault>& faults) {
  std::vector<std::string> names;
  for (const SanityFault& fault : faults) names.push_back(fault.row);
  return names;
}

TEST(Sanity, ATireOfUsualCoefficientsHasNoFault) {
  EXPECT_THAT(rows_of(sanity_faults(sane_tire(), kData)), IsEmpty());
  EXPECT_THAT(rows_of(sanity_faults(sane_tire(), range_of(sane_tire()))), IsEmpty());
}

// In each case a single coefficient is wrong, and the check must name this one.
TEST(Sanity, AFaultNamesItsRowAndTheCoefficientThatMakesIt) {
  struct Case {
    double Parameters::*coefficient;
    double value;
    const char *name, *row;
  };
  for (const Case& one : {
           Case{&Parameters::PDY2, 0.5, "PDY2", "friction over load"},
           Case{&Parameters::PDX2, 0.3, "PDX2", "friction over load"},
           Case{&Parameters::PDY1, 4.0, "PDY1", "friction"},
           Case{&Parameters::PKY1, 18.0, "PKY1", "cornering stiffness"},
           Case{&Parameters::PKX2, -30.0, "PKX2", "slip stiffness"},
           Case{&Parameters::PKY3, 20.0, "PKY3", "cornering stiffness"},
           Case{&Parameters::QCZ1, 2.2, "QCZ1", "aligning moment"},
           Case{&Parameters::RBX1, 60.0, "RBX1", "friction ellipse"},
           Case{&Parameters::PPZ1, 8.0, "PPZ1", "factors"},
           Case{&Parameters::PFZ1, 9.0, "PFZ1", "factors"},
           Case{&Parameters::PCX1, 2.9, "PCX1", "force at large slip"},
           Case{&Parameters::PCX1, 2.3, "PCX1", "force at large slip"},
           Case{&Parameters::PCY1, 2.9, "PCY1", "force at large slip"},
           Case{&Parameters::QDZ1, -0.1, "QDZ1", "trail"},
           Case{&Parameters::QDZ2, -3.0, "QDZ2", "trail"},
           Case{&Parameters::QSX1, 3.0, "QSX1", "overturning moment"},
           Case{&Parameters::PKY6, 30.0, "PKY6", "camber stiffness"},
           Case{&Parameters::PKY6, -30.0, "PKY6", "camber stiffness"},
           Case{&Parameters::PKY6, 2.0, "PKY6", "camber stiffness"},
           Case{&Parameters::PPY2, -9.0, "PPY2", "factors"},
           Case{&Parameters::QBZ4, -15.0, "QBZ4", "factors"},
       }) {
    Parameters p = sane_tire();
    p.*one.coefficient = one.value;
    const auto faults = sanity_faults(p, kData);
    EXPECT_THAT(faults,
                Contains(testing::AllOf(Field(&SanityFault::row, one.row),
                                        Field(&SanityFault::coefficients, Contains(one.name)))))
        << one.name << ": " << testing::PrintToString(rows_of(faults));
  }
}

// PDY2 is 0, and two pressure coefficients are wrong. Either of them alone would leave the friction
// positive.
TEST(Sanity, TwoCoefficientsThatFailTogetherAreBothNamed) {
  Parameters p = sane_tire();
  p.PPY3 = -3.5;
  p.PPY4 = -9.0;
  const auto faults = sanity_faults(p, {2000, 6000, 0, 0, 0, 0, 2.2e5, 2.8e5});
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults.front().row, "friction");
  std::vector<std::string> coefficients = faults.front().coefficients;
  std::sort(coefficients.begin(), coefficients.end());
  EXPECT_THAT(coefficients, ElementsAre("PPY3", "PPY4"));
}

// The check must ignore the limits of the file, because clamped inputs would hide the behavior
// outside of them.
TEST(Sanity, LimitsOfTheFileHideNothing) {
  Parameters p = sane_tire();
  p.PDY2 = 0.5;
  p.FZMIN = 2000.0;
  p.FZMAX = 2100.0;
  EXPECT_THAT(rows_of(sanity_faults(p, kData)), ElementsAre("friction over load"));
}

TEST(Sanity, ATireWithoutAForceHasNoFaultOfIt) {
  Parameters p = sane_tire();
  p.PDX1 = p.PKX1 = p.PDX2 = 0.0;
  p.QDZ1 = 0.0;
  EXPECT_THAT(rows_of(sanity_faults(p, kData)), IsEmpty());
}

}  // namespace
}  // namespace latsch::magic_formula
