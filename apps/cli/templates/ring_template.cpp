// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/ring_template.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "base/text.h"
#include "base/units.h"
#include "experiment/language/specimen.h"
#include "experiment/rigs/mode_record.h"
#include "experiment/tests/modes.h"
#include "models/ring_tire/description/ring_reader.h"

namespace latsch::cli {
namespace {

constexpr std::string_view kTests =
    R"(test.pressed = {kind = "load_deflection", deflections = ["10 mm", "18 mm", "26 mm"]}
test.air = {kind = "modes", count = 30}
)";

/// Test of the modes of a finite-element tire with losses. It takes the moduli at each
/// frequency and computes damping, because a flexible ring shows both.
constexpr std::string_view kDampedTests =
    R"(test.air = {kind = "modes", count = 30, damping = true}
)";

const std::vector<std::string> kMotions = {
    "torsional n=0", "radial n=1", "lateral n=0", "lateral n=1", "radial n=2", "lateral n=2"};
const std::vector<std::string> kDamped = {"torsional n=0", "radial n=1", "lateral n=1"};

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

/// Returns the value as text of a study: a plain number, or a quantity with its unit in quotes.
std::string written(double value, const std::string& unit, int digits = 6) {
  return unit == "1" ? format_number(value, digits)
                     : in_quotes(format_quantity(value, unit, digits));
}

/// Returns the text of an experiment. `modes` is empty for a channel without modes.
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

/// Returns the experiment of a channel with one value for each mode, with those modes of the list
/// that the channel has.
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

// Second pressure as a share of the tire's own, like that of an underinflated tire.
constexpr double kSecondPressure = 0.8;
// initial value of the share of the sidewall stiffness that is due to pressure
constexpr double kShare = 0.5;

/// Returns a load test at a second pressure, if the tire states its own pressure.
std::string soft_test(const Document& model) {
  if (!has(model, "pressure") || !(model.get("pressure") > 0.0)) return "";
  return fmt::format(
      "test.soft = {{kind = \"load_deflection\", pressure = {}, deflections = [\"18 mm\"]}}\n",
      written(kSecondPressure * model.get("pressure"), "bar"));
}

/// Adds the share of the sidewall stiffness that is due to pressure, if the ring does not state it.
/// The share applies at the ring's own pressure, so the ring stays unchanged there.
std::string with_pressure_share(const Document& ring) {
  std::string text = ring.text();
  const auto table = text.find("\n[sidewall]");
  const auto end = table == std::string::npos ? table : text.find('\n', table + 1);
  if (has(ring, "sidewall.pressure_share") || end == std::string::npos) return text;
  return text.insert(end + 1,
                     fmt::format("pressure_share = {}\nreference_pressure = {}\n",
                                 kShare,
                                 written(ring.get("pressure"), "bar")));
}

std::string share_variable(const Document& ring) {
  const double guess = ring.get("sidewall.pressure_share");
  return fmt::format(
      "variable.pressure_share = {{path = \"sidewall.pressure_share\", lower = 0, upper = 1, "
      "initial = {}}}\n",
      written(guess, "1"));
}

}  // namespace

std::string ring_variables(const std::vector<RingNumber>& numbers, const Document& known) {
  std::string text;
  for (const RingNumber& number : numbers) {
    const double guess = has(known, number.path) ? known.get(number.path) : 0.0;
    if (!(guess > 0.0)) continue;  // skips a part that this ring does not have
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
  const std::string tests_text = std::string(kTests) + soft_test(model);
  const Document document = Document::parse(tests_text, "tests");
  const Node tests = document.root().table("test");
  const auto run = [&](const char* name) {
    return language.run(kind, model, *language.read_test(tests.table(name), {}));
  };
  const auto pressed = run("pressed");
  if (!pressed) return pressed.failure();
  const bool is_damped = experiment::has_losses(*kind.build(model));
  const Document damped = Document::parse(std::string(kDampedTests), "tests");
  const auto air =
      is_damped
          ? language.run(
                kind, model, *language.read_test(damped.root().table("test").table("air"), {}))
          : run("air");
  if (!air) return air.failure();
  std::optional<Channels> soft;
  if (tests.has("soft")) {
    auto recorded = run("soft");
    if (!recorded) return recorded.failure();
    soft = std::move(*recorded);
  }

  Document own = known;
  const double free_radius = (*pressed)["loaded_radius"][0] + (*pressed)["deflection"][0];
  own.set("belt.radius", std::round(1e4 * (free_radius - ring.tread.height)) / 1e4);
  if (has(model, "pressure")) own.set("pressure", model.get("pressure"));
  if (soft) own = Document::parse(with_pressure_share(own), known.file());
  const bool has_share = soft && has(own, "sidewall.pressure_share");
  const Channel* damping = air->find("damping");
  const std::string file = std::filesystem::path(model.file()).filename().string();
  return RingStudy{
      fmt::format(
          "# The start of the fit: a known ring, described by the next lines, with radius and "
          "pressure of {}.\n{}",
          file,
          own.text()),
      fmt::format(
          "# Results of {0}, used as measurements; the fit finds the numbers of ring.toml that "
          "give the same.\n{9}"
          "title = \"Flexible ring of {0}\"\nmodel = \"ring.toml\"\n\n{1}\n{2}{3}{4}{5}{6}{7}{8}\n"
          "[run]\nworkers = 2\n",
          file,
          tests_text,
          ring_variables(kNumbers, own),
          has_share ? share_variable(own) : "",
          damping ? ring_variables(kDampings, own) : "",
          experiment("load", "pressed/force", {}, (*pressed)["force"], "N"),
          soft ? experiment("soft_load", "soft/force", {}, (*soft)["force"], "N") : "",
          experiment_of_modes("frequency", *air->find("frequency"), kMotions, *air),
          damping ? experiment_of_modes("damping", *damping, kDamped, *air) : "",
          is_damped
              ? fmt::format("# Frequencies and dampings of {} are those of its moduli at each "
                            "frequency (damping = true), its loads those of relaxed ones.\n",
                            file)
              : "")};
}

}  // namespace latsch::cli
