// SPDX-License-Identifier: Apache-2.0
// latsch drum: a tire on the virtual rigs: drum with cleat, flat track, static stiffness.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "base/document.h"
#include "base/error.h"
#include "base/file.h"
#include "cli/console/answers.h"
#include "cli/console/console.h"
#include "cli/verbs/verbs.h"
#include "experiment/tests/drum_convergence.h"
#include "experiment/tests/rolling_tests.h"
#include "formats/tables/csv_table.h"

namespace latsch::cli {
namespace {

struct DrumOptions {
  std::string tire, test, output, kind;
  bool convergence = false;
};

/// What step and segments change, beside what there is to see.
int say_convergence(const experiment::TireKind& kind,
                    const Document& numbers,
                    const experiment::RollingTest& test) {
  const auto* drum = std::get_if<experiment::DrumTest>(&test);
  if (!drum)
    throw InputError("--convergence: expected a test of kind \"drum_cleat\", which steps in time");
  const auto found = experiment::drum_convergence(kind, numbers, *drum);
  if (!found) {
    complain(found.failure().reason);
    return kFailed;
  }
  Json& rows = answer()["changes"] = Json::array();
  for (const auto& one : *found)
    rows.push_back({{"channel", one.name},
                    {"unit", one.unit},
                    {"about_mean", one.about_mean},
                    {"by_half_step", one.by_step},
                    {"by_half_more_segments", one.by_segments}});
  say("{}\nroot mean square over the record, of\n{:4}{:>14}{:>20}{:>32}\n",
      experiment::in_words(test),
      "",
      "all about mean",
      "change, half step",
      "change, half more segments");
  for (const auto& one : *found)
    say("{:4}{:>14}{:>20}{:>32}\n",
        one.name,
        fmt::format("{:.1f} {}", one.about_mean, one.unit),
        fmt::format("{:.2f} {}", one.by_step, one.unit),
        fmt::format("{:.2f} {}", one.by_segments, one.unit));
  say("A step changes four times less where it is halved, segments about twice less where there "
      "are\n"
      "half as many again. Both should stay below the noise of what they are compared with.\n");
  return kDone;
}

int drum(const DrumOptions& options) {
  const experiment::TireKind& kind = options.kind.empty()
                                         ? experiment::kind_of_file(options.tire)
                                         : *experiment::find_tire_kind(options.kind);
  const auto test = experiment::read_rolling_test(options.test);
  if (options.convergence) return say_convergence(kind, kind.read(options.tire), test);
  const auto channels = experiment::run(kind, kind.read(options.tire), test);
  if (!channels) {
    complain(channels.failure().reason);
    return kFailed;
  }
  give(*channels, options.output);
  return kDone;
}

}  // namespace

void add_drum(CommandLine& app, int& exit_code) {
  Verb verb = app.add_subcommand(
      "drum",
      "A tire on a virtual rig: over a cleat on the drum, swept on the flat track, standing");
  verb.footer(
      "TIRE is a file with kind = \"ring_tire\" or a .tir, TEST one such as\n"
      "  kind = \"drum_cleat\"\n"
      "  speed = \"60 km/h\"\n"
      "  load = \"4 kN\"                       or deflection = \"20 mm\"\n"
      "  camber = \"2 deg\"\n"
      "  drum_diameter = \"2.5 m\"\n"
      "  [cleat]\n"
      "  height = \"15 mm\"\n"
      "  length = \"30 mm\"\n\n"
      "or kind = \"slip_sweep\" (speed, load, alpha = [\"-10 deg\", \"10 deg\"] or kappa), or\n"
      "kind = \"static_stiffness\" (deflections = [\"10 mm\", \"20 mm\"] or load = \"4 kN\"), or\n"
      "kind = \"footprint\" (loads or deflections; pictures: latsch footprint), or of a flexible\n"
      "ring kind = \"modes\" (load, deflection or neither; count).\n\n"
      "Examples:\n  latsch drum tire.toml test.toml > forces.csv\n"
      "  latsch drum tire.tir test.toml --kind rigid_ring -o forces.csv\n"
      "  latsch drum tire.toml test.toml --convergence");
  auto options = std::make_shared<DrumOptions>();
  verb.add_option("tire", options->tire, "Tire file").required();
  verb.add_option("test", options->test, "Test file").required();
  verb.add_option("-o,--output", options->output, "CSV file to write; else the terminal");
  verb.add_option("--kind", options->kind, "Of a .tir: magic_formula unless given")
      .one_of(experiment::tire_kind_names());
  verb.add_flag("--convergence",
                options->convergence,
                "Instead of the forces: what half the step and half as many segments again change");
  verb.callback([=, &exit_code] { exit_code = drum(*options); });
}

}  // namespace latsch::cli
