// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/vtu_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "base/error.h"
#include "models/fe_tire/description/reference_tires.h"

namespace latsch::formats {
namespace {

/// Parses a file with Python's own XML parser and evaluates `claims`, lines of Python about `root`.
/// Returns the exit status.
int python_says(const std::filesystem::path& file, const std::string& claims) {
  // Tests may run in parallel, so each process has a separate script.
  const auto script =
      std::filesystem::path(testing::TempDir()) / ("vtu_check_" + std::to_string(getpid()) + ".py");
  std::ofstream(script)
      << "import sys, math, xml.etree.ElementTree as tree\n"
         "root = tree.parse(sys.argv[1]).getroot()\n"
         "piece = root.find('UnstructuredGrid/Piece')\n"
         "arrays = {a.get('Name'): a for a in root.iter('DataArray')}\n"
         "def values(name): return [float(v) for v in arrays[name].text.split()]\n"
      << claims;
  return std::system(("python3 " + script.string() + " " + file.string()).c_str());
}

TEST(VtuFile, TireIsWellFormedAndCompleteForAnXmlParser) {
  const fe_tire::Mesh mesh = build_mesh(fe_tire::reference_tire_b());
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(3, mesh.nodes_per_sector());
  u.row(2).setConstant(-1e-3);  // m, outward displacement at the bottom of every sector
  const auto file = std::filesystem::path(testing::TempDir()) / "tire.vtu";
  write_tire_vtu(
      file, mesh, {{"displacement <m>", u}, {"n", Eigen::MatrixXd::Ones(1, mesh.nodes())}});
  EXPECT_EQ(python_says(file, R"(
assert piece.get('NumberOfPoints') == '5400' and piece.get('NumberOfCells') == '3480'
x, u = values('points'), values('displacement <m>')
assert len(x) == len(u) == 3 * 5400
for i in range(5400):  # the sectors' vectors turned into the wheel frame: all radial
    r = math.hypot(x[3 * i], x[3 * i + 2])
    assert abs(u[3 * i] - 1e-3 * x[3 * i] / r) < 1e-9
    assert abs(u[3 * i + 2] - 1e-3 * x[3 * i + 2] / r) < 1e-9
connectivity = values('connectivity')
assert len(connectivity) == 8 * 3480 and max(connectivity) == 5399 and min(connectivity) == 0
assert values('offsets')[-1] == 8 * 3480 and set(values('types')) == {12}
assert sum(values('inner')) == 29 * 60 and set(values('region')) == {0, 1, 2}
)"),
            0);
}

TEST(VtuFile, ContactPatchIsVerticesOnTheGround) {
  fe_tire::Standing point;
  point.loaded_radius = 0.295;
  point.patch.points = {{0.01, 0.02, 3e5, 1e4, -2e4, 1e-5, 3e-3, true},
                        {0.03, 0.0, 2e5, 0, 0, 1e-5, 3e-3, false}};
  const auto file = std::filesystem::path(testing::TempDir()) / "patch.vtu";
  write_patch_vtu(file, point);
  EXPECT_EQ(python_says(file, R"(
assert values('points') == [0.01, 0.02, -0.295, 0.03, 0, -0.295]
assert values('pressure [Pa]') == [3e5, 2e5] and values('sticks') == [1, 0]
assert set(values('types')) == {1}
)"),
            0);
}

TEST(VtuFile, ElementsHaveTheFieldsOfTheirSectors) {
  const fe_tire::Mesh mesh = build_mesh(fe_tire::reference_tire_b());
  Eigen::MatrixXd at(2, mesh.element_count());
  for (int k = 0; k < mesh.element_count(); ++k) at.col(k) << k, 0.5;
  const auto file = std::filesystem::path(testing::TempDir()) / "cells.vtu";
  write_tire_vtu(file, mesh, {}, {{"at", at}});
  EXPECT_EQ(python_says(file, R"(
cells = [a.get('Name') for a in root.find('UnstructuredGrid/Piece/CellData')]
assert cells == ['region', 'inner', 'tread', 'at']
assert values('at') == [v for k in range(3480) for v in (k, 0.5)]
)"),
            0);
}

TEST(VtuFile, ChainsAreClosedLines) {
  VtuPoints chains{Eigen::Matrix3Xd::Zero(3, 5), {{"s", Eigen::RowVectorXd::LinSpaced(5, 0, 4)}}};
  chains.loops = {3, 2};
  const auto file = std::filesystem::path(testing::TempDir()) / "chains.vtu";
  write_points_vtu(file, chains);
  EXPECT_EQ(python_says(file, R"(
assert values('connectivity') == [0, 1, 2, 0, 3, 4, 3] and values('offsets') == [4, 7]
assert values('types') == [4, 4] and values('s') == [0, 1, 2, 3, 4]
)"),
            0);
}

TEST(VtuFile, AFileThatCannotBeWrittenIsSaid) {
  EXPECT_THROW(write_patch_vtu("/nonexistent/patch.vtu", {}), InputError);
}

}  // namespace
}  // namespace latsch::formats
