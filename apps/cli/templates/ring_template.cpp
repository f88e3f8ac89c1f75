// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/ring_template.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/text.h"
#include "base/units.h"
#include "experiment/rigs/mode_record.h"
#include "models/ring_tire/description/ring_reader.h"

namespace latsch::cli {
namespace {

constexpr std::string_view kTests =
    R"(test.pressed = {kind = "load_deflection", deflections = ["10 mm", "18 mm", "26 mm"]}
test.air = {kind = "modes", count = 30}
)";

const std::vector<std::string> kMotions = {
    "torsional n=0", "radial n=1", "lateral n=0", "lateral n=1", "radial n=2", "lateral n=2"};
const std::vector<std::string> kDamped = {"torsional n=0", "radial n=1", "lateral n=1"};

struct RingNumber {
  const char *name, *path, *unit;
  double range;  // of its first guess, either way
};
const std::vector<RingNumber> kNumbers = {
    {"mass", "belt.mass", "kg", 3.0},
    {"radial", "sidewall.radial.stiffness", "MN/m^2", 4.0},
    {"tangential", "sidewall.tangential.stiffness", "MN/m^2", 4.0},
    {"lateral", "sidewall.lateral.stiffness", "MN/m^2", 5.0},
    {"torsion", "sidewall.torsion", "kN/rad", 10.0},
    {"progressivity", "sidewall.progressivity", "1", 20.0},
    {"pressure_width", "belt.pressure_width", "mm", 3.0},
    {"in_plane_bending", "belt.bending_in_plane", "N m^2", 20.0},
    {"out_of_plane_bending", "belt.bending_out_of_plane", "N m^2", 20.0}};
const std::vector<RingNumber> kDampings = {
    {"radial_damping", "sidewall.radial.damping", "N s/m^2", 5.0},
    {"tangential_damping", "sidewall.tangential.damping", "N s/m^2", 5.0},
    {"lateral_damping", "sidewall.lateral.damping", "N s/m^2", 5.0}};

bool has(const Document& document, const std::string& path) {
  const auto paths = document.paths();
  return std::find(paths.begin(), paths.end(), path) != paths.end();
}

/// A plain number, or a quantity in quotes.
std::string written(double value, const std::string& unit, int digits = 6) {
  return unit == "1" ? format_number(value, digits)
                     : in_quotes(format_quantity(value, unit, digits));
}

std::string variables(const std::vector<RingNumber>& numbers, const Document& known) {
  std::string text;
  for (const RingNumber& number : numbers) {
    const double guess = has(known, number.path) ? known.get(number.path) : 0.0;
    if (!(guess > 0.0)) continue;  // a part that this ring does without
    text += fmt::format(
        "variable.{} = {{path = \"{}\", lower = {}, upper = {}, initial = {}, scale = "
        "\"logarithmic\"}}\n",
        number.name,
        number.path,
        written(guess / number.range, number.unit, 4),
        written(guess * number.range, number.unit, 4),
        written(guess, number.unit));
  }
  return text;
}

/// `modes`: empty: of no modes.
std::string experiment(const std::string& name,
                       const std::string& channel,
                       const std::vector<std::string>& modes,
                       const std::vector<double>& values,
                       const std::string& unit) {
  std::string text =
      fmt::format("\n[experiment.{}]\nkind = \"values\"\nchannel = \"{}\"\n", name, channel);
  if (!modes.empty()) text += fmt::format("modes = [\"{}\"]\n", fmt::join(modes, "\", \""));
  std::vector<std::string> list;
  for (const double value : values) list.push_back(written(value, unit));
  return text +
         fmt::format("values = [{}]\nnoise = \"1 %\"\nexponent = 2\n", fmt::join(list, ", "));
}

/// Of a channel of modes, those of these names that there are.
std::string experiment_of_modes(const std::string& name,
                                const Channel& channel,
                                const std::vector<std::string>& names,
                                const Channels& recorded) {
  const auto modes = experiment::mode_records(recorded);
  std::vector<std::string> found;
  std::vector<double> values;
  for (const std::string& one : names) {
    const int at = experiment::find_mode(modes, *experiment::mode_of_label(one));
    if (at < 0) continue;
    found.push_back(one);
    values.push_back(channel.values[at]);
  }
  if (found.empty()) return "";
  return experiment(name, "air/" + channel.name, found, values, channel.unit);
}

}  // namespace

RingStudy example_ring_study() {
  std::string study(published_ring_study());
  const auto begin = study.find("model = "), end = study.find('\n', begin);
  study.replace(begin, end - begin, "model = \"ring.toml\"");
  return {std::string(published_ring()), std::move(study)};
}

Result<RingStudy> ring_study_of(const experiment::SpecimenKind& kind,
                                const Document& model,
                                const Document& known,
                                const experiment::Language& language) {
  const ring_tire::RingParameters ring = ring_tire::read_ring_tire(known.root());
  const Document document = Document::parse(kTests, "tests");
  const Node tests = document.root().table("test");
  const auto run = [&](const char* name) {
    return language.run(kind, model, *language.read_test(tests.table(name), {}));
  };
  const auto pressed = run("pressed");
  if (!pressed) return pressed.failure();
  const auto air = run("air");
  if (!air) return air.failure();

  Document own = known;
  const double free_radius = (*pressed)["loaded_radius"][0] + (*pressed)["deflection"][0];
  own.set("belt.radius", std::round(1e4 * (free_radius - ring.tread.height)) / 1e4);
  if (has(model, "pressure")) own.set("pressure", model.get("pressure"));
  const Channel* damping = air->find("damping");
  const std::string file = std::filesystem::path(model.file()).filename().string();
  return RingStudy{
      fmt::format(
          "# Where the fit begins: a known ring, of which the next lines speak, with radius and "
          "pressure of {}.\n{}",
          file,
          own.text()),
      fmt::format(
          "# What {0} shows, as if measured; the numbers of ring.toml that show the same.\n"
          "title = \"Flexible ring of {0}\"\nmodel = \"ring.toml\"\n\n{1}\n{2}{3}{4}{5}{6}\n"
          "[run]\nworkers = 2\n",
          file,
          kTests,
          variables(kNumbers, own),
          damping ? variables(kDampings, own) : "",
          experiment("load", "pressed/force", {}, (*pressed)["force"], "N"),
          experiment_of_modes("frequency", *air->find("frequency"), kMotions, *air),
          damping ? experiment_of_modes("damping", *damping, kDamped, *air) : "")};
}

}  // namespace latsch::cli
