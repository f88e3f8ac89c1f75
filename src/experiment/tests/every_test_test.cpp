// SPDX-License-Identifier: Apache-2.0
// Runs every kind of tire through every kind of test, by one interface.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "experiment/kinds/sparse_tir_testing.h"
#include "experiment/kinds/tir_numbers.h"
#include "experiment/language.h"
#include "experiment/language/capabilities.h"
#include "formats/tire/tir_file.h"

namespace latsch::experiment {
namespace {

const std::filesystem::path kStudies = std::filesystem::path(LATSCH_SOURCE_DIR) / "studies";
const std::filesystem::path kRing = kStudies / "ring_tires/passenger_205_55R16.toml";

const std::string kTir = tir_with_a_belt();

class EveryTest : public testing::Test {
 protected:
  EveryTest() {
    std::string pattern = testing::TempDir() + "rolling_tests_XXXXXX";
    folder_ = ::mkdtemp(pattern.data());
  }
  ~EveryTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::unique_ptr<experiment::Test> test(const std::string& text) {
    return language().read_test(write("test.toml", text));
  }
  std::string identity(const std::string& text) {
    return language().read_identified_test(write("test.toml", text)).identity;
  }
  std::string complaint(const std::string& text) {
    try {
      test(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

TEST_F(EveryTest, EveryKindCarriesItsLoadOverTheSameCleat) {
  const auto tir = write("tire.tir", kTir);
  const auto drum = test(
      "kind = \"drum_cleat\"\nspeed = \"40 km/h\"\nload = \"4 kN\"\ndrum_diameter = \"2.5 m\"\n"
      "run_in = \"0.1 s\"\nduration = \"0.1 s\"\nlead = \"0.03 s\"\nsample_step = \"1 ms\"\n"
      "[cleat]\nheight = \"10 mm\"\nlength = \"20 mm\"\nbevel = \"3 mm\"\n");
  for (const SpecimenKind* kind : language().kinds) {
    // Finite-element tires cross the cleat on a rig of their own (cleat_rig_test.cpp).
    if (!kind->has(Rolls::kName) || kind->has(IsFeTire::kName)) continue;
    const Document numbers = kind->read(kind->name() == "ring_tire" ? kRing : tir);
    const auto channels = language().run(*kind, numbers, *drum);
    ASSERT_TRUE(channels) << kind->name() << ": " << channels.failure().reason;
    for (const ChannelInfo& channel : drum->channels()) {
      ASSERT_TRUE(channels->find(channel.name)) << channel.name;
      EXPECT_EQ(channels->find(channel.name)->unit, channel.unit);
    }
    const std::vector<double>& Fz = (*channels)["Fz"];
    // Before the tire reaches the cleat, the force is the load, or a little more because the belt
    // grows with speed; the cleat then causes a peak.
    EXPECT_NEAR(Fz.front(), 4000.0, 300.0) << kind->name();
    EXPECT_GT(*std::max_element(Fz.begin(), Fz.end()), 4600.0) << kind->name();
  }
}

// The test runs for every rolling tire; a tire without irregularities has no variation of forces.
TEST_F(EveryTest, EveryTireThatRollsGoesOnTheUniformityMachine) {
  const auto tir = write("tire.tir", kTir);
  const auto machine =
      test("kind = \"uniformity\"\nload = \"4 kN\"\ndrum_diameter = \"854 mm\"\nstep = \"4 ms\"\n");
  for (const SpecimenKind* kind : language().kinds) {
    if (!can(*kind, *machine)) continue;
    if (kind->has(IsFeTire::kName)) continue;  // it is the same all around
    const Document numbers = kind->read(kind->name() == "ring_tire" ? kRing : tir);
    const auto channels = language().run(*kind, numbers, *machine);
    ASSERT_TRUE(channels) << kind->name() << ": " << channels.failure().reason;
    EXPECT_EQ(channels->all().size(), machine->channels().size());
    for (const ChannelInfo& channel : machine->channels()) {
      ASSERT_TRUE(channels->find(channel.name)) << channel.name;
      EXPECT_EQ(channels->find(channel.name)->unit, channel.unit);
      const double value = (*channels)[channel.name][0];
      if (channel.name == "load")
        EXPECT_NEAR(value, 4000.0, 5.0) << kind->name();
      else
        EXPECT_NEAR(value, 0.0, 3.0) << kind->name() << " " << channel.name;
    }
  }
  EXPECT_NE(
      complaint("kind = \"uniformity\"\nload = \"4 kN\"\nspeed = \"30 m/s\"\nstep = \"1 ms\"\n")
          .find("30 mm at 108 km/h, expected at most 20 mm"),
      std::string::npos);
}

TEST_F(EveryTest, ASweepGivesSideForceAgainstItsSlip) {
  const auto tir = write("tire.tir", kTir);
  const auto sweep = test(
      "kind = \"slip_sweep\"\nspeed = \"40 km/h\"\nload = \"4 kN\"\n"
      "alpha = [\"-6 deg\", \"6 deg\"]\nsample_step = \"10 ms\"\n");
  const SpecimenKind& kind = *language().find_kind("magic_formula");
  const auto channels = language().run(kind, kind.read(tir), *sweep);
  ASSERT_TRUE(channels) << channels.failure().reason;
  EXPECT_EQ((*channels)["alpha"].size(), 100u);
  EXPECT_NEAR((*channels)["alpha"].back(), 6.0 * M_PI / 180.0, 1e-12);
  EXPECT_GT((*channels)["Fy"].front(), 1000.0);
  EXPECT_LT((*channels)["Fy"].back(), -1000.0);
}

TEST_F(EveryTest, AStandingTireHasTheStiffnessOfItsFile) {
  const auto tir = write("tire.tir", kTir);
  const SpecimenKind& kind = *language().find_kind("magic_formula");
  const auto curve =
      language().run(kind,
                     kind.read(tir),
                     *test("kind = \"static_stiffness\"\ndeflections = [\"10 mm\", \"20 mm\"]\n"));
  ASSERT_TRUE(curve) << curve.failure().reason;
  // With Q_FZ2 = 0 the force is a straight line.
  EXPECT_NEAR((*curve)["force"][1], 190000.0 * 0.02, 1.0);
  // This tire model touches the road at one point, so the force on a cleat is that beside the
  // cleat.
  const auto on_cleat = language().run(
      kind,
      kind.read(tir),
      *test("kind = \"static_stiffness\"\ndeflections = [\"10 mm\", \"20 mm\"]\n"
            "[cleat]\nheight = \"20 mm\"\nlength = \"50 mm\"\nangle = \"90 deg\"\n"));
  ASSERT_TRUE(on_cleat) << on_cleat.failure().reason;
  EXPECT_NEAR((*on_cleat)["force"][1], (*curve)["force"][1], 1e-6);
  const auto under_load = language().run(
      kind,
      kind.read(tir),
      *test("kind = \"static_stiffness\"\nload = \"4 kN\"\ndirections = [\"vertical\"]\n"));
  ASSERT_TRUE(under_load) << under_load.failure().reason;
  EXPECT_NEAR((*under_load)["vertical"][0], 190000.0, 500.0);
}

// If the patch is twisted by a large angle its bristles slide. The stiffness depends on the twist
// and the travel, which are therefore keys of the test.
TEST_F(EveryTest, StiffnessIsThatOverTheWayOfTheTest) {
  const SpecimenKind& kind = *language().find_kind("ring_tire");
  const auto found = [&](const std::string& way) {
    const auto channels = language().run(kind,
                                         kind.read(kRing),
                                         *test("kind = \"static_stiffness\"\nload = \"4 kN\"\n"
                                               "directions = [\"longitudinal\", \"torsional\"]\n" +
                                               way));
    EXPECT_TRUE(channels);
    return std::pair((*channels)["longitudinal"][0], (*channels)["torsional"][0]);
  };
  const auto usual = found("");
  const auto stated = found("travel = \"1 mm\"\ntwist = \"1 mrad\"\n");
  EXPECT_EQ(stated, usual);
  const auto far = found("travel = \"20 mm\"\ntwist = \"3 deg\"\n");
  EXPECT_LT(far.first, 0.95 * usual.first);
  EXPECT_LT(far.second, 0.95 * usual.second);
}

// One test of three models: the ring has blocks, the formula the rectangle 2 a x 2 b, here with
// Q_RA1 and Q_RB1 alone: a = R0 Q_RA1 sqrt(Fz/(Cz R0)), b = w Q_RB1 (Fz/(Cz R0))^(1/3).
TEST_F(EveryTest, EveryTireHasAFootprint) {
  const auto tir =
      write("tire.tir", std::string(kTir) + "[CONTACT_PATCH]\nQ_RA1 = 0.9\nQ_RB1 = 1.2\n");
  const auto footprint = test("kind = \"footprint\"\nloads = [\"2 kN\", \"4 kN\"]\n");
  for (const SpecimenKind* kind : language().kinds) {
    const bool is_meshed = kind->name() == "fe_tire" || kind->name() == "inp_tire";
    if (is_meshed || !can(*kind, *footprint)) continue;  // tested by tests of their own
    const auto channels =
        language().run(*kind, kind->read(kind->name() == "ring_tire" ? kRing : tir), *footprint);
    ASSERT_TRUE(channels) << kind->name() << channels.failure().reason;
    EXPECT_EQ(channels->all().size(), footprint->channels().size());
    for (int i : {0, 1}) {
      const auto at = static_cast<std::size_t>(i);
      const double load = (*channels)["load"][at];
      EXPECT_NEAR(load, 2000.0 * (i + 1), 0.1) << kind->name();
      EXPECT_NEAR((*channels)["mean_pressure"][at] * (*channels)["area"][at], load, 1e-6)
          << kind->name();
      if (kind->name() == "ring_tire") continue;
      const double share = load / (190000.0 * 0.316);
      EXPECT_NEAR((*channels)["length"][at], 2.0 * 0.316 * 0.9 * std::sqrt(share), 1e-6)
          << kind->name();
      EXPECT_NEAR((*channels)["width"][at], 2.0 * 0.205 * 1.2 * std::cbrt(share), 1e-6)
          << kind->name();
    }
    EXPECT_GT((*channels)["length"][1], (*channels)["length"][0]) << kind->name();
  }
  const SpecimenKind& formula = *language().find_kind("magic_formula");
  const auto without = language().run(formula, formula.read(write("bare.tir", kTir)), *footprint);
  ASSERT_FALSE(without);
  EXPECT_NE(without.failure().reason.find("contact patch"), std::string::npos);
}

// A free tire has the two in-plane modes n = 1 at one frequency, a tire on the ground at two
// frequencies.
TEST_F(EveryTest, ARingHasModesOnTheGroundAndOffIt) {
  const SpecimenKind& ring = *language().find_kind("ring_tire");
  const auto free = test("kind = \"modes\"\ncount = 8\n");
  const auto standing = test("kind = \"modes\"\nload = \"4 kN\"\ncount = 8\n");
  const auto air = language().run(ring, ring.read(kRing), *free),
             ground = language().run(ring, ring.read(kRing), *standing);
  ASSERT_TRUE(air && ground);
  EXPECT_EQ(air->all().size(), free->channels().size());
  for (const auto& channel : free->channels()) {
    ASSERT_NE(air->find(channel.name), nullptr) << channel.name;
    EXPECT_EQ((*air)[channel.name].size(), 8u);
  }
  EXPECT_NEAR((*air)["frequency"][1], (*air)["frequency"][2], 1e-6);
  EXPECT_GT(std::abs((*ground)["frequency"][1] - (*ground)["frequency"][2]), 0.1);
  const auto tir = write("tire.tir", kTir);
  const SpecimenKind& formula = *language().find_kind("magic_formula");
  EXPECT_THROW((void)language().run(formula, formula.read(tir), *standing), InputError);
}

// If the test and the file state the same pressure the results are bitwise equal; another pressure
// gives another load.
TEST_F(EveryTest, ThePressureOfATestIsThatOfAFileWithIt) {
  const std::vector<std::string> tests = {
      "kind = \"load_deflection\"\ndeflections = [\"15 mm\"]\n",
      "kind = \"static_stiffness\"\ndeflections = [\"15 mm\"]\n",
      "kind = \"footprint\"\ndeflections = [\"15 mm\"]\n",
      "kind = \"modes\"\ncount = 4\n",
      "kind = \"uniformity\"\nload = \"4 kN\"\nspeed = \"5 m/s\"\nstep = \"4 ms\"\n",
      "kind = \"rolling_stiffness\"\nload = \"4 kN\"\nmeasures = [\"cornering\"]\n",
      "kind = \"slip_sweep\"\nload = \"4 kN\"\nspeed = \"20 m/s\"\nalpha = [\"-1 deg\", \"1 "
      "deg\"]\n"
      "run_in = \"50 ms\"\nduration = \"50 ms\"\n",
      "kind = \"drum_cleat\"\ndeflection = \"15 mm\"\nspeed = \"20 m/s\"\ndrum_diameter = \"2 m\"\n"
      "run_in = \"50 ms\"\nduration = \"60 ms\"\nlead = \"20 ms\"\n"};
  std::string tir = kTir + "[CONTACT_PATCH]\nQ_RA1 = 0.9\nQ_RB1 = 1.2\n";
  tir.insert(tir.find("[VERTICAL]\n") + 11, "PFZ1 = 0.7\n");
  tir.insert(tir.find("PKY1 ="), "PPY1 = -0.6\n");
  tir += "[OPERATING_CONDITIONS]\nINFLPRES = 220000\nNOMPRES = 220000\n";
  const auto file = write("tire.tir", tir);
  for (const char* name : {"magic_formula", "rigid_ring", "ring_tire"}) {
    const SpecimenKind& kind = *language().find_kind(name);
    const bool is_ring = kind.name() == "ring_tire";
    const Document own = kind.read(is_ring ? kRing : file);
    Document stated = own;
    stated.set(is_ring ? "pressure" : "INFLPRES", 3e5);
    for (const std::string& text : tests) {
      const auto plain = test(text), inflated = test("pressure = \"3 bar\"\n" + text);
      if (!can(kind, *plain)) continue;
      EXPECT_NE(identity(text), identity("pressure = \"3 bar\"\n" + text));
      EXPECT_NE(inflated->in_words().find("3 bar"), std::string::npos) << inflated->in_words();
      const auto before = language().run(kind, own, *plain);
      const auto one = language().run(kind, own, *inflated);
      const auto other = language().run(kind, stated, *plain);
      ASSERT_TRUE(before && one && other) << name << " " << text;
      bool differs = false;
      for (const Channel& channel : one->all()) {
        EXPECT_EQ(channel.values, (*other)[channel.name]) << name << " " << text << channel.name;
        differs = differs || channel.values != (*before)[channel.name];
      }
      EXPECT_TRUE(differs || text.find("uniformity") != std::string::npos) << name << " " << text;
      if (one->find("force") && !text.find("kind = \"load")) {
        EXPECT_GT((*one)["force"][0], 1.02 * (*before)["force"][0]) << name;
      }
    }
  }
}

// Models of rolling tires state friction in their own files, so a test that states it is refused
// before it runs.
TEST_F(EveryTest, AStatedConditionIsForModelsThatTakeIt) {
  const SpecimenKind &ring = *language().find_kind("ring_tire"),
                     &fe = *language().find_kind("fe_tire");
  const std::string press = "kind = \"load_deflection\"\ndeflections = [\"10 mm\"]\n";
  for (const std::string& plain : {press,
                                   std::string("kind = \"modes\"\nload = \"4 kN\"\n"),
                                   std::string("kind = \"footprint\"\nloads = [\"4 kN\"]\n")}) {
    const auto inflated = test(plain + "pressure = \"2 bar\"\n");
    EXPECT_TRUE(can(ring, *test(plain)) && can(fe, *test(plain))) << plain;
    EXPECT_TRUE(can(ring, *inflated) && can(fe, *inflated)) << plain;
    const auto stated = test(plain + "friction = 0.8\n");
    EXPECT_TRUE(can(fe, *stated)) << plain;
    EXPECT_FALSE(can(ring, *stated)) << plain;
    EXPECT_EQ(language().kinds_for(stated->needs()),
              (std::vector<std::string>{"fe_tire", "inp_tire"}));
  }
  const auto curve = language().run(ring, ring.read(kRing), *test(press));
  ASSERT_TRUE(curve);
  EXPECT_GT((*curve)["force"][0], 500.0);
}

TEST_F(EveryTest, SteadyStatesAreForTiresThatHaveThem) {
  const auto tir = write("tire.tir", kTir);
  write("states.csv", "Fz [kN],alpha [deg]\n4,2\n4,-2\n");
  const auto steady = test("kind = \"steady_states\"\nstates = \"states.csv\"\n");
  const SpecimenKind& formula = *language().find_kind("magic_formula");
  const auto channels = language().run(formula, formula.read(tir), *steady);
  ASSERT_TRUE(channels);
  EXPECT_LT((*channels)["Fy"][0], -500.0);
  EXPECT_THROW(
      (void)language().run(*language().find_kind("ring_tire"), Document::read(kRing), *steady),
      InputError);
  EXPECT_TRUE(can(*language().find_kind("fe_tire"), *steady));
  EXPECT_TRUE(can(*language().find_kind("inp_tire"), *steady));
}

// The coefficients of a Magic Formula contain its friction, and its lag has no steps of time.
TEST_F(EveryTest, FrictionAndStepsOfTimeAreForFiniteElements) {
  const auto tir = write("tire.tir", kTir);
  write("states.csv", "time [s],Fz [kN],alpha [deg]\n0,4,2\n0.1,4,-2\n");
  const SpecimenKind &formula = *language().find_kind("magic_formula"),
                     &fe = *language().find_kind("fe_tire");
  const std::string plain = "kind = \"steady_states\"\nstates = \"states.csv\"\n";
  const auto rough = test(plain + "friction = 0.9\n");
  EXPECT_FALSE(can(formula, *rough));
  EXPECT_TRUE(can(fe, *rough));
  EXPECT_NE(identity(plain), identity(plain + "friction = 0.9\n"));
  EXPECT_NE(rough->in_words().find("friction 0.9"), std::string::npos);
  try {
    (void)language().run(formula, formula.read(tir), *rough);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("takes friction"), std::string::npos) << error.what();
  }
  const std::string lagging = "kind = \"slip_history\"\nstates = \"states.csv\"\n";
  const auto history = test(lagging), in_steps = test(lagging + "step = \"1 ms\"\n");
  EXPECT_TRUE(can(formula, *history) && can(fe, *history));
  EXPECT_FALSE(can(formula, *test(lagging + "friction = 0.9\n")));
  try {
    (void)language().run(formula, formula.read(tir), *in_steps);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("expected no `step`"), std::string::npos)
        << error.what();
  }
  EXPECT_NE(complaint(plain + "friction = 6\n").find("friction"), std::string::npos);
}

// A tire on the other side turns and leans in the opposite direction, and its forces have the
// opposite sign; without the limit the load is that of the table. Tests that differ have different
// identities.
TEST_F(EveryTest, SteadyStatesAreTakenAsTheTestSays) {
  const auto tir = write("tire.tir", kTir);
  write("states.csv", "Fz [kN],alpha [deg],gamma [deg]\n4,2,1\n4,-2,-1\n");
  const std::string head = "kind = \"steady_states\"\nstates = \"states.csv\"\n";
  const SpecimenKind& formula = *language().find_kind("magic_formula");
  Document numbers = formula.read(tir);
  numbers.set("PVY1", 0.05);  // a pull to one side
  const auto plain = test(head), other = test(head + "side = \"other\"\n"),
             tangent = test(head + "angles = \"tangent\"\n");
  const Channels as_measured = *language().run(formula, numbers, *plain),
                 mirrored = *language().run(formula, numbers, *other);
  EXPECT_NEAR(mirrored["Fy"][0], -as_measured["Fy"][1], 1e-9);
  EXPECT_NE(as_measured["Fy"][0], -as_measured["Fy"][1]);
  const double ratio =
      (*language().run(formula, numbers, *tangent))["Fy"][0] / as_measured["Fy"][0];
  EXPECT_NE(ratio, 1.0);
  EXPECT_NEAR(ratio, 1.0, 1e-3);  // tan 2 deg is 0.04 % more than 2 deg
  EXPECT_NE(identity(head), identity(head + "side = \"other\"\n"));
  EXPECT_NE(identity(head), identity(head + "angles = \"tangent\"\n"));
  EXPECT_EQ(identity(head), identity(head + "limits = \"on\"\n"));
}

// The derivatives refer to the results in the signs that the test requests.
TEST_F(EveryTest, SlopesOfSteadyStatesFollowTheConventionsOfTheTest) {
  const auto tir = write("tire.tir", kTir);
  write("states.csv", "Fz [kN],alpha [deg],gamma [deg]\n4,2,1\n4,-3,-1\n");
  const auto steady = test(
      "kind = \"steady_states\"\nstates = \"states.csv\"\nside = \"other\"\nangles = "
      "\"tangent\"\n");
  const SpecimenKind& formula = *language().find_kind("magic_formula");
  const auto at = [&](double factor) {
    Document numbers = formula.read(tir);
    numbers.set("PKY1", factor * numbers.root().quantity("PKY1", "1"));
    return numbers;
  };
  const double PKY1 = at(1.0).root().quantity("PKY1", "1"), h = 1e-5;
  const auto found =
      steady->run_with_slopes(*formula.build(at(1.0)), {.channels = {"Fy"}, .paths = {"PKY1"}});
  ASSERT_TRUE(found);
  const auto more = *language().run(formula, at(1.0 + h), *steady),
             less = *language().run(formula, at(1.0 - h), *steady);
  for (std::size_t i = 0; i < 2; ++i) {
    const double slope = (more["Fy"][i] - less["Fy"][i]) / (2.0 * h * PKY1);
    EXPECT_NEAR(found->find("Fy")->slopes[i], slope, 1e-6 * std::abs(slope));
  }
}

// The tree of numbers returns the numbers of the file, to the last bit.
TEST_F(EveryTest, TheNumbersOfATirAreThoseOfTheFile) {
  const auto tir = write("tire.tir", kTir);
  const auto direct = formats::read_tir(tir).parameters;
  const Document numbers = read_tir_numbers(tir);
  const auto back = parameters_of(numbers);
  for (const auto& field : magic_formula::parameter_fields())
    EXPECT_EQ(back.*field.member, direct.*field.member) << field.name;
  EXPECT_EQ(back.version, direct.version);
  EXPECT_EQ(formats::tir_text(direct), tir_text_of(numbers));
}

TEST_F(EveryTest, ANumberOfATirVariesByItsName) {
  Document numbers = read_tir_numbers(write("tire.tir", kTir));
  EXPECT_EQ(numbers.unit("VERTICAL_STIFFNESS"), "N/m");
  numbers.set("VERTICAL_STIFFNESS", 2.5e5);
  EXPECT_EQ(parameters_of(numbers).VERTICAL_STIFFNESS, 2.5e5);
  numbers.set("FNOMIN", -1.0);
  EXPECT_THROW(parameters_of(numbers), InputError);
}

TEST_F(EveryTest, ComplaintsSayWhatIsExpected) {
  EXPECT_NE(complaint("kind = \"drum\"\n").find("\"drum_cleat\""), std::string::npos);
  EXPECT_NE(complaint("kind = \"slip_sweep\"\nspeed = \"40 km/h\"\nload = \"4 kN\"\n")
                .find("alpha or kappa is required"),
            std::string::npos);
  EXPECT_NE(complaint("kind = \"static_stiffness\"\nload = \"4 kN\"\ndirections = [\"up\"]\n")
                .find("\"longitudinal\""),
            std::string::npos);
  const std::string drum =
      "kind = \"drum_cleat\"\nload = \"4 kN\"\ndrum_diameter = \"2.5 m\"\n"
      "lead = \"50 ms\"\nduration = \"50 ms\"\n";
  const std::string cleat = "[cleat]\nheight = \"10 mm\"\nlength = \"20 mm\"\n";
  EXPECT_NE(complaint(drum + "speed = \"30 km/h\"\n" + cleat).find("before the cleat"),
            std::string::npos);
  EXPECT_NE(complaint(drum + "speed = \"3000 km/h\"\n").find("at most 720 km/h"),
            std::string::npos);
  EXPECT_NE(complaint("kind = \"static_stiffness\"\n").find("one of the two"), std::string::npos);
  EXPECT_NE(complaint("kind = \"static_stiffness\"\nload = \"4 kN\"\n" + cleat).find("flat ground"),
            std::string::npos);
  EXPECT_NE(complaint("kind = \"static_stiffness\"\ndeflections = [\"20 mm\"]\n" + cleat +
                      "bevel = \"11 mm\"\n")
                .find("bevel"),
            std::string::npos);
}

TEST_F(EveryTest, AFileThatDoesNotSayItsKindIsToldHow) {
  try {
    language().kind_of_file(write("tire.toml", "pressure = \"2 bar\"\n"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("\"ring_tire\""), std::string::npos) << error.what();
  }
}

// The range that a test states without a run is that of the record.
TEST(ReachOfATest, IsThatOfItsRecord) {
  char pattern[] = "/tmp/latsch_reach_XXXXXX";
  ASSERT_TRUE(mkdtemp(pattern));
  const std::filesystem::path file = std::filesystem::path(pattern) / "test.toml";
  const SpecimenKind& kind = *language().find_kind("ring_tire");
  const Document numbers = kind.read(kRing);
  for (const char* sampling : {"0.5 ms", "1.5 ms", "3.5 ms"}) {
    std::ofstream(file) << "kind = \"drum_cleat\"\nspeed = \"30 km/h\"\nload = \"4 kN\"\n"
                        << "drum_diameter = \"2.5 m\"\n"
                        << "run_in = \"5 ms\"\nlead = \"4 ms\"\nduration = \"31 ms\"\n"
                        << "step = \"0.5 ms\"\nsample_step = \"" << sampling << "\"\n";
    const auto test = language().read_test(file);
    const auto channels = language().run(kind, numbers, *test);
    ASSERT_TRUE(channels) << channels.failure().reason;
    const auto& time = (*channels)["time"];
    const auto known = test->reach("time");
    ASSERT_TRUE(known);
    EXPECT_NEAR(known->from, time.front(), 1e-12) << sampling;
    EXPECT_NEAR(known->to, time.back(), 1e-12) << sampling;
  }
  std::ofstream(file) << "kind = \"slip_sweep\"\nspeed = \"30 km/h\"\nload = \"4 kN\"\n"
                      << "alpha = [\"-1 deg\", \"1 deg\"]\nrun_in = \"5 ms\"\n"
                      << "duration = \"20 ms\"\nsample_step = \"1.5 ms\"\n";
  const auto sweep = language().read_test(file);
  const auto channels = language().run(kind, numbers, *sweep);
  ASSERT_TRUE(channels) << channels.failure().reason;
  EXPECT_EQ(sweep->reach("time")->from, (*channels)["time"].front());
  EXPECT_EQ(sweep->reach("time")->to, (*channels)["time"].back());
  std::filesystem::remove_all(pattern);
}

}  // namespace
}  // namespace latsch::experiment
