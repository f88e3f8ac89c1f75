// SPDX-License-Identifier: Apache-2.0
// Implements `latsch road`: reports height, normal and friction of a road at given points.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/document.h"
#include "base/error.h"
#include "base/file.h"
#include "base/units.h"
#include "cli/console/answers.h"
#include "cli/console/console.h"
#include "cli/console/parsed.h"
#include "cli/verbs/verbs.h"
#include "formats/road/road_file.h"
#include "formats/tables/csv_table.h"
#include "models/road/drum_road.h"
#include "models/road/road_reader.h"

namespace latsch::cli {
namespace {

struct RoadOptions {
  std::string road, points, output, time, triangles;
};

/// The requested points that lie outside of the data of a road.
struct Beyond {
  std::size_t count = 0, without_road = 0;
  std::string first;  // the first such point, and the part of the data that ends before it
};

void warn_of_points_beyond(const Beyond& beyond,
                           std::size_t points,
                           const std::string& road,
                           bool is_grid) {
  if (beyond.count == 0) return;
  std::string sentence =
      fmt::format("warning: {} of {} points lie beyond the data of the road, the first at {}",
                  beyond.count,
                  points,
                  beyond.first);
  if (beyond.without_road > 0)
    sentence += fmt::format(
        "; {} of them have no height, because {}",
        beyond.without_road,
        is_grid ? "a border mode of 0 says that there is no road" : "they are beside the drum");
  if (beyond.without_road < beyond.count)
    sentence += "; beyond its data a road is continued, not measured";
  warn(sentence, {road, 0});
}

/// True if the road is continued at a point beyond its data.
bool is_there(const formats::RoadFile& file, double x, double y) {
  if (const auto* drum = dynamic_cast<const road::DrumRoad*>(file.road.get()))
    return std::abs(x) <= drum->radius();
  return !file.crg || file.crg->elevation(file.crg->locate(x, y));
}

/// True if the ground moves at one of the points.
bool moves(const road::Road& road, const std::vector<double>& x, const std::vector<double>& y) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    const road::GroundPoint ground = road.at(x[i], y[i], 0.0);
    if (!ground.velocity.isZero() || !ground.turning.isZero()) return true;
  }
  return false;
}

/// Returns the road at each point, one row each: height, normal, friction; u and v if the road has
/// them. If the file says that there is no road at a point, its values are gaps.
Channels ask(const formats::RoadFile& file,
             const std::vector<double>& x,
             const std::vector<double>& y,
             const std::vector<double>& time,
             Beyond& beyond) {
  Channels answers;
  answers.add({"x", "m", x});
  answers.add({"y", "m", y});
  std::vector<double> z, nx, ny, nz, friction, u, v;
  for (std::size_t i = 0; i < x.size(); ++i) {
    road::GroundPoint ground = file.road->at(x[i], y[i], time[i]);
    const std::string words = file.road->beyond(x[i], y[i]);
    const bool has_road = words.empty() || is_there(file, x[i], y[i]);
    if (!words.empty() && beyond.count++ == 0)
      beyond.first = fmt::format("x = {:g} m, y = {:g} m: {}", x[i], y[i], words);
    if (!has_road) {
      ++beyond.without_road;
      ground.height = ground.friction = std::nan("");
      ground.normal.setConstant(std::nan(""));
    }
    z.push_back(ground.height + 0.0);  // + 0.0 turns -0 into 0
    nx.push_back(ground.normal.x() + 0.0);
    ny.push_back(ground.normal.y() + 0.0);
    nz.push_back(ground.normal.z());
    friction.push_back(ground.friction);
    if (!file.crg) continue;
    const road::CrgRoad::Position place = file.crg->locate(x[i], y[i]);
    u.push_back(place.u);
    v.push_back(place.v);
  }
  answers.add({"z", "m", std::move(z)});
  answers.add({"nx", "1", std::move(nx)});
  answers.add({"ny", "1", std::move(ny)});
  answers.add({"nz", "1", std::move(nz)});
  answers.add({"friction", "1", std::move(friction)});
  if (file.crg) {
    answers.add({"u", "m", std::move(u)});
    answers.add({"v", "m", std::move(v)});
  }
  return answers;
}

/// Converts a kerb that is described by its shape to a road file of triangles.
void write_triangles(const RoadOptions& options) {
  // m: length of road before the kerb, on which a car runs in at 60 m/s for 0.2 s, and width of
  // ground beside it for the other wheels.
  constexpr double kApproach = 20.0, kBeside = 4.0;
  const Node root = Document::read(options.road).root();
  const auto mesh = road::kerb_triangles(road::read_kerb(root), kApproach, kBeside);
  root.close();
  write_text_file(options.triangles, formats::rdf_text(mesh, "made from " + options.road));
  say_written(options.triangles);
}

int road(const RoadOptions& options) {
  if (!options.triangles.empty()) write_triangles(options);
  if (options.points.empty()) {
    if (options.triangles.empty()) throw InputError("expected POINTS.csv or --triangles FILE.rdf");
    return kDone;
  }
  const formats::RoadFile file = formats::read_road_file(options.road);
  for (const std::string& warning : file.warnings) warn(warning);
  for (const LedgerDoubt& doubt : file.doubts)
    warn("warning: " + doubt.place.text() + ": " + doubt.sentence, doubt.place);
  std::vector<std::string> unused;
  for (const formats::TeimOrbitPart& part : file.unused) unused.push_back(part.name);
  if (!unused.empty())
    warn(fmt::format("not used: {}", fmt::join(unused, ", ")), {options.road, 0});
  // The table on standard output may be piped on, so the header statements of the file are printed
  // only if it goes elsewhere.
  if (!options.output.empty() || answers_in_json())
    for (const std::string& key : file.kept) {
      say("not of the surface: {}\n", key);
      answer()["kept"].push_back(key);
    }
  const auto points = formats::CsvTable::read(options.points);
  points.expect_only({"x", "y", "time"});
  const auto x = points.si_numbers("x", "m"), y = points.si_numbers("y", "m");
  std::vector<double> time(x.size(), 0.0);
  if (points.has("time") && !options.time.empty())
    throw InputError({options.points, 0},
                     "has a column time, beside which --time has no effect; expected one of them");
  if (points.has("time")) {
    time = points.si_numbers("time", "s");
  } else if (!options.time.empty()) {
    time.assign(x.size(), parse_option("--time", options.time, "s", Range{}));
  } else if (moves(*file.road, x, y)) {
    warn(
        "this road moves, and the points have no column time: their time is taken as 0, expected "
        "a column time or --time");
  }
  Beyond beyond;
  const Channels answers = ask(file, x, y, time, beyond);
  give(answers, options.output);
  warn_of_points_beyond(beyond, x.size(), options.road, file.crg != nullptr);
  return kDone;
}

}  // namespace

void add_road(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand("road", "Height, normal and friction of a road at given points");
  verb.footer(
      "ROAD is OpenCRG (.crg), Adams road data (.rdf) or a road in words (.toml):\n"
      "  kind = \"drum\"                     also flat, cleat, kerb, wave\n"
      "  diameter = \"2.5 m\"\n"
      "  speed = \"60 km/h\"\n"
      "  cleats = 1\n"
      "  height = \"20 mm\"\n"
      "  length = \"25 mm\"\n"
      "POINTS.csv has columns x, y and, for a road that moves, time; their units may stand in "
      "brackets, \"x [mm]\",\n"
      "and are SI if none is given.\n\n"
      "Examples:\n"
      "  printf 'kind = \"kerb\"\\nshape = \"saw_tooth\"\\npitch = \"1 m\"\\nwidth = \"0.8 m\"\\n"
      "height = \"25 mm\"\\ncount = 3\\n' > kerb.toml\n"
      "  printf 'x [m],y [m]\\n0.2,0\\n0.5,0\\n' > points.csv\n"
      "  latsch road kerb.toml points.csv > ground.csv\n"
      "  latsch road kerb.toml --triangles kerb.rdf");
  auto options = std::make_shared<RoadOptions>();
  verb.add_option("road", options->road, "Road file").required();
  verb.add_option("points", options->points, "Table of points (CSV)");
  verb.add_option("--time", options->time, "Time of all points, such as \"0.2 s\"");
  verb.add_option("--output", options->output, "CSV file to write; else the terminal")
      .written_as("CSV", {".csv"});
  verb.add_option("--triangles",
                  options->triangles,
                  "Adams road file of nodes and triangles to write, for a kerb")
      .written_as("an Adams road", {".rdf"});
  const bool alone = false;
  verb.forms({{"prints the road at points", {"points"}, {"--time", "--output"}, alone},
              {"writes triangles", {"--triangles"}, {}, alone}});
  verb.callback([=, &program] { program.exit_code = road(*options); });
}

}  // namespace latsch::cli
