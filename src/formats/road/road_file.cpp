// SPDX-License-Identifier: Apache-2.0
#include "formats/road/road_file.h"

#include <fmt/format.h>

#include "base/document.h"
#include "base/text.h"
#include "formats/road/open_crg.h"
#include "formats/road/open_crg_references.h"
#include "models/road/road_reader.h"

namespace latsch::formats {
namespace {

RoadFile read_crg(const std::filesystem::path& file) {
  OpenCrg crg = OpenCrg::read(file);
  RoadFile result;
  result.kind = "OpenCRG";
  result.warnings = crg.warnings;
  const road::CrgGrid& grid = crg.grid;
  result.facts.push_back(fmt::format("format {}, {} rows, {} long sections, {} heights missing",
                                     crg.format,
                                     grid.rows(),
                                     grid.v.size(),
                                     crg.gaps));
  result.facts.push_back(fmt::format("u {} m to {} m every {} m, v {} m to {} m",
                                     format_number(grid.u_begin, 6),
                                     format_number(grid.u_end(), 6),
                                     format_number(grid.u_increment, 6),
                                     format_number(grid.v.front(), 6),
                                     format_number(grid.v.back(), 6)));
  for (const std::string& statement : crg.statements) result.facts.push_back(statement);
  result.kept = std::move(crg.kept);
  auto surface = std::make_unique<road::CrgRoad>(std::move(crg.grid));
  result.crg = surface.get();
  result.road = std::move(surface);
  return result;
}

std::string ending_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

}  // namespace

std::vector<std::filesystem::path> files_of_road(const std::filesystem::path& file) {
  std::vector<std::filesystem::path> files;
  for (const RoadReference& reference : references_of_road(file)) files.push_back(reference.file);
  return files;
}

std::vector<RoadReference> references_of_road(const std::filesystem::path& file) {
  if (ending_of(file) != ".crg") return {{file, {}}};
  const ResolvedCrg resolved = resolve_open_crg(file);
  std::vector<RoadReference> references;
  for (std::size_t i = 0; i < resolved.files.size(); ++i)
    references.push_back({resolved.files[i], resolved.named_in[i]});
  return references;
}

RoadFile read_road_file(const std::filesystem::path& file) {
  const std::string ending = ending_of(file);
  if (ending == ".crg") return read_crg(file);
  if (ending == ".rdf") {
    const TeimOrbit data = TeimOrbit::read(file);
    if (!data.find("MODEL"))
      throw InputError({file.string(), 0},
                       "there is no section [MODEL]: is this an Adams road file, and all of it?");
    return read_rdf(data);
  }
  if (ending == ".toml") {
    const Node root = Document::read(file).root();
    RoadFile result;
    result.road = road::read_road(root);
    result.kind = root.text("kind");
    return result;
  }
  throw InputError(
      {file.string(), 0},
      "ends in " + in_quotes(ending) + R"(, expected a road in ".crg", ".rdf" or ".toml")");
}

std::string rdf_text(const road::TriangleMesh& mesh, std::string_view comment) {
  std::string text = fmt::format(
      "[MDI_HEADER]\n FILE_TYPE = 'rdf'\n FILE_VERSION = 5.00\n FILE_FORMAT = 'ASCII'\n"
      "(COMMENTS)\n{{comment_string}}\n '{}'\n"
      "[UNITS]\n LENGTH = 'meter'\n FORCE = 'newton'\n ANGLE = 'radian'\n MASS = 'kg'\n"
      " TIME = 'sec'\n[MODEL]\n METHOD = '3D'\n[OFFSET]\n X = 0.0\n Y = 0.0\n Z = 0.0\n"
      "[NODES]\n NUMBER_OF_NODES = {}\n{{ node x_value y_value z_value }}\n",
      comment,
      mesh.nodes.size());
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const Eigen::Vector3d& node = mesh.nodes[i];
    text += fmt::format(" {} {} {} {}\n", i + 1, node.x(), node.y(), node.z());
  }
  text += fmt::format("[ELEMENTS]\n NUMBER_OF_ELEMENTS = {}\n{{ node_1 node_2 node_3 mu }}\n",
                      mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    const auto& n = triangle.nodes;
    text += fmt::format(" {} {} {} {}\n", n[0] + 1, n[1] + 1, n[2] + 1, triangle.friction);
  }
  return text;
}

}  // namespace latsch::formats
