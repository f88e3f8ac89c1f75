// SPDX-License-Identifier: Apache-2.0
// Tests MAT files written by other programs: SciPy, and Octave for the HDF5 form if it is
// installed.
#include "formats/tables/mat_file.h"

#include <gtest/gtest.h>
#include <matio.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "base/error.h"
#include "base/file.h"

namespace latsch::formats {
namespace {

class MatFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("mat" + std::to_string(::getpid()));
    std::filesystem::create_directory(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Runs a script with the program. Returns false if the program is not installed.
  bool run(const std::string& program, const std::string& script) {
    std::ofstream(folder_ / "script") << script;
    const std::string command =
        "cd '" + folder_.string() + "' && " + program + " script >/dev/null 2>&1";
    return std::system(command.c_str()) == 0;
  }

  std::filesystem::path folder_;
};

const char* const kScript =
    "import numpy as np, scipy.io as io\n"
    "data = {'t': np.arange(4.0), 'SA': np.array([[1, -2, 3, 4]], dtype=np.int16),\n"
    "        'FZ': np.array([[1.5], [2.5], [3.5], [np.nan]], dtype=np.float32),\n"
    "        'tire': 'Reifen \\u00e4', 'map': np.arange(6.0).reshape(2, 3), 'one': 7.0,\n"
    "        'run': {'Fy': {'data': np.array([1.0, 2.0]), 'unit': 'kN'}},\n"
    "        'z': np.array([1j, 2]), 'c': np.array([np.array([5.0, 6.0]), 'x'], dtype=object)}\n"
    "io.savemat('plain.mat', data, do_compression=False)\n"
    "io.savemat('packed.mat', data, do_compression=True)\n";

const MatVariable* find(const MatFile& file, const std::string& name) {
  for (const MatVariable& variable : file.variables)
    if (variable.name == name) return &variable;
  return nullptr;
}

TEST_F(MatFiles, OfSciPyComeOutAsTheyWentIn) {
  if (!run("/usr/bin/python3", kScript))
    GTEST_SKIP() << "SciPy is not installed (Debian: python3-scipy)";
  for (const char* name : {"plain.mat", "packed.mat"}) {
    const MatFile file = MatFile::read(folder_ / name);
    const Channels channels = file.channels({{"FZ", "kN"}, {"SA", "deg"}, {"t", "ms"}});
    EXPECT_EQ(channels["t"], (std::vector<double>{0.0, 1e-3, 2e-3, 3e-3}));
    EXPECT_EQ(channels["FZ"][1], 2500.0);
    EXPECT_TRUE(std::isnan(channels["FZ"][3]));
    EXPECT_NEAR(channels["SA"][1], -2.0 * std::acos(-1.0) / 180.0, 1e-16);
    EXPECT_EQ(channels["run.Fy"], (std::vector<double>{1000.0, 2000.0}));
    EXPECT_EQ(channels.find("run.Fy")->unit, "N");
    EXPECT_EQ(channels["c{1}"], (std::vector<double>{5.0, 6.0}));
    EXPECT_EQ(find(file, "tire")->text, "Reifen \xc3\xa4");
    // the values of the array are stored column by column
    EXPECT_EQ(find(file, "map")->values, (std::vector<double>{0, 3, 1, 4, 2, 5}));
    EXPECT_EQ(file.left_out, std::vector<std::string>{"z"});
    EXPECT_THROW(file.channels({{"FX", "N"}}), InputError);
    EXPECT_THROW(file.channels({{"FZ", "quux"}}), InputError);
  }
}

TEST_F(MatFiles, OfOctaveInEveryVersion) {
  const char* script =
      "t = (0:4)'; run.Fz = single([1 2 3]); run.name = 'abc'; s(1).a = [1 2]; s(2).a = [3 4];\n"
      "save('-v6', 'v6.mat', 't', 'run', 's'); save('-v7', 'v7.mat', 't', 'run', 's');\n";
  if (!run("octave-cli --no-gui -q", script))
    GTEST_SKIP() << "Octave is not installed (Debian: octave)";
  for (const char* name : {"v6.mat", "v7.mat"}) {
    const Channels channels = MatFile::read(folder_ / name).channels();
    EXPECT_EQ(channels["t"].size(), 5u);
    EXPECT_EQ(channels["run.Fz"], (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(channels["s(2).a"], (std::vector<double>{3, 4}));
  }
}

TEST_F(MatFiles, OfVersion73AreReadThroughHdf5) {
  const auto path = folder_ / "v73.mat";
  mat_t* mat = Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT73);
  ASSERT_TRUE(mat);
  double force[] = {1.0, 2.0, 3.0};
  std::size_t size[] = {3, 1}, one[] = {1, 1};
  const char* fields[] = {"Fz"};
  matvar_t* run = Mat_VarCreateStruct("run", 2, one, fields, 1);
  Mat_VarSetStructFieldByName(
      run, "Fz", 0, Mat_VarCreate("Fz", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, force, 0));
  ASSERT_EQ(Mat_VarWrite(mat, run, MAT_COMPRESSION_NONE), 0);
  Mat_VarFree(run);
  Mat_Close(mat);
  EXPECT_EQ(MatFile::read(path).channels({{"run.Fz", "kN"}})["run.Fz"],
            (std::vector<double>{1000.0, 2000.0, 3000.0}));
}

TEST_F(MatFiles, OfVersion73AreRefusedWhereverTheyAreCutOff) {
  const auto path = folder_ / "v73.mat", cut = folder_ / "cut.mat";
  mat_t* mat = Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT73);
  ASSERT_TRUE(mat);
  std::vector<double> force(500, 1.0);
  std::size_t size[] = {force.size(), 1};
  matvar_t* variable = Mat_VarCreate("Fz", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, force.data(), 0);
  ASSERT_EQ(Mat_VarWrite(mat, variable, MAT_COMPRESSION_NONE), 0);
  Mat_VarFree(variable);
  Mat_Close(mat);
  const std::string bytes = read_text_file(path);
  EXPECT_EQ(MatFile::read(path).variables.size(), 1u);
  for (std::size_t length = 20; length < bytes.size(); length += 61) {
    write_text_file(cut, bytes.substr(0, length));
    EXPECT_THROW(MatFile::read(cut), InputError) << length;
  }
}

TEST_F(MatFiles, CutOffAnywhereAreRefused) {
  if (!run("/usr/bin/python3", kScript))
    GTEST_SKIP() << "SciPy is not installed (Debian: python3-scipy)";
  const std::string bytes = read_text_file(folder_ / "packed.mat");
  const std::size_t whole = MatFile::parse(bytes, "x.mat").variables.size();
  int refused = 0, tried = 0;
  for (std::size_t length = 0; length < bytes.size(); length += 7, ++tried) {
    try {
      // A file that is truncated between two variables is valid and has fewer of them.
      EXPECT_LT(MatFile::parse(bytes.substr(0, length), "x.mat").variables.size(), whole);
    } catch (const InputError& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find("x.mat"), 0u);
    }
  }
  EXPECT_GT(refused, 9 * tried / 10);
  EXPECT_THROW(MatFile::parse("MATLAB 5.0", "x.mat"), InputError);
  EXPECT_THROW(MatFile::parse(std::string(500, 'a'), "x.mat"), InputError);
}

MatFile with_unit(const std::string& name, const std::string& unit) {
  MatFile file;
  file.file = "t.mat";
  file.variables.push_back({"FZ.data", {2, 1}, {1.0, 2.0}, "", false});
  file.variables.push_back({"FZ.unit", {1, 1}, {}, "kN", true});
  file.variables.push_back({name + ".data", {2, 1}, {3.0, 4.0}, "", false});
  file.variables.push_back({name + ".unit", {1, 1}, {}, unit, true});
  return file;
}

// An unknown unit is reported for its vector, and the vectors beside it are read.
TEST(MatUnits, AVectorOfAnUnknownUnitIsLeftOutWithItsReason) {
  const auto named = with_unit("sensor_7", "grC").named_channels();
  EXPECT_EQ(named.channels["FZ"], (std::vector<double>{1000.0, 2000.0}));
  EXPECT_EQ(named.channels.find("sensor_7"), nullptr);
  ASSERT_TRUE(named.left_out.contains("sensor_7"));
  EXPECT_NE(named.left_out.at("sensor_7").find("unknown unit \"grC\""), std::string::npos)
      << named.left_out.at("sensor_7");
}

TEST(MatUnits, AVectorThatIsNeededIsAnError) {
  const auto complaint = [](const auto& read) -> std::string {
    try {
      read();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const MatFile file = with_unit("SA", "grC");
  const auto expected = [](const std::string& name) { return name == "SA" ? "rad" : ""; };
  EXPECT_NE(complaint([&] { file.named_channels({}, expected); }).find("\"SA\" has unknown unit"),
            std::string::npos);
  EXPECT_NE(complaint([&] {
              file.named_channels({{"SA", ""}});
            }).find("\"SA\" has unknown unit"),
            std::string::npos);
}

}  // namespace
}  // namespace latsch::formats
