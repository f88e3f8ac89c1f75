// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/vtu_file.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cassert>
#include <functional>

#include "base/error.h"
#include "base/file.h"

namespace latsch::formats {
namespace {

using fe_tire::Corners;
using fe_tire::Mesh;

constexpr int kHexahedron = 12, kVertex = 1, kPolyLine = 4;  // VTK's cell types

std::string escaped(const std::string& text) {
  std::string result;
  for (char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

/// One VTK file: points, cells, then data of points and cells.
class VtuWriter {
 public:
  VtuWriter(std::ostream& out, long points, long cells, const std::string& comment)
      : out_(out), cells_(cells) {
    fmt::print(out_,
               "<?xml version=\"1.0\"?>\n{}<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
               "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
               "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
               comment,
               points,
               cells);
  }

  void open(const char* tag) { fmt::print(out_, "<{}>\n", tag); }
  void close(const char* tag) { fmt::print(out_, "</{}>\n", tag); }

  void numbers(const std::string& name, const Eigen::MatrixXd& values) {
    fmt::print(
        out_,
        "<DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n",
        escaped(name),
        values.rows());
    for (Eigen::Index j = 0; j < values.cols(); ++j)
      for (Eigen::Index i = 0; i < values.rows(); ++i)
        fmt::print(out_, "{:.9g}{}", values(i, j), i + 1 == values.rows() ? '\n' : ' ');
    close("DataArray");
  }

  void integers(const std::string& name,
                const std::function<void(long, fmt::memory_buffer&)>& cell) {
    fmt::print(out_, "<DataArray type=\"Int32\" Name=\"{}\" format=\"ascii\">\n", name);
    fmt::memory_buffer line;
    for (long i = 0; i < cells_; ++i) {
      line.clear();
      cell(i, line);
      fmt::print(out_, "{}\n", std::string_view(line.data(), line.size()));
    }
    close("DataArray");
  }
  void integers(const std::string& name, const std::function<long(long)>& cell) {
    integers(name, [&](long i, fmt::memory_buffer& line) {
      fmt::format_to(std::back_inserter(line), "{}", cell(i));
    });
  }

  void finish() {
    close("Piece");
    close("UnstructuredGrid");
    close("VTKFile");
  }

 private:
  std::ostream& out_;
  long cells_;
};

/// Returns the values of all nodes, followed by those of all corners between two nodes. Vectors
/// (three components) are rotated into the wheel frame.
Eigen::MatrixXd on_ring(const Mesh& mesh, const Corners& corners, const Eigen::MatrixXd& values) {
  const int n = mesh.nodes_per_sector();
  assert(values.cols() == n || values.cols() == mesh.nodes());
  const auto tied = static_cast<Eigen::Index>(corners.tied.size());
  Eigen::MatrixXd result(values.rows(), mesh.nodes() + mesh.sectors * tied);
  for (int s = 0; s < mesh.sectors; ++s) {
    const auto own = values.middleCols(values.cols() == n ? 0 : s * n, n);
    if (values.rows() == 3)
      result.middleCols(s * n, n) = mesh.frame(s) * own;
    else
      result.middleCols(s * n, n) = own;
    for (Eigen::Index i = 0; i < tied; ++i) {
      const Corners::Tied& at = corners.tied[i];
      result.col(mesh.nodes() + s * tied + i) =
          (1.0 - at.at) * result.col(s * n + at.lower) + at.at * result.col(s * n + at.upper);
    }
  }
  return result;
}

/// Returns a comment that names the regions. XML forbids "--" in a comment.
std::string region_comment(const Mesh& mesh) {
  std::string text = "<!-- region:";
  for (std::size_t i = 0; i < mesh.region_names.size(); ++i)
    text += fmt::format(" {} = {};", i, mesh.region_names[i]);
  for (auto at = text.find("--", 4); at != std::string::npos; at = text.find("--", at))
    text.erase(at, 1);
  return text + " -->\n";
}

}  // namespace

void write_tire_vtu(std::ostream& out,
                    const Mesh& mesh,
                    const std::vector<VtuField>& fields,
                    const std::vector<VtuField>& cells) {
  const int n = mesh.nodes_per_sector(), per_sector = static_cast<int>(mesh.elements.size());
  const Corners corners = corners_of(mesh);
  const int tied = static_cast<int>(corners.tied.size());
  VtuWriter file(
      out, mesh.nodes() + mesh.sectors * tied, mesh.element_count(), region_comment(mesh));
  const auto element = [&](long i) -> const fe_tire::Element& {
    return mesh.elements[i % per_sector];
  };

  file.open("Points");
  file.numbers("points", on_ring(mesh, corners, mesh.X));
  file.close("Points");

  file.open("Cells");
  file.integers("connectivity", [&](long i, fmt::memory_buffer& line) {
    const long sector = i / per_sector;
    for (int corner : corners.of_element[i % per_sector]) {
      const long plane = (sector + corner / (n + tied)) % mesh.sectors, own = corner % (n + tied);
      fmt::format_to(std::back_inserter(line),
                     "{} ",
                     own < n ? plane * n + own : mesh.nodes() + plane * tied + own - n);
    }
  });
  file.integers("offsets", [](long i) { return 8 * (i + 1); });
  file.integers("types", [](long) { return kHexahedron; });
  file.close("Cells");

  file.open("PointData");
  for (const VtuField& field : fields)
    file.numbers(field.name, on_ring(mesh, corners, field.values));
  file.close("PointData");

  file.open("CellData");
  file.integers("region", [&](long i) { return element(i).region; });
  file.integers("inner", [&](long i) { return element(i).inner; });
  file.integers("tread", [&](long i) { return element(i).tread; });
  for (const VtuField& field : cells) {
    assert(field.values.cols() == mesh.element_count());
    file.numbers(field.name, field.values);
  }
  file.close("CellData");
  file.finish();
}

void write_patch_vtu(std::ostream& out, const fe_tire::Standing& standing) {
  const auto& points = standing.patch.points;
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd x(3, count), pressure(1, count), shear(3, count), area(1, count),
      sticks(1, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    x.col(i) << points[i].x, points[i].y, -standing.loaded_radius;
    pressure(0, i) = points[i].pressure;
    shear.col(i) << points[i].shear_x, points[i].shear_y, 0.0;
    area(0, i) = points[i].area;
    sticks(0, i) = points[i].sticks;
  }
  write_points_vtu(out,
                   {x,
                    {{"pressure [Pa]", pressure},
                     {"shear [Pa]", shear},
                     {"area [m^2]", area},
                     {"sticks", sticks}}});
}

void write_points_vtu(std::ostream& out, const VtuPoints& points) {
  const bool are_lines = !points.loops.empty();
  const long cells = are_lines ? std::ssize(points.loops) : points.x.cols();
  std::vector<long> ends;  // first point after each loop
  for (const long count : points.loops) ends.push_back((ends.empty() ? 0 : ends.back()) + count);
  VtuWriter file(out, points.x.cols(), cells, "");
  file.open("Points");
  file.numbers("points", points.x);
  file.close("Points");
  file.open("Cells");
  if (are_lines) {
    file.integers("connectivity", [&](long i, fmt::memory_buffer& line) {
      const long first = ends[i] - points.loops[i];
      for (long k = first; k < ends[i]; ++k) fmt::format_to(std::back_inserter(line), "{} ", k);
      fmt::format_to(std::back_inserter(line), "{}", first);
    });
    file.integers("offsets", [&](long i) { return ends[i] + i + 1; });
  } else {
    file.integers("connectivity", [](long i) { return i; });
    file.integers("offsets", [](long i) { return i + 1; });
  }
  file.integers("types", [&](long) { return are_lines ? kPolyLine : kVertex; });
  file.close("Cells");
  file.open("PointData");
  for (const VtuField& field : points.fields) file.numbers(field.name, field.values);
  file.close("PointData");
  file.finish();
}

void write_tire_vtu(const std::filesystem::path& file,
                    const Mesh& mesh,
                    const std::vector<VtuField>& fields,
                    const std::vector<VtuField>& cells) {
  write_file(file, [&](std::ostream& out) { write_tire_vtu(out, mesh, fields, cells); });
}

void write_points_vtu(const std::filesystem::path& file, const VtuPoints& points) {
  write_file(file, [&](std::ostream& out) { write_points_vtu(out, points); });
}

void write_patch_vtu(const std::filesystem::path& file, const fe_tire::Standing& standing) {
  write_file(file, [&](std::ostream& out) { write_patch_vtu(out, standing); });
}

}  // namespace latsch::formats
