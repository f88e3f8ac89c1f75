// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/composed_suspension.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/document_parts.h"
#include "formats/car/bus_file.h"
#include "formats/car/hardpoint_table.h"
#include "models/suspension/bushing_reader.h"

namespace latsch::experiment {
namespace {

void put_hardpoints(const Document& written,
                    const std::filesystem::path& folder,
                    ComposedSuspension& composed) {
  const Node root = written.root();
  if (!root.has("hardpoints")) {
    if (root.has("hardpoints_of"))
      root.reject("hardpoints_of", "belongs to a table of hardpoints, which is missing");
    return;
  }
  if (root.has("hardpoint"))
    root.reject("hardpoints", "is given beside [hardpoint], expected one of them");
  const std::filesystem::path file = folder / root.text("hardpoints");
  std::optional<std::string> of;
  if (root.has("hardpoints_of")) of = root.text("hardpoints_of");
  const auto points = formats::read_hardpoints(file, of);
  std::vector<std::string> lines;
  ComposedSuspension::Added added{
      root.place("hardpoints").line, static_cast<int>(points.size()) - 1, file};
  for (const formats::Hardpoint& point : points) {
    lines.push_back(fmt::format("hardpoint.{} = [\"{}\", \"{}\", \"{}\"]",
                                point.name,
                                point.place[0],
                                point.place[1],
                                point.place[2]));
    added.lines_there.push_back(point.line);
  }
  if (of) composed.document = with_lines(composed.document, "hardpoints_of", {});
  composed.document = with_lines(composed.document, "hardpoints", lines);
  composed.added.push_back(std::move(added));
}

void put_bushings(const Document& written,
                  const std::filesystem::path& folder,
                  ComposedSuspension& composed) {
  if (!written.root().has("bushing")) return;
  for (const Node& bushing : written.root().named_tables("bushing")) {
    if (!bushing.has("file")) continue;
    for (const std::string& key : suspension::keys_in_place_of_a_file())
      if (bushing.has(key)) bushing.reject(key, "is given beside file, expected one of them");
    const formats::BusFile file = formats::read_bus_file(folder / bushing.text("file"));
    const std::vector<std::string> lines = suspension::bushing_lines(file.bushing);
    const std::string path = bushing.path() + ".file";
    const Node now = composed.document.root().table("bushing").table(bushing.name());
    composed.added.push_back({now.place("file").line, static_cast<int>(lines.size()) - 1});
    composed.document = with_lines(composed.document, path, lines);
  }
}

}  // namespace

Place ComposedSuspension::origin(const Place& place) const {
  int line = place.line;
  for (auto one = added.rbegin(); one != added.rend(); ++one) {
    if (!one->lines_there.empty() && line >= one->line && line <= one->line + one->count)
      return {one->file.string(), one->lines_there[static_cast<std::size_t>(line - one->line)]};
    if (line > one->line) line = std::max(one->line, line - one->count);
  }
  return {place.file, line};
}

ComposedSuspension composed_suspension(const Document& written,
                                       const std::filesystem::path& folder) {
  ComposedSuspension composed{written, {}};
  put_hardpoints(written, folder, composed);
  put_bushings(written, folder, composed);
  return composed;
}

}  // namespace latsch::experiment
