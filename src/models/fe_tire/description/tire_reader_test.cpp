// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/description/section_plan.h"

namespace latsch::fe_tire {
namespace {

const std::filesystem::path kTires = LATSCH_SOURCE_DIR "/studies/tires";

TireDescription read(const std::string& file) {
  return read_tire(Document::read(kTires / file).root());
}

// The meshes in [Hempel & Oertel 2016] have 15,480 and 27,000 unknowns. The shipped meshes have
// rows that end on plies, for which up to half as many unknowns are added.
TEST(TireReader, ShippedTiresHaveUpToOneAndAHalfTimesThePapersFreedoms) {
  EXPECT_LE(build_mesh(read("passenger_225_50R16.toml")).free_dofs(), 3 * 15480 / 2);
  EXPECT_LE(build_mesh(read("passenger_235_45R20.toml")).free_dofs(), 3 * 27000 / 2);
}

TEST(TireReader, RowsMeetOnThePliesNamedAsFaces) {
  const TireDescription tire = read("passenger_225_50R16.toml");
  const SectionPlan plan(tire);
  std::vector<int> ply_of_layer(plan.layers());
  for (int column = 0; column < plan.columns(); ++column) {
    for (const auto& here : plan.plies(column)) ply_of_layer[here.layer] = here.ply;
  }
  int belts = 0;
  for (const Element& element : build_mesh(tire).elements) {
    for (const RebarPlacement& rebar : element.rebars) {
      if (!tire.plies[ply_of_layer[rebar.layer]].name.starts_with("belt")) continue;
      ++belts;
      EXPECT_NEAR(std::abs(rebar.zeta), 1.0, 1e-9);
    }
  }
  EXPECT_GT(belts, 18);
}

TEST(TireReader, WithFacesColumnsEndWherePliesAndRubbersEnd) {
  const Section section = read("passenger_225_50R16.toml").section;
  for (double end : {0.38, 0.46, 0.74, 0.92}) {
    double nearest = 1.0;
    for (int column = 0; column <= section.meridional; ++column) {
      nearest = std::min(nearest, std::abs(section.station(column) - end));
    }
    EXPECT_LT(nearest, 1e-9) << end;
  }
}

TEST(TireReader, EveryShippedTireCanBeRefined) {
  for (const auto& entry : std::filesystem::directory_iterator(kTires)) {
    if (entry.path().extension() != ".toml") continue;
    const TireDescription tire = read(entry.path().filename());
    for (int refinement : {1, 2, 3}) {
      const Mesh mesh = build_mesh(tire, refinement);
      EXPECT_EQ(mesh.sensors.size(), 5u) << entry.path();
      const int layers = static_cast<int>(build_materials(tire).layers.size());
      for (const Element& element : mesh.elements)
        for (const RebarPlacement& rebar : element.rebars) EXPECT_LT(rebar.layer, layers);
    }
  }
}

TEST(TireReader, ComparisonFilesAreTheReferenceTires) {
  const auto expect_same = [](const TireDescription& read, const TireDescription& reference) {
    EXPECT_EQ(read.element, ElementKind::full_integration);
    EXPECT_TRUE(read.section == reference.section);
    const Mesh x = build_mesh(read), y = build_mesh(reference);
    EXPECT_TRUE(x.X == y.X);
    const Materials a = build_materials(read), b = build_materials(reference);
    for (std::size_t e = 0; e < x.elements.size(); ++e) {
      const Solid &s = a.solids[x.elements[e].solid], &t = b.solids[y.elements[e].solid];
      EXPECT_DOUBLE_EQ(s.density, t.density);
      ASSERT_EQ(s.law.index(), t.law.index());
      if (const auto* law = std::get_if<StVenantKirchhoff>(&s.law)) {
        const Matrix6& D = std::get<StVenantKirchhoff>(t.law).D;
        EXPECT_LT((law->D - D).cwiseAbs().maxCoeff(), 1e-12 * D.maxCoeff());
      } else {
        EXPECT_NEAR(std::get<Hyperelastic>(s.law).C10, 1e6, 1e-6);
        EXPECT_NEAR(std::get<Hyperelastic>(s.law).K, 1e8, 1e-3);
      }
    }
  };
  expect_same(read("comparison_225_50R16.toml"), reference_tire_b());
  expect_same(read("comparison_235_45R20.toml"), reference_tire_a());
}

TEST(TireReader, AVariedModulusKeepsTheMeshAndChangesTheMaterials) {
  Document document = Document::read(kTires / "passenger_225_50R16.toml");
  const TireDescription before = read_tire(document.root());
  document.set("layer.belt_1.young_modulus", 80e9);
  document.set("rubber.matrix.young_modulus", 22.3e6);
  const TireDescription after = read_tire(document.root());
  EXPECT_TRUE(same_mesh(before, after));
  EXPECT_EQ(after.plies[1].cords.E_tension, 80e9);
  const Materials materials = build_materials(after);
  const auto& rubber = std::get<Hyperelastic>(materials.solids[0].law);
  EXPECT_NEAR(2.0 * rubber.C10, 22.3e6 / (2.0 * (1.0 + 0.49)), 1.0);
}

/// Returns the message with which a tire is refused whose first rubber has this additional line.
std::string refusal_of(const std::string& line) {
  std::ifstream in(kTires / "passenger_225_50R16.toml");
  std::stringstream text;
  text << in.rdbuf();
  std::string changed = text.str();
  const std::string head = "[rubber.matrix]\n";
  changed.insert(changed.find(head) + head.size(), line + "\n");
  try {
    const TireDescription tire = read_tire(Document::parse(changed, "lossy_tire.toml").root());
    return tire.rubbers[0].prony.empty() ? "elastic" : "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(TireReader, ReadsPronyTermsAndLossFactors) {
  EXPECT_EQ(refusal_of(""), "elastic");
  EXPECT_EQ(refusal_of("loss_factor = 0"), "elastic");
  EXPECT_EQ(refusal_of("loss_factor = 0.15"), "");
  EXPECT_EQ(refusal_of("prony = [[0.2, \"1 ms\"], [0.1, \"20 ms\"]]"), "");
}

TEST(TireReader, RefusesPronyTermsThatNoRubberHas) {
  const struct {
    const char *line, *says;
  } cases[] = {{"prony = [[-0.1, \"1 ms\"]]", "below 0"},
               {"prony = [[0.1, \"0 ms\"]]", "relaxation time"},
               {"prony = [[0.1, \"-1 ms\"]]", "relaxation time"},
               {"prony = [[0.1, \"1 ms\"], [0.2, \"1 ms\"]]", "same relaxation time"},
               {"prony = [[30, \"1 ms\"], [30, \"2 ms\"]]", "sum to 60"},
               {"prony = [[0.1, \"1 N\"]]", "s"},
               {"prony = []", "is empty"},
               {"loss_factor = 1.2", "0 to 1"},
               {"loss_factor = -0.1", "0 to 1"},
               {"loss_factor = 0.1\nprony = [[0.1, \"1 ms\"]]", "beside loss_factor"}};
  for (const auto& one : cases) {
    const std::string said = refusal_of(one.line);
    EXPECT_NE(said.find(one.says), std::string::npos) << one.line << ": " << said;
    EXPECT_NE(said.find("lossy_tire.toml:"), std::string::npos) << said;
  }
}

TEST(TireReader, FrictionIsOptionalAndWithinWhatATireHas) {
  const auto with = [](const std::string& line) {
    std::ifstream in(kTires / "passenger_225_50R16.toml");
    std::stringstream text;
    text << line << in.rdbuf();
    return read_tire(Document::parse(text.str(), "tire.toml").root());
  };
  EXPECT_FALSE(with("").friction);
  EXPECT_EQ(with("friction = 0.9\n").friction->at_rest, 0.9);
  EXPECT_EQ(with("friction = 0.9\n").friction->a, 0.0);
  EXPECT_TRUE(same_mesh(with(""), with("friction = 0.9\n")));
  for (const char* line : {"friction = 0\n",
                           "friction = 6\n",
                           "friction = \"1 N\"\n",
                           "friction = 1\nfriction_exponent = 0.2\n"})
    EXPECT_THROW((void)with(line), InputError) << line;
}

TEST(TireReader, MayBeReducedInTime) {
  const auto with = [](const std::string& table) {
    std::ifstream in(kTires / "passenger_225_50R16.toml");
    std::stringstream text;
    text << in.rdbuf() << table;
    return read_tire(Document::parse(text.str(), "tire.toml").root());
  };
  EXPECT_FALSE(with("").reduced_to);
  EXPECT_EQ(with("[reduced]\nhighest = \"0.2 kHz\"\n").reduced_to, 200.0);
  for (const char* table : {"[reduced]\n",
                            "[reduced]\nhighest = \"20 Hz\"\n",
                            "[reduced]\nhighest = \"1 kHz\"\n",
                            "[reduced]\nhighest = \"1 s\"\n",
                            "[reduced]\nhighest = \"300 Hz\"\nbeyond = 2\n"})
    EXPECT_THROW((void)with(table), InputError) << table;
}

TEST(TireReader, FrictionMayDependOnPressureAndSlidingSpeed) {
  const auto with = [](const std::string& table) {
    std::ifstream in(kTires / "passenger_225_50R16.toml");
    std::stringstream text;
    text << in.rdbuf() << "[friction]\n" << table;
    return read_tire(Document::parse(text.str(), "tire.toml").root());
  };
  const std::string by_pressure = "static = 0.9\npressure = \"2 bar\"\nslope_pressure = 0.2\n";
  EXPECT_NEAR(with(by_pressure).friction->at(4e5, 3.0), 0.9 * std::pow(2.0, -0.2), 1e-12);
  const RollingFriction law =
      *with(by_pressure + "peak = 1.2\npeak_speed = \"2 m/s\"\npeak_width = 1.5\n").friction;
  EXPECT_NEAR(law.at(2e5, 0.0), 0.9, 1e-14);
  EXPECT_NEAR(law.at(2e5, 2.0), 1.2, 1e-14);
  EXPECT_NEAR(law.at(4e5, 2.0), 1.2 * std::pow(2.0, -0.2), 1e-12);
  EXPECT_NEAR(law.at(2e5, 2.0 * std::exp(1.5)), 0.9 + 0.3 * std::exp(-1.0), 1e-12);
  // Every number is a path that a study may vary.
  Document numbers = Document::parse(
      "[friction]\n" + by_pressure + "peak = 1.2\npeak_speed = \"2 m/s\"\npeak_width = 1.5\n",
      "friction.toml");
  EXPECT_EQ(numbers.paths(),
            (std::vector<std::string>{"friction.static",
                                      "friction.pressure",
                                      "friction.slope_pressure",
                                      "friction.peak",
                                      "friction.peak_speed",
                                      "friction.peak_width"}));
  struct Wrong {
    const char* table;
    const char* words;  // part of the message
  };
  for (const Wrong& wrong : {
           Wrong{"peak = 1.2\npeak_speed = \"1 m/s\"\n", "friction.static"},
           Wrong{"static = 0\n", "friction.static is 0, expected 0.01 to 5"},
           Wrong{"static = 0.9\npressure = \"2 bar\"\n", "pressure stands without slope_pressure"},
           Wrong{"static = 0.9\nslope_pressure = 0.2\n", "slope_pressure stands without pressure"},
           Wrong{"static = 0.9\npressure = \"2 bar\"\nslope_pressure = 2\n", "expected 0 to 0.5"},
           Wrong{"static = 0.9\npeak = 1.2\n", "peak stands without peak_speed"},
           Wrong{"static = 0.9\npeak_speed = \"1 m/s\"\n", "peak_speed stands without peak"},
           Wrong{"static = 0.9\npeak_width = 1\n", "peak_width stands without peak"},
           Wrong{"static = 0.9\npeak = 0.8\npeak_speed = \"1 m/s\"\n", "below static = 0.9"},
           Wrong{"static = 0.9\npeak = 1.2\npeak_speed = \"0 m/s\"\n", "peak_speed"},
           Wrong{"static = 0.9\npeak = 1.2\npeak_speed = \"1 m/s\"\npeak_width = 0.1\n",
                 "0.3 to 5"},
           Wrong{"static = 0.9\nslope_presure = 0.2\n", "did you mean \"slope_pressure\""},
       }) {
    try {
      (void)with(wrong.table);
      ADD_FAILURE() << wrong.table;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(wrong.words), std::string::npos) << error.what();
    }
  }
}

// A straight line takes the place of the part that falls faster than is allowed, and joins the law.
TEST(TireReader, FrictionFallsNoFasterThanItIsAllowedTo) {
  const RollingFriction law{.at_rest = 0.8, .peak = 1.6, .peak_speed = 1.0, .width = 0.8};
  double steepest = 0.0;
  for (double w = 1.0; w < 10.0; w += 1e-3) {
    const double slope = (law.at(1e5, w + 1e-6) - law.at(1e5, w - 1e-6)) / 2e-6;
    EXPECT_NEAR(law.speed_slope(1e5, w), slope, 1e-7);
    steepest = std::max(steepest, -slope / law.at_rest);
  }
  EXPECT_NEAR(law.steepest_fall(), steepest, 1e-6);
  EXPECT_EQ(law.no_steeper_than(1.01 * steepest).line_to, 0.0);
  const RollingFriction flat = law.no_steeper_than(0.3 * steepest);
  EXPECT_GT(flat.line_to, flat.line_from);
  double above = 0.0;
  for (double w = 0.01; w < 20.0; w += 1e-3) {
    const double mu = flat.at(1e5, w), next = flat.at(1e5, w + 1e-3);
    EXPECT_GE(next - mu, -0.3001 * steepest * law.at_rest * 1e-3) << w;
    EXPECT_GE(mu, law.at(1e5, w) - 1e-12);
    above = std::max(above, mu - law.at(1e5, w));
    if (w < flat.line_from || w > flat.line_to) {
      EXPECT_EQ(mu, law.at(1e5, w)) << w;
    }
  }
  EXPECT_NEAR(flat.most_above() * law.at_rest, above, 1e-5);
  EXPECT_NEAR(flat.at(1e5, flat.line_to), law.at(1e5, flat.line_to), 1e-9);
}

// A cord that lies on a drum of radius r_0 at the angle a_0 and is lifted to the radius r has the
// angle a with cos a = cos a_0 r / r_0. The number of cords around the tire, 2 pi r sin a /
// spacing, stays constant.
TEST(TireReader, LiftedBiasPliesSteepenTowardTheBead) {
  const TireDescription tire = read("race_16x7.5-10.toml");
  const Contour line(tire.section.contour);
  const CordLayer& crown = tire.plies[0].cords;
  // Material of the first ply in the first column.
  const CordLayer bead = build_materials(tire).layers.front();
  const double middle = 0.5 * (tire.section.station(0) + tire.section.station(1));
  const double lift = line.point(middle).r / line.point(0.0).r;
  EXPECT_NEAR(std::cos(bead.angle), std::cos(crown.angle) * lift, 1e-12);
  EXPECT_NEAR(
      lift * std::sin(bead.angle) * bead.thickness, std::sin(crown.angle) * crown.thickness, 1e-12);
  EXPECT_GT(bead.angle, crown.angle);
}

/// Returns the file of tire B with one line replaced.
std::string edited(const std::string& from, const std::string& to) {
  std::ifstream file(kTires / "passenger_225_50R16.toml");
  std::ostringstream stream;
  stream << file.rdbuf();
  std::string text = stream.str();
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  return text;
}

/// Returns the file of tire B in which the line of [mesh] that begins with `key` is replaced.
std::string with_line(const std::string& key, const std::string& line) {
  std::string text = edited(key, key);
  const auto at = text.find(key);
  return text.replace(at, text.find('\n', at) - at, line);
}

/// An element at position q must occupy a share of the wall proportional to the profile's relative
/// length there.
TEST(TireReader, SpacingGradesTheColumns) {
  std::string with_spacing = with_line(
      "columns = [", "meridional = 2000\nspacing = [[0, 2], [0.4, 2], [0.4001, 1], [1, 3]]");
  // Removes the key, because otherwise ends of columns would move to ends of plies.
  const auto faces = with_spacing.find("faces = [");
  with_spacing.replace(faces, with_spacing.find('\n', faces) - faces, "");
  const Section section = read_tire(Document::parse(with_spacing, "t").root()).section;
  const auto length_at = [&](double q) {
    int column = section.meridional / 2;
    while (section.station(column) < q) ++column;
    return section.station(column + 1) - section.station(column);
  };
  EXPECT_NEAR(length_at(0.2) / length_at(0.5), 2.0 / (1.0 + 2.0 * 0.1 / 0.6), 0.01);
  EXPECT_NEAR(
      length_at(0.9) / length_at(0.5), (1.0 + 2.0 * 0.5 / 0.6) / (1.0 + 2.0 * 0.1 / 0.6), 0.01);
  EXPECT_NEAR(section.station(0), -1.0, 1e-15);
  EXPECT_NEAR(section.station(section.meridional), 1.0, 1e-15);
}

// `split_columns` is the number by which the shipped file splits its columns; [refined] of a study
// can set it.
TEST(TireReader, ColumnsAreSplitInEqualParts) {
  Document document = Document::parse(edited("", ""), "t");
  const Section whole = read_tire(document.root()).section;
  document.set("mesh.split_columns", 3);
  const Section split = read_tire(document.root()).section;
  EXPECT_EQ(split.meridional, 3 * whole.meridional);
  for (int i = 0; i < whole.meridional; ++i) {
    const double from = whole.station(i), to = whole.station(i + 1);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(split.station(3 * i + k), from + (to - from) * k / 3, 1e-12) << i;
  }
}

TEST(TireReader, ColumnsEndWhereTheyAreToldAndRefinedOnesInBetween) {
  const std::string text =
      with_line("columns = [", "columns = [0, 0.2, 0.38, 0.46, 0.6, 0.8, 0.95, 1]");
  const Section section = read_tire(Document::parse(text, "t").root()).section;
  EXPECT_EQ(section.meridional, 14);
  // Rubbers end at the positions 0.74 and 0.92, to which the nearest column ends must move. The
  // ends between them move proportionally: 0.8 moves to 0.74, by 0.3 of a column, and 0.6 by half
  // of that.
  const std::vector<double> expected = {0.0, 0.2, 0.38, 0.46, 0.46 + 0.85 * 0.14, 0.74, 0.92, 1.0};
  for (int i = 0; i <= 7; ++i) {
    EXPECT_NEAR(section.station(7 + i), expected[i], 1e-14) << i;
    EXPECT_NEAR(section.station(7 - i), -expected[i], 1e-14) << i;
  }
  EXPECT_NEAR(section.station(7.5), 0.1, 1e-14);
  EXPECT_NEAR(section.station(8.25), 0.2 + 0.25 * 0.18, 1e-14);
}

TEST(TireReader, AnOffsetMayChangeAlongTheWall) {
  const auto tire = read_tire(
      Document::parse(edited("offset = \"0.6 mm\"", "offsets = [[0.4, \"1 mm\"], [0.5, \"0 mm\"]]"),
                      "t")
          .root());
  const WallProfile& belt = tire.plies[1].offset;
  EXPECT_DOUBLE_EQ(belt.at(0.1), 1e-3);
  EXPECT_DOUBLE_EQ(belt.at(0.45), 0.5e-3);
  EXPECT_DOUBLE_EQ(belt.at(0.9), 0.0);
}

/// Returns the error message for the file of tire B with one line replaced.
std::string complaint(const std::string& from, const std::string& to) {
  const std::string text = edited(from, to);
  try {
    build_mesh(read_tire(Document::parse(text, "tire.toml").root()));
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(TireReader, ComplaintsNameFileLineFoundAndExpected) {
  const auto says = [](const std::string& text, std::initializer_list<const char*> parts) {
    EXPECT_EQ(text.rfind("tire.toml:", 0), 0u) << text;
    for (const char* part : parts)
      EXPECT_NE(text.find(part), std::string::npos) << part << " is not in: " << text;
  };
  says(complaint("[0.52, \"4 mm\"]", "[0.52, \"-4 mm\"]"), {"thickness_inside", "-4 mm"});
  says(complaint("angle = \"24 deg\"", "angle = \"24 N\""), {"layer.belt_1.angle", "24 N"});
  says(complaint("[107, 288], [112, 268], [110, 246]", "[110, 246], [112, 268], [107, 288]"),
       {"section.contour", "crosses itself"});
  says(complaint("offset = \"0.6 mm\"", "offset = \"-7 mm\""),
       {"layer.belt_1.offset", "outside the wall"});
  says(complaint("offset = \"0.6 mm\"", "offsets = [[0.5, \"-2 mm\"], [0.4, \"0 mm\"]]"),
       {"layer.belt_1.offsets", "0.4 after 0.5"});
  says(complaint("[[6, \"2.4 deg\"]", "[[27, \"3 deg\"]"),
       {"mesh.sector_zones", "[27, 3 deg]", "from 1 to 26"});
  says(complaint("[[6, \"2.4 deg\"]", "[[10, \"18 deg\"]"),
       {"mesh.sector_zones", "leaves -8 of 180 deg", "15 other sectors"});
  says(complaint("sectors = 54", "sectors = 61"), {"mesh.sector_zones", "even number", "61"});
  says(complaint("\"belt_1\", \"belt_2\"]", "\"belt_3\"]"), {"mesh.faces", "belt_3"});
  says(complaint("\"belt_1\", \"belt_2\"]", "\"belt_2\", \"belt_1\"]"), {"mesh.faces", "-1.10 mm"});
  says(complaint("columns = [0, ", "columns = [0.01, "), {"mesh.columns", "from 0 (crown)"});
  says(complaint("columns = [0, ", "colums = [0, "), {"mesh.colums", "did you mean \"columns\"?"});
  says(complaint("columns = [0, ", "ends = [0, "), {"mesh.meridional is missing", "or columns"});
  says(complaint(", 0.38, ", ", 0.48, "), {"mesh.columns", "ascending"});
  says(complaint("rows_inside =", "meridional = 30\nrows_inside ="),
       {"mesh.meridional", "is given beside columns"});
  const auto spaced = [](const std::string& rows) {
    return "meridional = 30\nspacing = " + rows + "\n# ";
  };
  says(complaint("columns = [", spaced("[[0, 1], [0.2, 0], [1, 1]]")),
       {"mesh.spacing", "[0.2, 0]"});
  says(complaint("columns = [", spaced("[[0, 1], [0.2, 1]]")), {"mesh.spacing", "1 (bead)"});
  says(complaint("225/50R16\"", "225-50-16\""), {"size", "225-50-16", "225/50R16"});
  says(complaint("225/50R16\"", "225/50R17\""), {"section.contour", "656"});
  says(complaint("rubber = \"matrix\"", "rubber = \"matrx\""), {"matrx", "matrix"});
  says(complaint("pressure =", "presure ="), {"pressure"});
  says(complaint("spacing = \"", "spacin = \""), {"spacing"});
  says(complaint("from = 0.74", "from = 0.85"), {"no rubber region covers position"});
  says(complaint("from = 0.74", "from = 0.60"), {"overlap"});
  says(complaint("poisson_ratio = 0.49", "poisson_ratio = 0.5"), {"poisson_ratio", "0.5"});
  says(complaint("columns = [", "meridional = 2\n# "), {"mesh.meridional", "2"});
  says(complaint("[1.0, \"7 mm\"]", "[1.0, \"150 mm\"]"), {"section.contour", "crosses itself"});
}

}  // namespace
}  // namespace latsch::fe_tire
