// SPDX-License-Identifier: Apache-2.0
// latsch drum: a ring tire on the virtual drum rig.
#include <fmt/format.h>

#include <memory>

#include "base/document.h"
#include "base/error.h"
#include "base/file.h"
#include "cli/verbs.h"
#include "experiment/drum_rig.h"
#include "formats/csv_table.h"
#include "models/ring_tire/ring_reader.h"
#include "models/ring_tire/ring_tire.h"

namespace latsch::cli {
namespace {

struct Options {
  std::string tire, test, output;
};

int drum(const Options& options) {
  ring_tire::RingTire tire(ring_tire::read_ring_tire(Document::read(options.tire).root()));
  const auto test = experiment::read_drum_test(Document::read(options.test).root());
  const auto channels = experiment::run(tire, test);
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

void add_drum(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("drum", "A ring tire over a cleat on the virtual drum rig");
  verb->footer(
      "TIRE is a file with kind = \"ring_tire\", TEST one such as\n"
      "  kind = \"drum_cleat\"\n"
      "  speed = \"60 km/h\"\n"
      "  load = \"4 kN\"                       or deflection = \"20 mm\"\n"
      "  camber = \"2 deg\"\n"
      "  drum_diameter = \"2.5 m\"\n"
      "  [cleat]\n"
      "  height = \"15 mm\"\n"
      "  length = \"30 mm\"\n\n"
      "Example:\n  latsch drum tire.toml test.toml > forces.csv");
  auto options = std::make_shared<Options>();
  verb->add_option("tire", options->tire, "Tire file")->required();
  verb->add_option("test", options->test, "Test file")->required();
  verb->add_option("--output", options->output, "File to write; else the terminal");
  verb->callback([=, &exit_code] { exit_code = drum(*options); });
}

}  // namespace latsch::cli
