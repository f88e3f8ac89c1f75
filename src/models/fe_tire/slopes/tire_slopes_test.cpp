// SPDX-License-Identifier: Apache-2.0
// Tests slopes against finite differences of complete computations, extrapolated to a step of zero.
// Steps may be wide, because exactly those points are kept in contact that touch for the unchanged
// tire.
#include "models/fe_tire/slopes/tire_slopes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {
namespace {

constexpr double kInflation = 2.6e5;
constexpr int kModes = 8;

TireDescription tire_for_slopes() {
  TireDescription tire = reference_tire_b();
  tire.cord_model = CordModel::rebar;
  tire.section.meridional = 13;
  tire.section.sectors = 24;
  return tire;
}

/// A parameter of the tire's description.
struct Number {
  const char* name;
  std::function<double&(TireDescription&)> of;
  double size;  // typical size of the parameter, to which the step is proportional
};

std::vector<Number> numbers() {
  return {
      {"rubber C10", [](TireDescription& t) -> double& { return t.rubbers[0].law.C10; }, 3.7e6},
      {"rubber K", [](TireDescription& t) -> double& { return t.rubbers[0].law.K; }, 3.7e8},
      {"density", [](TireDescription& t) -> double& { return t.rubbers[0].density; }, 1150.0},
      {"carcass E",
       [](TireDescription& t) -> double& { return t.plies[0].cords.E_tension; },
       3.6e8},
      {"belt E", [](TireDescription& t) -> double& { return t.plies[1].cords.E_tension; }, 5e9},
      {"belt angle", [](TireDescription& t) -> double& { return t.plies[1].cords.angle; }, 0.4},
      {"belt thickness",
       [](TireDescription& t) -> double& { return t.plies[1].cords.thickness; },
       1e-3},
      {"tread thickness",
       [](TireDescription& t) -> double& { return t.section.outside.length[0]; },
       9e-3},
      {"crown radius", [](TireDescription& t) -> double& { return t.section.contour[0].r; }, 5e-3},
      {"pressure", [](TireDescription& t) -> double& { return t.pressure; }, kInflation},
  };
}

TireDescription moved(const Number& number, double step) {
  TireDescription tire = tire_for_slopes();
  tire.pressure = kInflation;
  number.of(tire) += step;
  return tire;
}

VariedTire varied(const Number& number, double step) {
  const TireDescription tire = moved(number, step);
  return {build_mesh(tire), build_materials(tire), tire.pressure};
}

std::vector<Variation> variations() {
  std::vector<Variation> all;
  for (const Number& number : numbers()) {
    const double step = 1e-4 * number.size;
    all.push_back({varied(number, -step),
                   varied(number, step),
                   step,
                   std::string(number.name) == "pressure"});
  }
  return all;
}

/// Returns a tire that is solved to nearly all digits.
FeTire at_rest(const TireDescription& tire, double mode_tolerance) {
  SolverSettings settings;
  settings.tolerance = 1e-11;
  settings.mode_tolerance = mode_tolerance;
  return FeTire(build_mesh(tire), build_materials(tire), settings);
}

constexpr int kWidth = 4, kModesFrom = 8, kAnswers = kModesFrom + 2 * kModes;

const std::vector<double> kDeflections = {0.008, 0.015};

/// Presses the tire to the deflections. At each of them exactly the given points are in contact.
std::vector<TireState> pressed(FeTire& tire,
                               const Inflated& inflated,
                               const std::vector<TouchingPoints>& held) {
  TireState state = tire.over(inflated, Ground{});
  std::vector<TireState> states;
  for (std::size_t k = 0; k < held.size(); ++k) {
    state.ground.held = held[k];
    const auto next = tire.advance(state, {FeTire::below(inflated, kDeflections[k])});
    EXPECT_TRUE(next);
    states.push_back(state = next->back());
  }
  return states;
}

/// Returns radius, growth, loads at two deflections, section width, mass, moments of inertia, and
/// frequencies of the free and the loaded tire. All are so accurate that their differences can be
/// divided by the step.
Eigen::VectorXd answers(const TireDescription& description,
                        const std::vector<TouchingPoints>& held) {
  FeTire tire = at_rest(description, 1e-9);
  const auto inflated = tire.inflate(description.pressure);
  EXPECT_TRUE(inflated);
  const std::vector<TireState> states = pressed(tire, *inflated, held);
  const auto free = tire.modes(*inflated, kModes), loaded = tire.modes(states.back(), kModes);
  EXPECT_TRUE(free && loaded);
  const MassProperties mass = tire.mass_properties(*inflated);
  Eigen::VectorXd all(kAnswers);
  all.head<kModesFrom>() << inflated->radius, inflated->growth, tire.stand(states[0]).force.z(),
      tire.stand(states[1]).force.z(), inflated->width, mass.mass, mass.spin_inertia,
      mass.diametral_inertia;
  for (int k = 0; k < kModes; ++k) {
    all[kModesFrom + k] = (*free)[k].frequency;
    all[kModesFrom + kModes + k] = (*loaded)[k].frequency;
  }
  return all;
}

/// Returns derivatives by central differences with two steps, with an error of order h^4.
Eigen::VectorXd differences(const Number& number, const std::vector<TouchingPoints>& held) {
  const auto central = [&](double share) {
    const double h = share * number.size;
    return Eigen::VectorXd((answers(moved(number, h), held) - answers(moved(number, -h), held)) /
                           (2.0 * h));
  };
  constexpr double kStep = 8e-3;
  return (4.0 * central(0.5 * kStep) - central(kStep)) / 3.0;
}

// The given mode shapes have only the accuracy of an ordinary trial. The slopes must improve them
// as needed.
TEST(TireSlopes, AreThoseOfWholeTrials) {
  const TireDescription description = moved(numbers()[0], 0.0);
  FeTire tire = at_rest(description, SolverSettings().mode_tolerance);
  TireSlopes slopes(tire, variations());
  const auto inflated = tire.inflate(kInflation);
  ASSERT_TRUE(inflated);
  const auto states = tire.press(*inflated, Ground{}, kDeflections);
  ASSERT_TRUE(states);
  const auto free = tire.modes(*inflated, kModes), loaded = tire.modes(states->back(), kModes);
  ASSERT_TRUE(free && loaded);
  std::vector<TouchingPoints> touching;
  for (const TireState& state : *states) touching.push_back(tire.touching(state));

  const auto of_inflated = slopes.of_inflated(*inflated);
  ASSERT_TRUE(of_inflated);
  Eigen::MatrixXd found(kAnswers, slopes.variables());
  found.row(0) = of_inflated->radius;
  found.row(1) = of_inflated->growth;
  for (int k = 0; k < 2; ++k) {
    const auto of_state = slopes.of_state((*states)[k]);
    ASSERT_TRUE(of_state);
    // The deflection is constant, but it is measured from the inflated radius, which changes.
    found.row(2 + k) = of_state->force + of_state->by_height * of_inflated->radius;
  }
  const auto of_mass = slopes.of_mass(*inflated);
  ASSERT_TRUE(of_mass);
  found.row(kWidth) = of_inflated->width;
  found.row(kWidth + 1) = of_mass->mass;
  found.row(kWidth + 2) = of_mass->spin_inertia;
  found.row(kWidth + 3) = of_mass->diametral_inertia;
  const auto of_free = slopes.of_modes(*inflated, *free);
  const auto of_loaded = slopes.of_modes(states->back(), *loaded, of_inflated->radius);
  ASSERT_TRUE(of_free && of_loaded);
  found.middleRows(kModesFrom, kModes) = *of_free;
  found.bottomRows(kModes) = *of_loaded;

  const Eigen::VectorXd values = answers(description, touching);
  for (int k = 0; k < slopes.variables(); ++k) {
    const Number number = numbers()[k];
    const Eigen::VectorXd expected = differences(number, touching);
    for (int i = 0; i < found.rows(); ++i) {
      // The error is relative to the change of the result if the parameter changes by its own size,
      // or to the result itself.
      const double size = std::max(std::abs(expected[i]), 1e-2 * std::abs(values[i]) / number.size);
      EXPECT_NEAR(found(i, k), expected[i], 1e-6 * size) << number.name << ", answer " << i;
    }
  }
}

// The slopes of the first of two states are computed with the factorization on the path, or with a
// new one. The path is the same in both cases.
TEST(TireSlopes, OfAStateThatIsPassedAreThoseFoundAfterwards) {
  const TireDescription description = moved(numbers()[0], 0.0);
  std::vector<TireState> states;
  std::vector<Eigen::VectorXd> forces;
  std::vector<int> factorizations;
  for (const bool meanwhile : {true, false}) {
    FeTire tire(description);
    std::optional<TireSlopes> slopes;
    if (meanwhile) slopes.emplace(tire, variations());
    const auto inflated = tire.inflate(kInflation);
    ASSERT_TRUE(inflated);
    const auto pressed = tire.press(*inflated, Ground{}, kDeflections);
    ASSERT_TRUE(pressed);
    if (!meanwhile) slopes.emplace(tire, variations());
    const auto of_state = slopes->of_state(pressed->front());
    ASSERT_TRUE(of_state);
    states.push_back(pressed->front());
    forces.push_back(of_state->force);
    factorizations.push_back(tire.counts().factorizations);
  }
  EXPECT_EQ(states[0].u, states[1].u);
  EXPECT_EQ(factorizations[0] + 1, factorizations[1]);
  EXPECT_TRUE(((forces[0] - forces[1]).array().abs() <= 1e-7 * forces[1].array().abs()).all());
}

/// Returns the state that carries the given load, by Newton's method with exact derivatives.
TireState carrying(FeTire& tire, TireSlopes& slopes, double pressure, double load) {
  const auto inflated = tire.inflate(pressure);
  auto states = tire.press(*inflated, Ground{}, {0.008, 0.016});
  EXPECT_TRUE(states);
  TireState state = states->back();
  for (int i = 0; i < 20; ++i) {
    const double left = load - tire.stand(state).force.z();
    if (std::abs(left) < 1e-9 * load) break;
    const auto of_state = slopes.of_state(state);
    EXPECT_TRUE(of_state);
    const double height = state.pose.height + left / of_state->by_height;
    states = tire.press(*inflated, Ground{}, {0.008, inflated->radius - height});
    EXPECT_TRUE(states);
    state = states->back();
  }
  return state;
}

constexpr double kLoad = 3000.0;  // N

/// Returns deflection, length, width and area of the patch under the load.
Eigen::Vector4d under_load(const TireDescription& description) {
  FeTire tire = at_rest(description, 1e-5);
  TireSlopes slopes(tire, {});
  const TireState state = carrying(tire, slopes, description.pressure, kLoad);
  const Standing standing = tire.stand(state);
  return {standing.deflection, standing.patch.length, standing.patch.width, standing.patch.area};
}

TEST(TireSlopes, OfDeflectionAndPatchUnderALoadAreThoseOfWholeTrials) {
  const TireDescription description = moved(numbers()[0], 0.0);
  FeTire tire = at_rest(description, 1e-5);
  TireSlopes slopes(tire, variations());
  const TireState state = carrying(tire, slopes, kInflation, kLoad);
  const auto of_inflated = slopes.of_inflated(*state.inflated);
  const auto of_state = slopes.of_state(state);
  ASSERT_TRUE(of_inflated && of_state);
  const Eigen::VectorXd height = TireSlopes::height_under_load(*of_state);
  const auto of_patch = slopes.of_patch(state, height);
  ASSERT_TRUE(of_patch);
  const Eigen::VectorXd deflection = of_inflated->radius - height;
  const Eigen::Vector4d values = under_load(description);
  for (int k = 0; k < slopes.variables(); ++k) {
    const Number number = numbers()[k];
    if (std::string(number.name) == "density") continue;  // the density has no effect on the load
    const auto differences = [&](double h) {
      return Eigen::Vector4d((under_load(moved(number, h)) - under_load(moved(number, -h))) /
                             (2.0 * h));
    };
    // The patch is only piecewise smooth, because lines of touching samples begin and end. The
    // steps are small enough to stay within one piece.
    Eigen::Vector4d expected = differences(2e-5 * number.size);
    expected[0] = differences(2e-4 * number.size)[0];
    const Eigen::Vector4d found{
        deflection[k], of_patch->length[k], of_patch->width[k], of_patch->area[k]};
    for (int i = 0; i < 4; ++i) {
      // Central differences have an error of 1e-5; for the patch, whose second derivative is
      // larger, the tolerance is wider.
      const double size = std::max(std::abs(expected[i]), 1e-2 * values[i] / number.size);
      EXPECT_NEAR(found[i], expected[i], (i == 0 ? 1e-5 : 1e-3) * size) << number.name << ' ' << i;
    }
  }
}

TEST(TireSlopes, OfAStateWithFrictionAreRefused) {
  FeTire tire(tire_for_slopes());
  const auto inflated = tire.inflate(kInflation);
  ASSERT_TRUE(inflated.ok());
  const auto states = tire.press(*inflated, Ground{.mu = 0.8}, {0.008});
  ASSERT_TRUE(states.ok());
  const auto modes = tire.modes(states->back(), 2);
  ASSERT_TRUE(modes.ok());
  TireSlopes slopes(tire, variations());
  const Eigen::VectorXd height = Eigen::VectorXd::Zero(slopes.variables());
  const auto refused = [](const auto& result) {
    return !result.ok() && result.failure().reason.find("friction of 0.8") != std::string::npos;
  };
  EXPECT_TRUE(refused(slopes.of_state(states->back())));
  EXPECT_TRUE(refused(slopes.of_patch(states->back(), height)));
  EXPECT_TRUE(refused(slopes.of_modes(states->back(), *modes, height)));
}

}  // namespace
}  // namespace latsch::fe_tire
