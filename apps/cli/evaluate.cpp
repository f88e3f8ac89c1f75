// SPDX-License-Identifier: Apache-2.0
// latsch evaluate: forces, moments, radii and contact patch of a steady-state tire, state by state.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/file.h"
#include "cli/answers.h"
#include "cli/console.h"
#include "cli/verbs.h"
#include "experiment/slip_states.h"
#include "formats/tir_file.h"

namespace latsch::cli {
namespace {

using magic_formula::Angles;
using magic_formula::Conventions;
using magic_formula::MagicFormula;

struct EvaluateOptions {
  std::string tire, states, output;
  std::string limits = "on", angles = "direct", turn_slip = "off", side = "measured";
};

Conventions conventions(const EvaluateOptions& options) {
  Conventions c;
  c.limits = options.limits == "on";
  c.angles = options.angles == "direct" ? Angles::direct : Angles::tangent;
  c.turn_slip = options.turn_slip == "on";
  c.mirrored = options.side == "other";
  return c;
}

int evaluate(const EvaluateOptions& options) {
  const formats::TirFile tir = formats::read_tir(options.tire);
  const SlipStates given = slip_states(formats::CsvTable::read(options.states), tir.parameters);
  for (const std::string& note : tir.notes) warn(note, {options.tire, 0});
  for (const std::string& column : given.unused)
    warn(fmt::format("{}: column \"{}\" is not used", options.states, column));
  const Conventions chosen = conventions(options);
  const int outside = outside_of_ranges(given.states, tir.parameters);
  if (chosen.limits && outside > 0)
    warn(
        fmt::format("{} of {} states lie outside of the ranges of {} and are limited to them "
                    "(--limits off takes them as they are)",
                    outside,
                    given.states.size(),
                    options.tire));
  const MagicFormula tire(tir.parameters, chosen);
  if (chosen.turn_slip && !tire.conventions().turn_slip)
    warn(options.tire + " has no turn slip coefficients: evaluated without");
  std::vector<magic_formula::SteadyState> results(given.states.size());
  tire.evaluate(given.states, results);
  give(answers(results), options.output);
  return kDone;
}

}  // namespace

void add_evaluate(CommandLine& app, int& exit_code) {
  Verb verb =
      app.add_subcommand("evaluate", "Forces, moments, radii and patch of a tire in steady state");
  verb.footer(
      "STATES is a table with the column Fz and any of kappa, alpha, gamma, phit, Vx, p, in any\n"
      "order, in SI or in the unit in brackets behind the name: \"alpha [deg]\".\n"
      "Examples:\n  latsch evaluate tire.tir states.csv\n"
      "  latsch evaluate tire.tir states.csv --angles tangent --turn-slip on -o forces.csv");
  auto options = std::make_shared<EvaluateOptions>();
  verb.add_option("tire", options->tire, "Tire property file (.tir; MF 5.2, 6.1, 6.2)").required();
  verb.add_option("states", options->states, "States (CSV)").required();
  verb.add_option("-o,--output", options->output, "CSV file to write; else the terminal");
  verb.add_option("--limits",
                  options->limits,
                  "on: inputs limited to the ranges of the file, faded below VXLOW")
      .one_of({"on", "off"})
      .capture_default_str();
  verb.add_option("--angles",
                  options->angles,
                  "direct: alpha and gamma as they are; tangent: tan(alpha), sin(gamma)")
      .one_of({"direct", "tangent"})
      .capture_default_str();
  verb.add_option("--turn-slip", options->turn_slip, "Forces and moments of turning by phit")
      .one_of({"on", "off"})
      .capture_default_str();
  verb.add_option(
          "--side", options->side, "The vehicle side: as measured, or the other one (mirrored)")
      .one_of({"measured", "other"})
      .capture_default_str();
  verb.callback([=, &exit_code] { exit_code = evaluate(*options); });
}

}  // namespace latsch::cli
