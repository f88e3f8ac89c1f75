// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/known_limits.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "experiment/language.h"
#include "experiment/rigs/slip/lift_watch.h"

namespace latsch::experiment {
namespace {

/// Returns a tire of a study with changed numbers: lines "KEY = value" replace those of its file or
/// are added to [MODEL].
Document tir_with(const SpecimenKind& kind, const std::vector<std::string>& lines) {
  std::string text =
      read_text_file(LATSCH_SOURCE_DIR "/studies/tire_model_comparison/rigid_ring.tir");
  for (const std::string& line : lines) {
    if (line.front() == '[') {
      text += line;
      continue;
    }
    const std::string key = line.substr(0, line.find(' '));
    const auto begin = text.find("\n" + key + " ");
    if (begin != text.npos) text.erase(begin + 1, text.find('\n', begin + 1) - begin);
    text.insert(text.find("[DIMENSION]"), line + "\n");
  }
  const ScratchFolder folder;
  const auto file = folder.path() / "tire.tir";
  write_text_file(file, text);
  return kind.read(file);
}

struct Told {
  std::vector<std::string> notes;
  std::string failure, refusal;

  bool says(const std::string& part) const {
    return std::any_of(notes.begin(), notes.end(), [&](const std::string& note) {
      return note.find(part) != std::string::npos;
    });
  }
};

Told told_by(const std::string& kind_name,
             const std::string& keys,
             const std::vector<std::string>& lines = {}) {
  const SpecimenKind& kind = *language().find_kind(kind_name);
  Told told;
  try {
    const auto test = language().read_test(
        Document::parse("test = {" + keys + "}", "t.toml").root().table("test"), {});
    const auto notes =
        language().run_in_blocks(kind, tir_with(kind, lines), *test, [](const Channels&) {});
    if (notes) told.notes = *notes;
    if (!notes) told.failure = notes.failure().reason;
  } catch (const InputError& error) {
    told.refusal = error.what();
  }
  return told;
}

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

const std::string kRolling = "kind = \"rolling_stiffness\", load = \"4 kN\"";
const std::string kSweep =
    "kind = \"slip_sweep\", speed = \"60 km/h\", load = \"4 kN\", sample_step = \"100 ms\", "
    "alpha = [\"-10 deg\", \"10 deg\"]";
const std::string kDrum =
    "kind = \"drum_cleat\", speed = \"30 km/h\", load = \"4 kN\", drum_diameter = \"2.5 m\", "
    "run_in = \"0.1 s\", lead = \"0.02 s\", duration = \"0.1 s\", cleat = {height = \"10 mm\", "
    "length = \"20 mm\"}";

TEST(KnownLimits, EveryRollingTestTellsTheRangesThatTheTireLeaves) {
  EXPECT_TRUE(told_by("magic_formula", kRolling, {"FZMAX = 3000"}).says("FZMAX = 3000 N"));
  EXPECT_TRUE(told_by("magic_formula", kSweep, {"ALPMIN = -0.05", "ALPMAX = 0.05"})
                  .says("above ALPMAX = 2.865 deg"));
  EXPECT_TRUE(told_by("magic_formula", kSweep, {"ALPMIN = -0.05", "ALPMAX = 0.05"})
                  .says("below ALPMIN = -2.865 deg"));
  EXPECT_TRUE(told_by("rigid_ring", kDrum, {"FZMIN = 100", "FZMAX = 100"}).says("FZMAX = 100 N"));
  EXPECT_TRUE(told_by("rigid_ring", kDrum, {"PRESMAX = 220000"}).says("PRESMAX = 2.2 bar"));
  EXPECT_TRUE(told_by("magic_formula", kDrum, {"VXLOW = 19"}).says("below VXLOW = 19 m/s"));
  EXPECT_TRUE(
      told_by("magic_formula", kSweep + ", camber = \"5 deg\"", {"CAMMAX = 0.05"}).says("CAMMAX"));
}

/// Returns the limits that a test states before it runs on the tire with changed lines of its file.
std::string told_ahead(const std::string& kind_name,
                       const std::string& keys,
                       const std::vector<std::string>& lines) {
  const auto test = language().read_test(
      Document::parse("test = {" + keys + "}", "t.toml").root().table("test"), {});
  const SpecimenKind& kind = *language().find_kind(kind_name);
  const auto specimen = kind.build(tir_with(kind, lines));
  std::string all;
  for (const std::string& one : dynamic_cast<const TellsLimits&>(*test).limits(*specimen))
    all += one + "\n";
  return all;
}

// A study then states them before its first trial and in every check, not only at its best trial.
TEST(KnownLimits, RangesThatATestLeavesByItsOwnConditionsAreToldBeforeItRuns) {
  for (const auto& [kind, keys] :
       {std::pair{"magic_formula", kRolling}, {"magic_formula", kSweep}, {"rigid_ring", kDrum}}) {
    expect_part(told_ahead(kind, keys, {"FZMAX = 3000"}),
                "Fz is 4000 N in this test, above FZMAX = 3000 N");
    expect_part(told_ahead(kind, keys + ", pressure = \"3 bar\"", {"PRESMAX = 220000"}),
                "The pressure is 3 bar in this test, above PRESMAX = 2.2 bar");
    EXPECT_EQ(told_ahead(kind, keys, {"FZMIN = 100", "FZMAX = 12000"}).find("FZM"),
              std::string::npos);
  }
  const std::string sweep = kSweep + ", camber = \"5 deg\"";
  for (const char* part : {"alpha is 10 deg in this test, above ALPMAX = 2.865 deg",
                           "alpha is -10 deg in this test, below ALPMIN = -2.865 deg",
                           "gamma is 5 deg in this test, above CAMMAX = 2.865 deg"})
    expect_part(
        told_ahead("magic_formula", sweep, {"ALPMIN = -0.05", "ALPMAX = 0.05", "CAMMAX = 0.05"}),
        part);
  expect_part(told_ahead("magic_formula", kDrum, {"VXLOW = 9"}), "below VXLOW = 9 m/s");
}

/// On this high bar the belt of a light tire loses contact.
TEST(KnownLimits, ATireThatLeavesTheRoadSaysFromWhenToWhen) {
  const std::string jump =
      "kind = \"drum_cleat\", speed = \"100 km/h\", load = \"150 N\", drum_diameter = \"2.5 m\", "
      "run_in = \"0.1 s\", lead = \"0.02 s\", duration = \"0.1 s\", step = \"0.2 ms\", cleat = "
      "{height = \"30 mm\", length = \"30 mm\", bevel = \"5 mm\"}";
  const Told told = told_by("rigid_ring", jump);
  EXPECT_EQ(told.failure + told.refusal, "");
  EXPECT_TRUE(
      told.says("the tire leaves the road, 2 times between 0.0036 and 0.0164 s, for 3.8 ms"));
  EXPECT_TRUE(told.says("that of the belt's inertia on the hub"));
  EXPECT_FALSE(told_by("rigid_ring", kDrum).says("leaves the road"));
}

TEST(KnownLimits, StepsOffTheRoadAreCountedAndTheirForceIsSaid) {
  LiftLog never, twice;
  for (int i = 1; i <= 10; ++i) {
    never.see(0.01 * i, 0.01, 100.0, 100.0);
    const bool is_off = i == 3 || i == 7 || i == 8;
    twice.see(0.01 * i, 0.01, is_off ? 0.0 : 100.0, is_off ? 0.0 : 100.0);
  }
  EXPECT_EQ(never.sentence(), "");
  expect_part(twice.sentence(),
              "2 times between 0.02 and 0.08 s, for 30 ms in all; Fz there is 0,");
}

TEST(KnownLimits, StatesWithoutLoadAreCounted) {
  const ScratchFolder folder;
  const auto file = folder.path() / "states.csv";
  write_text_file(file, "Fz [N],alpha [deg]\n4000,2\n0,2\n-50,2\n");
  const std::string keys = "kind = \"steady_states\", states = \"" + file.string() + "\"";
  EXPECT_TRUE(told_by("magic_formula", keys).says("2 of 3 states have a load of 0 or less"));
  write_text_file(file, "Fz [N],alpha [deg]\n4000,2\n10,2\n");
  EXPECT_FALSE(told_by("magic_formula", keys).says("load of 0 or less"));
}

TEST(KnownLimits, AWheelBelowVxlowSaysWhatIsAssumedForIt) {
  const std::string slow =
      "kind = \"slip_sweep\", speed = \"0.5 m/s\", load = \"4 kN\", sample_step = \"100 ms\", "
      "duration = \"10 s\", alpha = [\"0 deg\", \"4 deg\"]";
  EXPECT_TRUE(told_by("magic_formula", slow, {"VXLOW = 1", "DAMP_VLOW = 0"})
                  .says("DAMP_VLOW is 0 or missing"));
  EXPECT_FALSE(
      told_by("magic_formula", slow, {"VXLOW = 1", "DAMP_VLOW = 0.001"}).says("DAMP_VLOW"));
  EXPECT_FALSE(told_by("magic_formula", kSweep, {"DAMP_VLOW = 0"}).says("DAMP_VLOW"));
}

TEST(KnownLimits, AStandingTireIsNotToldToRollSlowly) {
  const auto told = told_by("rigid_ring",
                            "kind = \"static_stiffness\", load = \"4 kN\", directions = "
                            "[\"lateral\"]",
                            {"VXLOW = 3"});
  EXPECT_EQ(told.failure + told.refusal, "");
  EXPECT_TRUE(told.notes.empty());
}

const std::vector<std::string> kCurve = {"[DEFLECTION_LOAD_CURVE]\n0 0\n0.01 2000\n0.02 5000\n"};

TEST(KnownLimits, ALoadBeyondTheCurveOfTheFileIsTold) {
  const std::string beyond = "beyond the last point of [DEFLECTION_LOAD_CURVE], 5000 N at 20 mm";
  for (const char* kind : {"magic_formula", "rigid_ring"})
    for (const std::string& keys : {std::string("kind = \"footprint\", loads = [\"6 kN\"]"),
                                    std::string("kind = \"load_deflection\", deflections = [\"25 "
                                                "mm\"]"),
                                    std::string("kind = \"static_stiffness\", load = \"6 kN\""),
                                    std::string("kind = \"rolling_stiffness\", load = \"6 kN\"")}) {
      EXPECT_TRUE(told_by(kind, keys, kCurve).says(beyond)) << kind << keys;
      std::string within = keys;
      for (const char* most : {"6 kN", "25 mm"})
        if (const auto at = within.find(most); at != within.npos)
          within.replace(at, std::string(most).size(), most[0] == '6' ? "4 kN" : "15 mm");
      EXPECT_FALSE(told_by(kind, within, kCurve).says(beyond)) << kind << within;
    }
}

TEST(KnownLimits, AStiffnessThatTheFileDoesNotDetermineIsRefused) {
  const auto standing = [](const char* direction) {
    return std::string("kind = \"static_stiffness\", load = \"4 kN\", directions = [\"") +
           direction + "\"]";
  };
  expect_part(
      told_by("magic_formula", standing("longitudinal"), {"LONGITUDINAL_STIFFNESS = 0"}).refusal,
      "no longitudinal stiffness: its file has no LONGITUDINAL_STIFFNESS");
  expect_part(told_by("magic_formula", standing("lateral"), {"LATERAL_STIFFNESS = 0"}).refusal,
              "no lateral stiffness: its file has no LATERAL_STIFFNESS");
  expect_part(told_by("magic_formula", standing("longitudinal"), {"FITTYP = 6"}).refusal,
              "has no PTX1");
  expect_part(
      told_by(
          "magic_formula", standing("torsional"), {"YAW_STIFFNESS = 0", "Q_RA1 = 0", "Q_RA2 = 0"})
          .refusal,
      "no torsional stiffness");
  EXPECT_EQ(told_by("magic_formula", standing("vertical"), {"LATERAL_STIFFNESS = 0"}).refusal, "");
  EXPECT_TRUE(told_by("magic_formula", standing("torsional"), {"YAW_STIFFNESS = 0"})
                  .says("assumed, because there is no YAW_STIFFNESS"));
  EXPECT_TRUE(told_by("rigid_ring", standing("torsional"), {"YAW_STIFFNESS = 0"})
                  .says("assumed, because there is no YAW_STIFFNESS"));
}

/// Runs steady states or a history of slips from a file with these rows; returns the reported
/// limits.
Told told_of_states(const std::string& test,
                    const std::string& header,
                    const std::string& rows,
                    const std::vector<std::string>& lines = {}) {
  const ScratchFolder folder;
  write_text_file(folder / "s.csv", header + "\n" + rows);
  return told_by(
      "magic_formula", test + ", states = \"" + (folder.path() / "s.csv").string() + "\"", lines);
}

TEST(KnownLimits, AHistoryOfSlipsTellsWhatItsTimesCannotShow) {
  const std::string test = "kind = \"slip_history\"", head = "time [s],Fz [N],alpha [deg]";
  expect_part(told_of_states(test, head, "0,4000,1\n").refusal, "a single sample");
  expect_part(told_of_states(test, head, "0.3,4000,1\n0.2,4000,2\n0.1,4000,3\n").refusal,
              "does not rise in 2 of 2 steps");
  const std::string rows = "0,4000,1\n0.01,4000,2\n0.02,4000,3\n1.5,4000,4\n1.51,4000,5\n";
  EXPECT_TRUE(told_of_states(test, head, rows).says("1.48 s behind sample 3"));
  EXPECT_TRUE(told_of_states(test, head, rows, {"FZMAX = 3000"}).says("5 of 5 states lie outside"));
}

TEST(KnownLimits, TurnSlipWithoutItsCoefficientsIsToldBeforeTheTestRuns) {
  const ScratchFolder folder;
  write_text_file(folder / "s.csv", "Fz [N],phit [1/m]\n4000,0.1\n6000,0\n");
  const SpecimenKind& kind = *language().find_kind("magic_formula");
  const auto limits = [&](const std::string& turn_slip, const std::vector<std::string>& lines) {
    const auto test = language().read_test(
        Document::parse("test = {kind = \"steady_states\", turn_slip = \"" + turn_slip +
                            "\", states = \"" + (folder.path() / "s.csv").string() + "\"}",
                        "t.toml")
            .root()
            .table("test"),
        {});
    std::string all;
    const auto specimen = kind.build(tir_with(kind, lines));
    for (const std::string& one : dynamic_cast<const TellsLimits&>(*test).limits(*specimen))
      all += one + "\n";
    return all;
  };
  expect_part(limits("on", {}), "turn_slip = \"on\" has no effect");
  EXPECT_EQ(limits("off", {}), "");
  EXPECT_EQ(limits("on", {"QDRP1 = 1", "PHYP1 = 1", "QCRP1 = 0.2", "QDZ10 = 0.3"}), "");
  expect_part(limits("on", {"QDRP1 = 1", "PHYP1 = 1", "QCRP1 = 0.2"}), "QDZ10 is 0, so that");
  expect_part(limits("off", {"FZMAX = 5000"}), "1 of 2 states lie outside of the ranges");
  expect_part(limits("off", {"FZMAX = 5000"}), "Fz above FZMAX = 5000 N in 1, up to 6000 N");
  expect_part(limits("off", {"FZMIN = 4500", "FZMAX = 5000"}),
              "Fz below FZMIN = 4500 N in 1, down to 4000 N; Fz above FZMAX = 5000 N in 1");
  expect_part(limits("off", kCurve), "1 of 2 states have a load beyond the last point");
}

TEST(KnownLimits, ATireWithinItsRangesSaysNothing) {
  const std::string slow = kSweep + ", duration = \"20 s\", step = \"1 ms\"";  // without a lag
  for (const std::string& keys : {kRolling, slow, kDrum})
    for (const char* kind : {"magic_formula", "rigid_ring"})
      for (const std::string& note : told_by(kind, keys, {"FZMIN = 100", "FZMAX = 12000"}).notes)
        expect_part(note,
                    // the sentence about the cleat
                    "a Magic Formula touches the road at one point");
}

/// Returns the notes of a test on a flexible ring that is shipped with Latsch.
std::vector<std::string> told_by_ring(const std::string& file, const std::string& keys) {
  const SpecimenKind& kind = *language().find_kind("ring_tire");
  const auto test = language().read_test(
      Document::parse("test = {" + keys + "}", "t.toml").root().table("test"), {});
  const auto notes = language().run_in_blocks(
      kind, kind.read(LATSCH_SOURCE_DIR "/studies/ring_tires/" + file), *test, [](const Channels&) {
      });
  return notes ? *notes : std::vector<std::string>{notes.failure().reason};
}

bool has_part(const std::vector<std::string>& all, const std::string& part) {
  return std::any_of(all.begin(), all.end(), [&](const std::string& one) {
    return one.find(part) != std::string::npos;
  });
}

TEST(KnownLimits, ARingThatPushesACamberedWheelToTheWrongSideIsTold) {
  const std::string flat = "is flat across (tread.crown_radius is 0)";
  const std::string ring = "passenger_205_55R16.toml";
  const auto rolled = told_by_ring(ring, kRolling + ", measures = [\"camber\"]");
  EXPECT_TRUE(has_part(rolled, "camber_stiffness is negative, -"));
  EXPECT_TRUE(has_part(rolled, flat));
  const auto crowned =
      told_by_ring("passenger_205_55R16_crowned.toml", kRolling + ", measures = [\"camber\"]");
  EXPECT_FALSE(has_part(crowned, "is negative"));
  EXPECT_FALSE(has_part(crowned, flat));
  EXPECT_FALSE(has_part(told_by_ring(ring, kRolling + ", measures = [\"slip\"]"), flat));
  // A cornering stiffness of the wrong sign, in which a fit may end, is reported likewise.
  EXPECT_TRUE(
      told_by("magic_formula", kRolling, {"PKY1 = 20"}).says("cornering_stiffness is negative"));
}

TEST(KnownLimits, CamberThatDoesNotChangeAFootprintIsTold) {
  const std::string standing = "kind = \"footprint\", loads = [\"4 kN\"]";
  for (const char* kind : {"magic_formula", "rigid_ring"}) {
    EXPECT_TRUE(told_by(kind, standing + ", camber = \"8 deg\"").says("those of the upright tire"));
    EXPECT_FALSE(told_by(kind, standing).says("upright tire"));
  }
  for (const std::string key : {"camber = \"2 deg\"", "friction = 0.8"})
    expect_part(told_by("magic_formula", "kind = \"modes\", " + key).refusal,
                "because the tire is in the air");
}

TEST(KnownLimits, ARecordThatCutsThePassageOverTheCleatIsTold) {
  const auto on_cleat = [](const std::string& angle, const std::string& more) {
    return told_by("rigid_ring",
                   "kind = \"drum_cleat\", load = \"4 kN\", drum_diameter = \"2.5 m\", " + more +
                       ", cleat = {height = \"10 mm\", length = \"20 mm\", angle = \"" + angle +
                       "\"}");
  };
  const std::string usual = "speed = \"30 km/h\", duration = \"0.2 s\"";
  EXPECT_FALSE(on_cleat("45 deg", usual).says("the tire touches the cleat"));
  EXPECT_TRUE(on_cleat("80 deg", usual).says("does not hold the beginning of the passage"));
  EXPECT_FALSE(on_cleat("80 deg", usual + ", lead = \"0.1 s\"").says("the tire touches the cleat"));
  // If the speed is low, the record of a passage over a straight cleat is also too short.
  EXPECT_TRUE(on_cleat("0 deg", "speed = \"4 km/h\", duration = \"0.2 s\", run_in = \"0.05 s\"")
                  .says("the tire starts on the cleat"));
}

TEST(KnownLimits, APressureWithoutEffectIsTold) {
  const std::string pressed = "kind = \"load_deflection\", deflections = [\"20 mm\"], pressure = ";
  EXPECT_TRUE(told_by("magic_formula", pressed + "\"1 bar\"")
                  .says("the pressure of the test has no "
                        "effect"));
  EXPECT_TRUE(told_by("rigid_ring", kRolling + ", pressure = \"3 bar\"").says("no effect"));
  EXPECT_TRUE(told_by("magic_formula", pressed + "\"2.4 bar\"").notes.empty());
  EXPECT_TRUE(told_by("magic_formula", pressed + "\"1 bar\"", {"PFZ1 = 0.7"}).notes.empty());
}

TEST(KnownLimits, APressureAtWhichTheVerticalStiffnessVanishesIsRefused) {
  // The factor 1 + PFZ1 (p / NOMPRES - 1) is 0 at p = 0.8 bar, with NOMPRES = 2.4 bar.
  const std::vector<std::string> pole = {"PFZ1 = 1.5", "NOMPRES = 240000", "INFLPRES = 240000"};
  for (const std::string pressure : {"0.8 bar", "0.5 bar"})
    for (const char* kind : {"magic_formula", "rigid_ring"})
      for (const std::string test : {"kind = \"load_deflection\", deflections = [\"20 mm\"]",
                                     "kind = \"rolling_stiffness\", load = \"1 kN\""}) {
        const Told told = told_by(kind, test + ", pressure = \"" + pressure + "\"", pole);
        expect_part(told.refusal + told.failure,
                    "no vertical stiffness at " + std::string(pressure[2] == '8' ? "80" : "50") +
                        " kPa: its factor 1 + PFZ1 dpi is");
      }
  EXPECT_TRUE(told_by("magic_formula",
                      "kind = \"load_deflection\", deflections = [\"20 mm\"], pressure = \"1 bar\"",
                      pole)
                  .refusal.empty());
  expect_part(
      told_of_states(
          "kind = \"steady_states\"", "Fz [N],alpha [deg],p [kPa]", "4000,2,200\n4000,2,60\n", pole)
          .refusal,
      "s.csv:3: the tire has no vertical stiffness at 60 kPa");
  // The tire's own inflation pressure is refused likewise.
  expect_part(told_by("magic_formula",
                      "kind = \"load_deflection\", deflections = [\"20 mm\"]",
                      {"PFZ1 = 1.5", "NOMPRES = 240000", "INFLPRES = 70000"})
                  .refusal,
              "no vertical stiffness at 70 kPa");
}

TEST(KnownLimits, TheRimHoldsTheTireUp) {
  const std::string pressed = "kind = \"load_deflection\", deflections = ";
  for (const char* kind : {"magic_formula", "rigid_ring"}) {
    expect_part(told_by(kind, pressed + "[\"330 mm\"]").failure, "the section of a tire");
    expect_part(told_by(kind, pressed + "[\"120 mm\"]").failure,
                "the rim has a radius of 203.2 mm");
    EXPECT_EQ(told_by(kind, pressed + "[\"100 mm\"]").failure, "");
    expect_part(told_by(kind, "kind = \"rolling_stiffness\", load = \"40 kN\"").failure,
                "is it a load this tire can carry?");
  }
  expect_part(told_by("magic_formula", pressed + "[\"190 mm\"]", {"RIM_RADIUS = 0"}).failure,
              "the section of a tire");
}

TEST(KnownLimits, ACleatAsHighAsTheSectionIsRefused) {
  std::string high = kDrum;
  high.replace(high.find("\"10 mm\""), 7, "\"120 mm\"");
  for (const char* kind : {"magic_formula", "rigid_ring"})
    expect_part(told_by(kind, high).refusal,
                "cleat.height is 120 mm, but the section of this tire is 112.8 mm high");
}

TEST(KnownLimits, DrumStepAndSpeedHaveTheirRanges) {
  const auto changed = [](const std::string& what, const std::string& with) {
    std::string keys = kDrum;
    keys.replace(keys.find(what), what.size(), with);
    return told_by("rigid_ring", keys).refusal;
  };
  expect_part(changed("\"2.5 m\"", "\"2.5 mm\""), "drum_diameter is \"2.5 mm\"");
  expect_part(changed("\"2.5 m\"", "\"25 km\""), "drum_diameter is \"25 km\"");
  expect_part(changed("run_in", "step = \"10 ms\", run_in"), "step moves the tire 83.3 mm");
  expect_part(changed("run_in", "step = \"1e-12 s\", run_in"), "step is \"1e-12 s\"");
  expect_part(told_by("magic_formula", kSweep + ", step = \"10 ms\"").refusal,
              "step moves the tire 167 mm");
  expect_part(told_by("magic_formula",
                      "kind = \"slip_sweep\", speed = \"0.01 km/h\", load = \"4 kN\", kappa = [0, "
                      "0.1]")
                  .refusal,
              "speed is");
}

TEST(KnownLimits, ASweepWithinARelaxationLengthIsTold) {
  std::string keys = kSweep;
  keys.replace(keys.find("sample_step = \"100 ms\""), 22, "duration = \"1 ms\"");
  EXPECT_TRUE(told_by("magic_formula", keys).says("moves the tire 0.0167 m on"));
}

TEST(KnownLimits, TravelAndTwistOfAStiffnessAreSmall) {
  const std::string standing = "kind = \"static_stiffness\", load = \"4 kN\", ";
  expect_part(told_by("rigid_ring", standing + "travel = \"1 m\"").refusal, "travel is \"1 m\"");
  expect_part(told_by("rigid_ring", standing + "twist = \"3 rad\"").refusal, "twist is \"3 rad\"");
  expect_part(
      told_by("magic_formula",
              "kind = \"static_stiffness\", load = \"1 kN\", directions = [\"vertical\"], travel = "
              "\"18 mm\"")
          .failure,
      "lifts the tire off the ground");
  expect_part(told_by("rigid_ring", standing + "directions = [\"vertical\", \"vertical\"]").refusal,
              "\"vertical\" twice");
  expect_part(told_by("rigid_ring", kRolling + ", measures = [\"slip\", \"slip\"]").refusal,
              "\"slip\" twice");
}

TEST(KnownLimits, AMagicFormulaDoesNotFeelACleat) {
  const char* test =
      "kind = \"static_stiffness\", deflections = [\"20 mm\"], "
      "cleat = {height = \"10 mm\", length = \"20 mm\"}";
  EXPECT_TRUE(told_by("magic_formula", test).says("touches the road at one point"));
  EXPECT_FALSE(told_by("rigid_ring", test).says("touches the road at one point"));
}

TEST(KnownLimits, ATirDoesNotTellConicityFromPlySteer) {
  for (const char* kind : {"magic_formula", "rigid_ring"}) {
    const char* test = "kind = \"uniformity\", load = \"4 kN\"";
    EXPECT_TRUE(told_by(kind, test, {"PHY1 = 0.004"}).says("ply_steer")) << kind;
    EXPECT_FALSE(
        told_by(kind, test, {"PHY1 = 0", "PHY2 = 0", "PVY1 = 0", "PVY2 = 0"}).says("ply_steer"))
        << kind;
  }
}

/// Returns the limits of a flexible ring, shipped with Latsch, in a test, as `latsch check` prints
/// them.
std::string ring_limits(const std::string& keys) {
  const SpecimenKind& kind = *language().find_kind("ring_tire");
  const auto specimen = kind.build(
      kind.read(LATSCH_SOURCE_DIR "/studies/ring_tires/passenger_205_55R16.toml"), nullptr);
  const auto test = language().read_test(
      Document::parse("test = {" + keys + "}", "t.toml").root().table("test"), {});
  std::string all;
  for (const std::string& one : dynamic_cast<const TellsLimits&>(*test).limits(*specimen))
    all += one + "\n";
  return all;
}

// The blocks of the ring are 2.4 mm apart. The force on a bar 4 mm wide is 1537 N; with blocks 0.4
// mm apart it is 1763 N. Flat ground carries 1533 N at this deflection.
TEST(KnownLimits, AFlexibleRingSaysThatItsBlocksDoNotResolveAShortBar) {
  const std::string standing = "kind = \"static_stiffness\", deflections = [\"20 mm\"], ";
  expect_part(ring_limits(standing + "cleat = {height = \"10 mm\", length = \"4 mm\"}"),
              "tread.blocks = 24 resolves it");
  EXPECT_EQ(ring_limits(standing + "cleat = {height = \"10 mm\", length = \"10 mm\"}"), "");
  expect_part(
      ring_limits(
          "kind = \"drum_cleat\", speed = \"30 km/h\", load = \"4 kN\", drum_diameter = \"2.5 m\", "
          "step = \"0.2 ms\", sample_step = \"1 ms\", "
          "cleat = {height = \"5 mm\", length = \"2 mm\"}"),
      "hardly at all below two");
}

TEST(KnownLimits, AFlexibleRingSaysThatABarAlongTheRoadMayLieBetweenItsLines) {
  const std::string standing = "kind = \"static_stiffness\", deflections = [\"20 mm\"], ";
  expect_part(ring_limits(standing + "cleat = {height = \"10 mm\", length = \"20 mm\", angle = "
                                     "\"90 deg\"}"),
              "tread.lines = 16 resolves it");
  EXPECT_EQ(ring_limits(standing + "cleat = {height = \"10 mm\", length = \"30 mm\", angle = "
                                   "\"90 deg\"}")
                .find("between two lines"),
            std::string::npos);
}

}  // namespace
}  // namespace latsch::experiment
