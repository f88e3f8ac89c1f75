// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_rolling/slip_record.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "base/error.h"
#include "experiment/rigs/fe_rolling/free_radii.h"
#include "experiment/rigs/fe_rolling/steady_table.h"
#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/rolling/rolling_response.h"

namespace latsch::experiment {
namespace {

constexpr double kRecordedLoad = 4000.0;  // N

fe_tire::TireDescription tire_of_records(double loss_factor) {
  fe_tire::TireDescription tire = fe_tire::reference_tire_b();
  tire.element = fe_tire::ElementKind::solid_shell;
  tire.section.meridional = 13;
  if (loss_factor > 0.0)
    for (fe_tire::Rubber& rubber : tire.rubbers)
      rubber.prony = *fe_tire::constant_loss_factor(loss_factor, 1.0, 1000.0);
  return tire;
}

/// Tire B with 13 columns on the rig.
class RecordRig {
 public:
  explicit RecordRig(double loss_factor)
      : description_(tire_of_records(loss_factor)), tire_(description_), rig_(tire_, 2.6e5) {
    rig_.set_losses(fe_tire::build_losses(description_));
  }
  static formats::CsvTable table(const std::string& text) {
    return formats::CsvTable::parse(text, "record.csv");
  }
  Channels roll(const std::string& text, const SlipHistoryConditions& conditions = {}) {
    remarks_.clear();
    const auto found = roll_record(rig_, table(text), conditions, remarks_);
    EXPECT_TRUE(found) << found.failure().reason;
    return found ? *found : Channels();
  }
  Channels steady(const std::string& text) {
    const auto found = roll_table(rig_, table(text), {});
    EXPECT_TRUE(found) << found.failure().reason;
    return found ? *found : Channels();
  }
  std::string refusal(const std::string& text, const SlipHistoryConditions& conditions = {}) {
    try {
      (void)remarks_on_record(rig_, table(text), conditions);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  bool says(const std::string& text, const std::string& part) {
    return std::ranges::any_of(
        remarks_on_record(rig_, table(text), {}),
        [&](const std::string& one) { return one.find(part) != std::string::npos; });
  }

  fe_tire::TireDescription description_;
  fe_tire::FeTire tire_;
  TireRig rig_;
  std::vector<std::string> remarks_;
};

TEST(FreeRadii, AreAPolynomialThroughTheirWheels) {
  std::vector<RollingRow> rows(2);
  rows[0] = {.load = 2000.0, .speed = 10.0};
  rows[1] = {.load = 6000.0, .speed = 12.0};
  rows[1].camber = 0.05;
  FreeRadii radii(rows);
  const auto law = [](double load, double speed, double camber) {
    return 0.31 - 1e-6 * load + 1e-11 * load * load + 1e-5 * speed * speed - 0.02 * camber * camber;
  };
  std::vector<double> known;
  for (const RollingRow& wheel : radii.wheels())
    known.push_back(law(wheel.load, wheel.speed, wheel.camber));
  radii.set(known);
  EXPECT_NEAR(radii.at(3100.0, 11.3, 0.02), law(3100.0, 11.3, 0.02), 1e-12);
  EXPECT_EQ(FreeRadii({{.load = 4000.0, .speed = 10.0}}).wheels().size(), 1u);
}

TEST(FreeRadii, OfATireAreRightBetweenTheirWheels) {
  RecordRig tire(0.0);
  std::vector<RollingRow> rows(2);
  rows[0] = {.load = 2500.0, .speed = 15.0};
  rows[1] = {.load = 5000.0, .speed = 16.0};
  rows[1].camber = 0.03;
  FreeRadii radii(rows);
  RollingTest test{.rows = radii.wheels()};
  const std::size_t wheels = test.rows.size();
  test.rows.push_back({.load = 3333.0, .speed = 15.4});
  test.rows.back().camber = 0.011;
  const auto states = roll_states(tire.rig_, test);
  ASSERT_TRUE(states) << states.failure().reason;
  std::vector<double> known;
  for (std::size_t k = 0; k < wheels; ++k) known.push_back((*states)[k].effective_radius);
  radii.set(known);
  EXPECT_NEAR(radii.at(3333.0, 15.4, 0.011) / states->back().effective_radius, 1.0, 1e-4);
}

TEST(SlipRecord, KeepsASteadyState) {
  RecordRig tire(0.15);
  std::string record = "time [s],Fz [N],kappa,alpha [deg],gamma [deg],Vx [m/s]\n";
  for (int i = 0; i < 6; ++i) record += fmt::format("{},4000,0.01,1.5,2,15\n", 0.003 * i);
  const Channels found = tire.roll(record);
  const Channels steady =
      tire.steady("Fz [N],kappa,alpha [deg],gamma [deg],Vx [m/s]\n4000,0.01,1.5,2,15\n");
  ASSERT_EQ(found["Fy"].size(), 6u);
  for (const char* name : {"Fx", "Fy", "Fz", "Mx", "My", "Mz"})
    for (const double value : found[name])
      EXPECT_NEAR(value, steady[name][0], 1e-4 * kRecordedLoad) << name;
  for (const char* name : {"R_e", "R_l", "length", "width", "omega"})
    EXPECT_NEAR(found[name][5], steady[name][0], 1e-5 * steady[name][0]) << name;
}

// All quantities change within 0.1 s and stay for 0.5 s.
TEST(SlipRecord, EndsInTheSteadyStateOfItsLastSample) {
  RecordRig tire(0.15);
  std::string record = "time [s],Fz [N],kappa,alpha [deg],gamma [deg],Vx [m/s]\n";
  for (int i = 0; i <= 30; ++i) {
    const double share = std::min(1.0, i / 5.0);
    record += fmt::format("{},{},{},{},{},{}\n",
                          0.02 * i,
                          4000 - 1000 * share,
                          0.01 * share,
                          1.5 * share,
                          2 * share,
                          15 + share);
  }
  const Channels found = tire.roll(record);
  const Channels steady =
      tire.steady("Fz [N],kappa,alpha [deg],gamma [deg],Vx [m/s]\n3000,0.01,1.5,2,16\n");
  for (const char* name : {"Fx", "Fy", "Fz", "Mz"}) {
    const auto [least, most] = std::ranges::minmax(found[name]);
    EXPECT_NEAR(
        found[name].back(), steady[name][0], 0.01 * std::max(std::abs(least), std::abs(most)))
        << name;
  }
  EXPECT_NEAR(found["omega"].back(), steady["omega"][0], 1e-5 * steady["omega"][0]);
}

/// Amplitude of what follows cos(omega t) and sin(omega t) in samples of whole periods.
std::complex<double> swing_in(const std::vector<double>& values, std::size_t first, double phase) {
  std::complex<double> sum = 0.0;
  const auto n = static_cast<double>(values.size() - first);
  for (std::size_t k = first; k < values.size(); ++k)
    sum += values[k] * std::polar(2.0 / n, -phase * static_cast<double>(k));
  return sum;
}

/// Response of a force in a record in which one column swings as sin(phase i), beside that of
/// RollingResponse.
struct Swings {
  std::complex<double> found, expected;
};
Swings swings(RecordRig& tire,
              const char* column,
              double amplitude,
              fe_tire::SlipInput input,
              const char* force,
              int index,
              double step) {
  constexpr double kSpeed = 5.0, kFrequency = 0.4, kSpacing = 0.0125;  // 0.5 rad/m of road
  const double phase = 2.0 * std::numbers::pi * kFrequency * kSpacing;
  const int period = static_cast<int>(std::lround(1.0 / (kFrequency * kSpacing)));
  std::string record = fmt::format("time [s],Fz [N],Vx [m/s],{}\n", column);
  for (int i = 0; i < 2 * period; ++i)
    record +=
        fmt::format("{},4000,{},{:.12g}\n", kSpacing * i, kSpeed, amplitude * std::sin(phase * i));
  const Channels found = tire.roll(record, {.step = step});
  // The second period, as a multiple of sin.
  Swings swings;
  swings.found = swing_in(found[force], period, phase) * std::complex<double>(0.0, 1.0) / amplitude;
  RollingTest test{.rows = {{.load = kRecordedLoad, .speed = kSpeed}}};
  const auto states = roll_states(tire.rig_, test);
  EXPECT_TRUE(states);
  const auto response = fe_tire::RollingResponse::about(tire.tire_, states->front().state);
  EXPECT_TRUE(response);
  const fe_tire::SlipResponse by = response->by(input, kFrequency, fe_tire::Axle::follows);
  swings.expected = index < 3 ? by.force[index] : by.moment[index - 3];
  return swings;
}

// The response in frequency has no steps of time and no inertia; a step rolls 25 mm.
TEST(SlipRecord, LagsBehindSlipAnglesAsTheResponseInFrequencySays) {
  RecordRig tire(0.0);
  const Swings side = swings(tire, "alpha [rad]", 2e-4, fe_tire::SlipInput::angle, "Fy", 1, 5e-3);
  EXPECT_NEAR(std::abs(side.found / side.expected), 1.0, 0.02);
  EXPECT_NEAR(std::arg(side.found / side.expected), 0.0, 0.02);
  // The relaxation length of a first-order lag, tan(phase) = omega sigma/V.
  const double length = fe_tire::relaxation_length(side.expected, 0.4, 5.0);
  EXPECT_NEAR(fe_tire::relaxation_length(side.found, 0.4, 5.0), length, 0.03 * length);
}

TEST(SlipRecord, LagsBehindCamberAsTheResponseInFrequencySays) {
  RecordRig tire(0.0);
  const Swings side = swings(tire, "gamma [rad]", 5e-4, fe_tire::SlipInput::camber, "Fy", 1, 5e-3);
  EXPECT_NEAR(std::abs(side.found / side.expected), 1.0, 0.02);
  EXPECT_NEAR(std::arg(side.found / side.expected), 0.0, 0.02);
}

TEST(SlipRecord, LagsBehindSlipsAsTheResponseInFrequencySays) {
  RecordRig tire(0.0);
  const Swings along = swings(tire, "kappa", 1e-4, fe_tire::SlipInput::spin, "Fx", 0, 5e-3);
  EXPECT_NEAR(std::abs(along.found / along.expected), 1.0, 0.02);
  EXPECT_NEAR(std::arg(along.found / along.expected), 0.0, 0.02);
}

TEST(SlipRecord, BeginsAnewBehindAGap) {
  RecordRig tire(0.0);
  const std::string head = "time [s],Fz [N],alpha [deg],Vx [m/s]\n";
  const Channels found = tire.roll(
      head + "0,4000,0,15\n0.01,4000,0.5,15\n0.02,4000,1,15\n5,3000,2,15\n5.01,3000,2,15\n");
  const Channels steady = tire.steady("Fz [N],alpha [deg],Vx [m/s]\n3000,2,15\n");
  EXPECT_NEAR(found["Fy"][3], steady["Fy"][0], 1e-4 * kRecordedLoad);
  EXPECT_NEAR(found["Fy"][4], steady["Fy"][0], 1e-4 * kRecordedLoad);
  EXPECT_TRUE(tire.says(head + "0,4000,0,15\n0.01,4000,0,15\n0.02,4000,0,15\n5,4000,0,15\n",
                        "behind sample 3"));
}

// The ground carries the load of the table at every sample, also between steps.
TEST(SlipRecord, FollowsTheLoad) {
  RecordRig tire(0.15);
  std::string record = "time [s],Fz [N],Vx [m/s]\n";
  for (int i = 0; i <= 12; ++i) record += fmt::format("{},{},15\n", 0.01 * i, 4000 - 100 * i);
  const Channels found = tire.roll(record, {.step = 4e-3});
  for (int i = 0; i <= 12; ++i) EXPECT_NEAR(found["Fz"][i], 4000 - 100 * i, 1e-3 * kRecordedLoad);
  EXPECT_GT(found["R_l"][12], found["R_l"][0] + 1e-3);
}

TEST(SlipRecord, SaysHowFarAReducedTireIsFromTheFullOne) {
  RecordRig tire(0.15);
  std::string record = "time [s],Fz [N],alpha [deg],Vx [m/s]\n";
  for (int i = 0; i <= 10; ++i) record += fmt::format("{},4000,{},15\n", 0.01 * i, 0.05 * i);
  const Channels full = tire.roll(record);
  EXPECT_TRUE(tire.remarks_.empty());
  tire.rig_.set_reduction(200.0);
  const Channels reduced = tire.roll(record);
  ASSERT_EQ(tire.remarks_.size(), 1u);
  EXPECT_NE(tire.remarks_[0].find("the tire is reduced to"), std::string::npos);
  EXPECT_NEAR(reduced["Fy"][10] - full["Fy"][0],
              full["Fy"][10] - full["Fy"][0],
              0.1 * std::abs(full["Fy"][10] - full["Fy"][0]));
}

TEST(SlipRecord, RefusesWhatItCannotRoll) {
  RecordRig tire(0.0);
  const std::string head = "time [s],Fz [N]\n";
  EXPECT_NE(tire.refusal(head + "0,4000\n0.01,-3\n").find("record.csv:3: Fz (N) is -3"),
            std::string::npos);
  EXPECT_NE(tire.refusal("time [s],Fz [N],p [bar]\n0,4000,2\n0.01,4000,2.6\n")
                .find("expected records of one pressure each"),
            std::string::npos);
  EXPECT_NE(tire.refusal(head + "0,4000\n0.01,4000\n", {.friction = 0.0})
                .find("expected friction above 0"),
            std::string::npos);
  std::string hours = head;
  for (int i = 0; i < 1000; ++i) hours += fmt::format("{},4000\n", 0.1 * i);
  EXPECT_NE(tire.refusal(hours).find("expected at most 20000"), std::string::npos)
      << tire.refusal(hours);
  EXPECT_EQ(tire.refusal(hours, {.step = 0.02}), "");
}

TEST(SlipRecord, SaysWhatItAssumes) {
  RecordRig tire(0.0);
  const std::string record = "time [s],Fz [N],wind [m/s]\n0,4000,3\n0.1,4000,3\n";
  for (const char* part : {"column \"wind\" is not used",
                           "kappa = 0",
                           "Vx = 16.67 m/s",
                           "friction 1",
                           "without turn slip",
                           "1.7 m of road apart",
                           "no rolling resistance"})
    EXPECT_TRUE(tire.says(record, part)) << part;
}

}  // namespace
}  // namespace latsch::experiment
