// SPDX-License-Identifier: Apache-2.0
// latsch evaluate: forces, moments, radii and contact patch of a steady-state tire, state by state.
#include <fmt/format.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <ostream>

#include "base/file.h"
#include "cli/console/answers.h"
#include "cli/console/console.h"
#include "cli/verbs/verbs.h"
#include "experiment/rigs/slip_states.h"
#include "formats/tire/tir_file.h"

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

/// Block by block, so that a table of any length takes the same memory.
class Evaluation {
 public:
  Evaluation(const magic_formula::Parameters& tire, const Conventions& conventions)
      : tire_(tire, conventions) {}

  /// Tells what is computed, block by block.
  void run(const formats::CsvTable& table, const std::function<void(const Channels&)>& tell) {
    constexpr int kBlock = 8192;  // states
    unused_ = for_slip_states(table, tire_.parameters(), kBlock, [&](auto& states) {
      results_.resize(states.size());
      tire_.evaluate(states, results_);
      outside_ += outside_of_ranges(states, tire_.parameters());
      count_ += static_cast<long>(states.size());
      tell(answers(results_));
    });
  }

  void warn_of(const EvaluateOptions& options) const {
    for (const std::string& column : unused_)
      warn(fmt::format("{}: column \"{}\" is not used", options.states, column));
    if (tire_.conventions().limits && outside_ > 0)
      warn(
          fmt::format("{} of {} states lie outside of the ranges of {} and are limited to them "
                      "(--limits off takes them as they are)",
                      outside_,
                      count_,
                      options.tire));
    if (options.turn_slip == "on" && !tire_.conventions().turn_slip)
      warn(options.tire + " has no turn slip coefficients: evaluated without");
  }

 private:
  MagicFormula tire_;
  std::vector<magic_formula::SteadyState> results_;
  std::vector<std::string> unused_;
  long count_ = 0, outside_ = 0;
};

/// CSV, its header before the first block.
void write_table(Evaluation& evaluation,
                 const formats::CsvTable& table,
                 const std::function<void(const std::string&)>& to) {
  bool first = true;
  evaluation.run(table, [&](const Channels& block) {
    if (first) to(formats::csv_header(block));
    first = false;
    to(formats::csv_rows(block));
  });
}

int evaluate(const EvaluateOptions& options) {
  const formats::TirFile tir = formats::read_tir(options.tire);
  for (const std::string& note : tir.notes) warn(note, {options.tire, 0});
  const auto table = formats::CsvTable::read(options.states);
  Evaluation evaluation(tir.parameters, conventions(options));
  if (!options.output.empty()) {
    write_file(options.output, [&](std::ostream& out) {
      write_table(evaluation, table, [&](const std::string& text) { out << text; });
    });
    say_written(options.output);
  } else if (answers_in_json()) {
    Json& all = answer()["channels"] = Json::array();
    evaluation.run(table, [&](const Channels& block) {
      const Json more = answer_of(block);
      if (all.empty()) {
        all = more;
        return;
      }
      for (std::size_t i = 0; i < more.size(); ++i)
        for (const Json& value : more[i]["values"]) all[i]["values"].push_back(value);
    });
  } else {
    write_table(evaluation, table, [](const std::string& text) { put(text); });
  }
  evaluation.warn_of(options);
  return kDone;
}

}  // namespace

void add_evaluate(CommandLine& app, Program& program) {
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
  verb.callback([=, &program] { program.exit_code = evaluate(*options); });
}

}  // namespace latsch::cli
