// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/measurement_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>

#include "base/error.h"
#include "base/file.h"
#include "base/random.h"

namespace latsch::formats {
namespace {

class MeasurementFile : public testing::Test {
 protected:
  MeasurementFile()
      : folder_(testing::TempDir() + "latsch_measurement_file_test_" + std::to_string(getpid())) {
    std::filesystem::create_directories(folder_);
  }
  ~MeasurementFile() override { std::filesystem::remove_all(folder_); }

  /// Returns the error message for a file with this text, without the folder's name.
  std::string complaint(const std::string& name,
                        const std::string& text,
                        const std::function<void(const std::filesystem::path&)>& read) {
    const auto file = folder_ / name;
    write_text_file(file, text);
    try {
      read(file);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(folder_.string().size() + 1);
    }
    return "";
  }

  std::filesystem::path folder_;
};

TEST_F(MeasurementFile, CurvesComeBackBitForBit) {
  RandomStream random(1, 1);
  for (const Abscissa abscissa : {Abscissa::deflection, Abscissa::loaded_radius}) {
    LoadDeflectionCurve curve{abscissa, {}, {}, {}};
    for (int i = 0; i < 50; ++i) {
      curve.position.push_back(0.001 * (i + 1) + 0.0009 * random.uniform());
      curve.force.push_back(1e4 * random.uniform());
      curve.spread.push_back(10 * random.uniform());
    }
    write_load_deflection(folder_ / "curve.csv", curve, "from a test");
    EXPECT_EQ(read_load_deflection(folder_ / "curve.csv"), curve);
    EXPECT_EQ(read_text_file(folder_ / "curve.csv").find("# from a test\n"), 0u);
  }
}

TEST_F(MeasurementFile, ModesAndShapesComeBackBitForBit) {
  RandomStream random(1, 2);
  ModeTable table;
  for (int p = 0; p < 7; ++p)
    table.points.push_back({random.normal(), random.normal(), random.normal()});
  for (const char* type : {"torsional", "lateral", "radial", ""}) {
    MeasuredMode mode{40.0 + 100.0 * random.uniform(), {}, type, ' ', {}};
    if (*type == 'l') mode.n = 1, mode.phase = 's';
    for (int i = 0; i < 21; ++i) mode.shape.push_back(random.normal());
    table.modes.push_back(mode);
  }
  write_shapes(folder_ / "shapes.csv", table, "");
  for (const char* name : {"modes.csv", "modes.toml"}) {
    write_modes(folder_ / name, table, "from a test");
    ModeTable again = read_modes(folder_ / name);
    read_shapes(folder_ / "shapes.csv", again);
    EXPECT_EQ(again, table) << name;
  }
}

TEST_F(MeasurementFile, FaultsOfCurvesNameTheirLine) {
  const auto read = [](const auto& file) { read_load_deflection(file); };
  EXPECT_EQ(complaint("c.csv", "deflection [mm],force [N]\n", read),
            "c.csv: holds no point, expected at least one");
  EXPECT_EQ(complaint("c.csv", "deflection [mm],force [N]\n5,nan\n", read),
            "c.csv:2: force is \"nan\", expected a finite number");
  EXPECT_EQ(complaint("c.csv", "deflection [mm],force [N]\n5,8\n# x\n5,9\n", read),
            "c.csv:4: deflection is 0.005 m after 0.005 m, expected values that all rise or all "
            "fall; sweep = {deflection = \"rising\"} in a [measurement.NAME] of the file keeps the "
            "others");
  EXPECT_EQ(complaint("c.csv", "deflection [mm],forse [N]\n5,8\n", read),
            "c.csv:1: unknown column \"forse\", did you mean \"force\"?");
  EXPECT_EQ(complaint("c.csv", "force [N]\n5\n", read),
            "c.csv:1: column \"deflection\" is missing (columns: \"force\")");
  EXPECT_EQ(complaint("c.csv", "deflection [mm],loaded_radius [mm],force [N]\n5,6,8\n", read),
            "c.csv:1: has both deflection and loaded_radius, expected one of them");
}

TEST_F(MeasurementFile, FaultsOfModesNameTheirLine) {
  const auto read = [](const auto& file) { read_modes(file); };
  EXPECT_EQ(complaint("m.csv", "frequency [Hz],type\n40,latral\n", read),
            "m.csv:2: type is \"latral\", expected \"torsional\", \"lateral\" or \"radial\" or "
            "nothing, did you mean \"lateral\"?");
  EXPECT_EQ(
      complaint("m.csv", "frequency [Hz],n\n40,\n50,-1\n", read),
      "m.csv:3: n is \"-1\", expected a number of waves around the tire, 0 to 40, or nothing");
  EXPECT_EQ(
      complaint("m.csv", "frequency [Hz],n\n40,\n50,99\n", read),
      "m.csv:3: n is \"99\", expected a number of waves around the tire, 0 to 40, or nothing");
  EXPECT_EQ(
      complaint("m.csv", "frequency [rpm]\n40\n", read),
      "m.csv:1: column \"frequency\" is in \"rpm\", expected a frequency, such as \"frequency "
      "[Hz]\"");
  EXPECT_EQ(complaint("m.csv", "frequency [Hz]\n-40\n", read),
            "m.csv:2: frequency is -40 Hz, expected more than 0 Hz");
  EXPECT_EQ(complaint("m.toml", "[[mode]]\nfrequency = 40\n", read),
            "m.toml:2: mode.0.frequency is 40, expected a frequency with its unit, such as \"80 "
            "Hz\"");
  EXPECT_EQ(complaint("m.toml", "\n", read), "m.toml:1: holds no mode, expected at least one");
}

TEST_F(MeasurementFile, FaultsOfShapesNameTheirLine) {
  const auto read = [](const auto& file) {
    ModeTable table{{{40.0, {}, "", ' ', {}}, {50.0, {}, "", ' ', {}}}, {}};
    read_shapes(file, table);
  };
  const std::string header = "mode,x [mm],y [mm],z [mm],ux,uy,uz\n";
  EXPECT_EQ(complaint("s.csv", header + "1,0,0,1,1,0,0\n2,0,0,1,1,0,0\n", read), "");
  EXPECT_EQ(complaint("s.csv", header + "1,0,0,1,1,0,0\n", read),
            "s.csv: has 1 rows for 2 modes, expected the same points for each");
  EXPECT_EQ(complaint("s.csv", header + "1,0,0,1,1,0,0\n3,0,0,1,1,0,0\n", read),
            "s.csv:3: mode is 3, expected 2: 1 points a mode");
  EXPECT_EQ(complaint("s.csv", header + "1,0,0,1,1,0,0\n2,0,0,2,1,0,0\n", read),
            "s.csv:3: x, y, z are not those of point 1 of mode 1");
  EXPECT_EQ(complaint("s.csv", header + "1,0,0,1,1,0,0\n2,0,0,1,0,0,0\n", read),
            "s.csv:3: shape is zero everywhere");
}

TEST_F(MeasurementFile, ModesAreKnownByOtherNames) {
  write_text_file(folder_ / "a.csv", "Frequency [Hz],Order,Typ\n54,0,torsional\n70,1,radial\n");
  write_text_file(folder_ / "b.csv", "f [Hz],n,type\n54,0,torsional\n70,1,radial\n");
  EXPECT_EQ(read_modes(folder_ / "a.csv"), read_modes(folder_ / "b.csv"));
  const auto read = [](const std::filesystem::path& file) { read_modes(file); };
  const std::string said = complaint("c.csv", "omega [rad/s],n\n260,0\n", read);
  EXPECT_NE(said.find("unknown column \"omega\""), said.npos) << said;
  EXPECT_NE(said.find("frequency, n (the number of waves), type and phase"), said.npos) << said;
  EXPECT_NE(complaint("d.csv", "f [Hz],frequency [Hz]\n54,54\n", read).find("unknown column"),
            std::string::npos);
}

TEST_F(MeasurementFile, RowsThatAreNoPointsOfACurveHaveAWayOut) {
  const auto read = [](const std::filesystem::path& file) { read_load_deflection(file); };
  const std::string zero = complaint("z.csv", "deflection [mm],force [N]\n0,0\n5,900\n", read);
  EXPECT_NE(zero.find("select = {deflection = \"2.5 mm ..\"}"), zero.npos) << zero;
  const std::string loop =
      complaint("l.csv", "deflection [mm],force [N]\n5,900\n9,1700\n5,850\n", read);
  EXPECT_NE(loop.find("sweep = {deflection = \"rising\"}"), loop.npos) << loop;
}

}  // namespace
}  // namespace latsch::formats
