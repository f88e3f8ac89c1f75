// SPDX-License-Identifier: Apache-2.0
// latsch ring: the numbers of a flexible ring tire from what was measured of it.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "cli/console/answers.h"
#include "cli/console/console.h"
#include "cli/verbs/verbs.h"
#include "correlation/analysis/identifiability.h"
#include "correlation/basic_data/ring_data.h"

namespace latsch::cli {
namespace {

struct RingOptions {
  std::string data, output;
  int evaluations = 400;
};

int ring(const RingOptions& options) {
  const auto data = correlation::read_ring_data(options.data);
  const auto fit = correlation::fit_ring(data, options.evaluations);
  if (!fit) {
    complain(fit.failure().reason);
    return kFailed;
  }
  say("{} evaluations\n\n{:24} {:>14} {:>14} {:>9}\n",
      fit->evaluations,
      "target",
      "measured",
      "tire",
      "error");
  for (std::size_t i = 0; i < data.targets.size(); ++i) {
    const auto& target = data.targets[i];
    answer()["targets"].push_back({{"name", target.name},
                                   {"measured", target.value},  // SI
                                   {"tire", fit->values[i]},
                                   {"error", fit->values[i] / target.value - 1.0},
                                   {"fitted", target.weight > 0.0}});
    say("{:24} {:14.6g} {:14.6g} {:8.2f} %{}\n",
        target.name,
        target.value,
        fit->values[i],
        100.0 * (fit->values[i] / target.value - 1.0),
        target.weight > 0.0 ? "" : "  (not fitted)");
  }
  say("\n");
  for (int i = 0; i < data.space.size(); ++i)
    say("{:24} {}\n",
        data.space[i].name,
        correlation::value_text(data.space,
                                i,
                                fit->point.values[static_cast<std::size_t>(i)],
                                fit->confidence.intervals[static_cast<std::size_t>(i)]));
  answer()["variables"] = answer_of(data.space, fit->point);
  answer()["evaluations"] = fit->evaluations;
  const auto missed = correlation::missed(data, *fit);
  if (!missed.empty()) say("\nMissed by more than 3 %, to first order:\n");
  for (const std::string& sentence : missed) say("  {}\n", sentence);
  const auto open = correlation::left_open(data, fit->confidence);
  say("\nLeft open by data of {:.0f} % error: {}\n",
      100.0 * correlation::kTypicalError,
      open.empty() ? "nothing" : "");
  for (const std::string& sentence : open) say("  {}\n", sentence);
  if (!options.output.empty()) {
    write_text_file(options.output, fit->tire.text());
    say_written(options.output);
  }
  return kDone;
}

}  // namespace

void add_ring(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand("ring", "A ring tire from measured loads, stiffnesses and modes");
  verb.footer(
      "DATA names a tire file with known numbers, [variable.NAME] for those to be found and\n"
      "[target.NAME] for what was measured: loads, stiffnesses, footprints, frequencies, damping.\n"
      "Says which targets the tire misses, what would mend each and which other pays for it, and\n"
      "what of the variables the data leave open.\n\n"
      "Example:\n  latsch ring data.toml --output tire.toml");
  auto options = std::make_shared<RingOptions>();
  verb.add_option("data", options->data, "Data file").required();
  verb.add_option("--output", options->output, "Tire file to write");
  verb.add_option("--evaluations", options->evaluations, "At most").between(1, 100000);
  verb.callback([=, &program] { program.exit_code = ring(*options); });
}

}  // namespace latsch::cli
