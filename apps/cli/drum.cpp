// SPDX-License-Identifier: Apache-2.0
// latsch drum: a tire on the virtual rigs: drum with cleat, flat track, static stiffness.
#include <fmt/format.h>

#include <memory>

#include "base/document.h"
#include "base/error.h"
#include "base/file.h"
#include "cli/verbs.h"
#include "experiment/rolling_tests.h"
#include "formats/csv_table.h"

namespace latsch::cli {
namespace {

struct Options {
  std::string tire, test, output, kind;
};

int drum(const Options& options) {
  const experiment::TireKind& kind = options.kind.empty()
                                         ? experiment::kind_of_file(options.tire)
                                         : *experiment::find_tire_kind(options.kind);
  const auto test = experiment::read_rolling_test(options.test);
  const auto channels = experiment::run(kind, kind.read(options.tire), test);
  if (!channels) {
    fmt::print(stderr, "latsch drum: {}\n", channels.failure().reason);
    return kFailed;
  }
  const std::string text = formats::csv_text(*channels);
  if (options.output.empty()) {
    fmt::print("{}", text);
  } else {
    write_text_file(options.output, text);
    fmt::print("wrote {}\n", options.output);
  }
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
      "  latsch drum tire.tir test.toml --kind rigid_ring -o forces.csv");
  auto options = std::make_shared<Options>();
  verb.add_option("tire", options->tire, "Tire file").required();
  verb.add_option("test", options->test, "Test file").required();
  verb.add_option("-o,--output", options->output, "CSV file to write; else the terminal");
  verb.add_option("--kind", options->kind, "Of a .tir: magic_formula unless given")
      .one_of(experiment::tire_kind_names());
  verb.callback([=, &exit_code] { exit_code = drum(*options); });
}

}  // namespace latsch::cli
