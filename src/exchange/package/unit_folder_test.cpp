// SPDX-License-Identifier: Apache-2.0
#include "exchange/package/unit_folder.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "base/scratch_folder_testing.h"

namespace latsch::exchange {
namespace {

namespace fs = std::filesystem;

const fs::path kTire =
    fs::path(LATSCH_SOURCE_DIR) / "studies/tire_model_comparison/magic_formula.tir";

// An OpenCRG grid of two cross sections with two heights each. The heights are 0.1 m at the start;
// the road is level in the lateral direction.
constexpr const char* kSurface =
    "$ROAD_CRG\nreference_line_increment = 1\n$\n$KD_DEFINITION\n#:LRFI\n"
    "D:long section at v = -1,m\nD:long section at v = 1,m\n$\n$$$$\n"
    " 0.1000000 0.1000000\n 0.2000000 0.2000000\n";

UnitFiles files_on(const fs::path& road) {
  const auto& kind = experiment::language().kind_of_file(kTire);
  return unit_files(kind, kind.read(kTire), road);
}

void write_all(const UnitFiles& files, const fs::path& folder) {
  for (const auto& [name, bytes] : files) {
    fs::create_directories((folder / name).parent_path());
    write_text_file(folder / name, bytes);
  }
}

double start_of(const ExchangedModel& unit, const std::string& name) {
  for (const ExchangedVariable& variable : unit.variables())
    if (variable.name == name) return variable.start;
  ADD_FAILURE() << name;
  return 0.0;
}

TEST(UnitFolder, ARoadTravelsWithTheFileItIncludes) {
  const ScratchFolder folder;
  fs::create_directory(folder / "data");
  write_text_file(folder / "data/surface.crg", kSurface);
  write_text_file(folder / "road.crg", "$ROAD_CRG_FILE\n data/surface.crg\n$\n");
  const UnitFiles files = files_on(folder / "road.crg");
  write_all(files, folder / "sent");
  fs::remove_all(folder / "data");
  const UnitFromFolder sent = read_unit(folder / "sent", SpecimenModels(experiment::language()));
  EXPECT_EQ(sent.token, token_of(files));
  const UnitFromFolder flat = [&] {
    write_all(files_on({}), folder / "flat");
    return read_unit(folder / "flat", SpecimenModels(experiment::language()));
  }();
  EXPECT_NE(flat.token, sent.token);
  EXPECT_NEAR(start_of(*sent.unit, "wheel.z") - start_of(*flat.unit, "wheel.z"), 0.1, 1e-12);
}

TEST(UnitFolder, RefusesARoadThatIncludesAFileFromElsewhere) {
  const ScratchFolder folder;
  fs::create_directory(folder / "below");
  write_text_file(folder / "surface.crg", kSurface);
  write_text_file(folder / "below/road.crg", "$ROAD_CRG_FILE\n ../surface.crg\n$\n");
  try {
    files_on(folder / "below/road.crg");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("road.crg:2: refers to"), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("../surface.crg"), std::string::npos) << error.what();
  }
}

TEST(UnitFolder, TheTokenIsAnotherWhereANumberOfAFileIs) {
  const ScratchFolder folder;
  const auto token = [&](const std::string& text) {
    write_text_file(folder / "road.toml", text);
    return token_of(files_on(folder / "road.toml"));
  };
  EXPECT_EQ(token("kind = \"flat\"\n"), token("kind = \"flat\"\n"));
  EXPECT_NE(token("kind = \"flat\"\n"), token("kind = \"flat\"\nfriction = 0.9\n"));
  const std::string cleat = "kind = \"cleat\"\nlength = \"25 mm\"\nheight = ";
  EXPECT_NE(token(cleat + "\"10 mm\"\n"), token(cleat + "\"10.000001 mm\"\n"));
  // a package holds the road in SI, without blanks and comments
  EXPECT_EQ(token(cleat + "\"10 mm\"\n"), token(cleat + "\"1 cm\"  # low\n"));
}

TEST(UnitFolder, ASlimLibraryReadsTheUnitThatTheProgramWrote) {
  const ScratchFolder folder;
  write_all(files_on({}), folder / "sent");
  const UnitFromFolder slim = read_unit(folder / "sent", SlimModels());
  const UnitFromFolder all = read_unit(folder / "sent", SpecimenModels(experiment::language()));
  EXPECT_EQ(slim.token, all.token);
  for (std::size_t i = 0; i < slim.unit->variables().size(); ++i)
    EXPECT_EQ(slim.unit->variables()[i].start, all.unit->variables()[i].start);
}

TEST(UnitFolder, TheProgramReadsAUnitOfFormatOneAndASlimLibraryRefusesIt) {
  const ScratchFolder folder;
  write_text_file(folder / "model.tir", read_text_file(kTire));
  write_text_file(folder / "road.toml", "kind = \"flat\"\n");
  const auto write_unit = [&](const std::string& format) {
    write_text_file(folder / "unit.toml",
                    "kind = \"tire\"\n" + format + "token = \"{1}\"\n[tire]\n" +
                        "model_kind = \"magic_formula\"\nmodel = \"model.tir\"\n" +
                        "road = \"road.toml\"\n");
  };
  const auto refusal = [&](const UnitModels& models) {
    try {
      read_unit(folder.path(), models);
      return std::string();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  write_unit("");
  EXPECT_EQ(refusal(SpecimenModels(experiment::language())), "");
  EXPECT_NE(refusal(SlimModels()).find("format 1"), std::string::npos) << refusal(SlimModels());
  write_unit("format = 3\n");
  EXPECT_NE(refusal(SlimModels()).find("older than the package"), std::string::npos);
}

TEST(UnitFolder, SaysWhatIsWrongInAFolder) {
  const ScratchFolder folder;
  const auto complaint = [&](const std::string& unit) {
    write_text_file(folder / "unit.toml", unit);
    try {
      read_unit(folder.path(), SpecimenModels(experiment::language()));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  const std::string head = "kind = \"tire\"\ntoken = \"{1}\"\n[tire]\nmodel_kind = ";
  EXPECT_NE(complaint("kind = \"boat\"\n").find("boat"), std::string::npos);
  EXPECT_NE(complaint(head + "\"suspension\"\nmodel = \"m\"\nroad = \"r\"\n").find("suspension"),
            std::string::npos);
  EXPECT_NE(
      complaint(head + "\"ring_tire\"\nmodel = \"m.toml\"\nroad = \"r.toml\"\n").find("m.toml"),
      std::string::npos);
}

}  // namespace
}  // namespace latsch::exchange
