// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/tire_comparison.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/scratch_folder_testing.h"
#include "correlation/comparison/comparison_page.h"
#include "experiment/kinds/sparse_tir_testing.h"

namespace latsch::correlation {
namespace {

constexpr const char* kDrum =
    "kind = \"drum_cleat\"\nspeed = \"40 km/h\"\nload = \"4 kN\"\ndrum_diameter = \"2.5 m\"\n"
    "run_in = \"0.1 s\"\nduration = \"0.256 s\"\nlead = \"0.03 s\"\nsample_step = \"1 ms\"\n"
    "[cleat]\nheight = \"10 mm\"\nlength = \"60 mm\"\nbevel = \"5 mm\"\n";

class ComparedTires : public testing::Test {
 protected:
  ComparedTires() {
    const std::string same = experiment::sparse_tir(std::string("VERTICAL_DAMPING = 200\n") +
                                                    experiment::kLongitudinalForce);
    write("same.tir", same);
    std::string other = same;
    other.replace(other.find("190000"), 6, "380000");
    write("stiff.tir", other);
    write("drum.toml", kDrum);
  }

  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  ComparisonFile file(const std::string& specimen) {
    write("comparison.toml",
          specimen +
              "[tire.same]\nkind = \"magic_formula\"\nfile = \"same.tir\"\n"
              "[tire.stiff]\ntitle = \"Stiff & <odd>\"\nkind = \"magic_formula\"\n"
              "file = \"stiff.tir\"\n");
    return read_comparison_file(folder_ / "comparison.toml", experiment::language());
  }

  ScratchFolder folder_;
};

const std::string kSpecimen =
    "[specimen]\nkind = \"magic_formula\"\nfile = \"same.tir\"\n"
    "[test.cleat]\nfile = \"drum.toml\"\n";

TEST_F(ComparedTires, TheSpecimenItselfHasNoErrorAndAnotherTireHas) {
  const ComparisonFile read = file(kSpecimen);
  const TireComparison found = compare_tires(read);
  for (std::size_t c = 0; c < read.channels.size(); ++c) {
    EXPECT_EQ(found.tires[0].time_error[c], 0.0);
    EXPECT_EQ(found.tires[0].psd_error[c], 0.0);
    EXPECT_EQ(found.tires[0].follows[c].lower, found.bands.front().lower);
    EXPECT_EQ(found.tires[0].follows[c].upper, found.bands.back().upper);
  }
  // A tire twice as stiff has about twice the force over the same cleat: 6 dB more at every
  // frequency.
  EXPECT_NEAR(found.tires[1].time_error[1], 1.0, 0.1);
  EXPECT_NEAR(found.tires[1].level_error[1].front(), 6.0, 1.0);
  EXPECT_LT(found.tires[1].cpu_over_time, 1.0);
}

// The stiff tire has another error over each of the two cleats. The first is called fitted, so the
// mean over tests that were held out is the error over the second.
TEST_F(ComparedTires, ErrorsOfHeldOutTestsAreMeansOverThemAlone) {
  std::string low = kDrum;
  low.replace(low.find("10 mm"), 5, "6 mm");
  write("low.toml", low);
  const std::string again = kSpecimen + "fitted = true\n[test.low]\nfile = \"low.toml\"\n";
  const ComparisonFile read = file(again);
  const TireComparison found = compare_tires(read);
  EXPECT_EQ(held_out_tests(read), 1u);
  const auto of_low = found.tests[1].tires[1];
  ASSERT_EQ(found.tires[1].held_out_psd_error, of_low.psd_error);
  EXPECT_EQ(found.tires[1].held_out_time_error, of_low.time_error);
  EXPECT_NE(found.tires[1].held_out_psd_error, found.tires[1].psd_error);
  const auto says = [](const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
  };
  EXPECT_TRUE(says(verdicts(read, found)[1], "In 1 held-out test Fx is off by"));
  EXPECT_TRUE(says(comparison_page(read, found), "No tire was fitted to 1 of the 2 tests."));

  const ComparisonFile none = file(kSpecimen);
  const TireComparison of_none = compare_tires(none);
  EXPECT_EQ(held_out_tests(none), 0u);
  EXPECT_TRUE(of_none.tires[1].held_out_psd_error.empty());
  EXPECT_FALSE(says(verdicts(none, of_none)[1], "held-out"));
  EXPECT_FALSE(says(comparison_page(none, of_none), "No tire was fitted to"));
}

TEST_F(ComparedTires, BandsBelowTheNoiseAreLeftOut) {
  const ComparisonFile read = file(kSpecimen + "[specimen.noise]\nFz = \"1 MN\"\n");
  const TireComparison found = compare_tires(read);
  EXPECT_EQ(found.tires[0].follows[1].upper, 0.0);
  EXPECT_GT(found.tires[0].follows[0].upper, 0.0);  // Fx has no noise
}

TEST_F(ComparedTires, NoiseIsTheSameOnEveryRun) {
  const ComparisonFile read = file(kSpecimen + "[specimen.noise]\nFz = \"20 N\"\n");
  EXPECT_EQ(measure(*read.specimen, read.tests[0], 0)["Fz"],
            measure(*read.specimen, read.tests[0], 0)["Fz"]);
  EXPECT_NE(measure(*read.specimen, read.tests[0], 0)["Fz"],
            measure(*read.specimen, read.tests[0], 1)["Fz"]);
}

TEST_F(ComparedTires, RecordingsStandInTheSpecimensPlace) {
  std::string table = "time [ms],Fx [N],Fz [kN]\n";
  for (int i = -50; i < 300; ++i)  // the first compared sample is at -29 ms
    table += std::to_string(i) + (i % 2 == 0 ? ",1,3.9\n" : ",1,4\n");
  write("measured.csv", table);
  const std::string test = "channels = [\"Fz\"]\n[test.cleat]\nfile = \"drum.toml\"\n";
  const auto read = file(test + "measurement = \"measured.csv\"\n");
  const TireComparison found = compare_tires(read);
  EXPECT_EQ(found.tests[0].measured[0].force.front(), 4000.0);
  EXPECT_THROW(file(test), InputError);  // neither measurement nor specimen
  write("measured.csv", "time [ms],Fz [kN]\n0,4\n1,4\n");
  const auto cut = file(test + "measurement = \"measured.csv\"\n");
  EXPECT_THROW(compare_tires(cut), InputError);  // the measurement is too short
}

// The file says N and has the numbers of another unit. Without the load of the test in view they
// would be compared as they are: some 4000 % of error and no word.
TEST_F(ComparedTires, ALoadInAnotherUnitThanStatedIsRefused) {
  const std::string test =
      "channels = [\"Fz\"]\n[test.cleat]\nfile = \"drum.toml\"\nmeasurement = \"measured.csv\"\n";
  for (const auto& [newtons, unit] : {std::pair{1e3, "kN"}, {4.4482216, "lbf"}, {10.0, "daN"}}) {
    std::string table = "time [ms],Fz [N]\n";
    for (int i = -50; i < 300; ++i)
      table += fmt::format("{},{:.6g}\n", i, (i % 2 == 0 ? 3900.0 : 4000.0) / newtons);
    write("measured.csv", table);
    try {
      compare_tires(file(test));
      ADD_FAILURE() << unit << " is read as N";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(std::string("is it in ") + unit), std::string::npos)
          << error.what();
    }
  }
}

// A recording is read as in a study: usual names of channels, TYDEX, other axes, frames.
TEST_F(ComparedTires, RecordingsAreReadThroughTheDoorOfAStudy) {
  const auto table = [](const std::string& head, double sign) {
    std::string text = head + "\n";
    for (int i = -50; i < 300; ++i)
      text += std::to_string(i) + "," + std::to_string(sign * (i % 2 == 0 ? 3900 : 4000)) + "\n";
    return text;
  };
  const std::string test = "channels = [\"Fz\"]\n[test.cleat]\nfile = \"drum.toml\"\n";
  const auto first = [&](const std::string& keys) {
    return compare_tires(file(test + keys)).tests[0].measured[0].force.front();
  };
  const std::string plain = "measurement = \"measured.csv\"\n",
                    named = "measurement = \"rig\"\n[measurement.rig]\nfile = \"measured.csv\"\n";
  for (const char* head : {"time [ms],FZC [N]", "RUNTIME [ms],FZ [N]", "Zeit [ms],Radlast [N]"}) {
    write("measured.csv", table(head, 1.0));
    EXPECT_EQ(first(plain), 4000.0) << head;
  }
  write("measured.csv", table("Zeit [ms],Radlast [N]", -1.0));
  EXPECT_EQ(first(named + "axes = \"sae\"\n"), 4000.0);
  write("measured.csv", table("Zeit [ms],Kanal 7 [N]", 1.0));
  EXPECT_EQ(first(named + "columns = {Fz = \"Kanal 7\"}\n"), 4000.0);
  // The test records axes C, in which a moment is about another point than in axes W.
  write("measured.csv", table("time [ms],MxW [N m]", 1.0));
  const std::string moment = "channels = [\"Mx\"]\n[test.cleat]\nfile = \"drum.toml\"\n" + plain;
  try {
    compare_tires(file(moment));
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("measured.csv:1: column \"MxW\" is in axes W"), text.npos) << text;
    EXPECT_NE(text.find("in_frame = \"C\""), text.npos) << text;
  }
}

TEST_F(ComparedTires, RangesThatATireLeavesAreSaidWithTheirTests) {
  const std::string limited = experiment::sparse_tir(std::string("VERTICAL_DAMPING = 200\n") +
                                                     experiment::kLongitudinalForce) +
                              "[VERTICAL_FORCE_RANGE]\nFZMIN = 0\nFZMAX = 3000\n";
  write("limited.tir", limited);
  write("comparison.toml",
        "[specimen]\nkind = \"magic_formula\"\nfile = \"limited.tir\"\n"
        "[test.cleat]\nfile = \"drum.toml\"\n[test.again]\nfile = \"drum.toml\"\n"
        "[tire.same]\nkind = \"magic_formula\"\nfile = \"same.tir\"\n"
        "[tire.limited]\nkind = \"magic_formula\"\nfile = \"limited.tir\"\n");
  const auto read = read_comparison_file(folder_ / "comparison.toml", experiment::language());
  const TireComparison found = compare_tires(read);
  const auto of_load = [](const std::vector<std::string>& limits) {
    std::string all;
    for (const std::string& limit : limits)
      if (limit.find("above FZMAX = 3000 N of the tire's file") != std::string::npos) all += limit;
    return all;
  };
  EXPECT_EQ(of_load(limits_of_tire(read, found, 0)), "");
  const std::string left = of_load(limits_of_tire(read, found, 1));
  EXPECT_NE(left.find("(cleat, again)"), std::string::npos) << left;
  EXPECT_EQ(of_load(found.limits_of_specimen), left);
  const std::string page = comparison_page(read, found);
  EXPECT_NE(page.find("limited: Fz is"), std::string::npos);
  EXPECT_NE(page.find("the specimen: Fz is"), std::string::npos);
}

TEST_F(ComparedTires, ThePageSaysWhatEachTireCanDo) {
  const ComparisonFile read = file(kSpecimen);
  const std::string page = comparison_page(read, compare_tires(read));
  EXPECT_NE(page.find("Fz within 3 dB from"), std::string::npos);
  EXPECT_NE(page.find("Stiff &amp; &lt;odd&gt;"), std::string::npos);
  EXPECT_EQ(page.find("<odd>"), std::string::npos);
}

}  // namespace
}  // namespace latsch::correlation
