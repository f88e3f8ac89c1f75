// SPDX-License-Identifier: Apache-2.0
// latsch test: any model through any test it can do, as channels.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "base/document.h"
#include "base/error.h"
#include "base/file.h"
#include "cli/console/answers.h"
#include "cli/console/console.h"
#include "cli/templates/tire_source.h"
#include "cli/verbs/verbs.h"
#include "experiment/language.h"
#include "experiment/tests/drum_cleat.h"
#include "experiment/tests/drum_convergence.h"
#include "formats/tables/csv_table.h"

namespace latsch::cli {
namespace {

struct TestOptions {
  std::string model, test, output, kind;
  bool convergence = false, list = false;
};

/// What step and segments change, beside what there is to see.
int say_convergence(const experiment::SpecimenKind& kind,
                    const Document& numbers,
                    const experiment::Test& test) {
  const auto* drum = dynamic_cast<const experiment::DrumCleatTest*>(&test);
  if (!drum)
    throw InputError("--convergence: expected a test of kind \"drum_cleat\", which steps in time");
  const auto found = experiment::drum_convergence(kind, numbers, drum->settings());
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
      test.in_words(),
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

/// Which kinds of models can do which kinds of tests, by what both say of themselves.
int say_matrix() {
  const experiment::Language& language = experiment::language();
  Json& rows = answer()["tests"] = Json::array();
  for (const experiment::TestKind* test : language.tests) {
    std::vector<std::string> able;
    for (const experiment::SpecimenKind* kind : language.kinds)
      if (experiment::can(*kind, test->needs)) able.push_back(kind->name());
    rows.push_back({{"kind", test->name}, {"what", test->in_words}, {"models", able}});
    say("{:<17} {}\n{:<17} {}\n", test->name, test->in_words, "", fmt::join(able, ", "));
  }
  return kDone;
}

int test(const TestOptions& options) {
  if (options.list) return say_matrix();
  if (options.model.empty() || options.test.empty())
    throw InputError(
        "test: expected a model and a test, such as: latsch test tire.toml test.toml; "
        "latsch test --list says which model can do which");
  const ModelSource model = model_source(options.model, options.kind);
  const auto test = experiment::language().read_test(options.test);
  if (options.convergence) return say_convergence(*model.kind, model.numbers, *test);
  const auto channels = experiment::run(*model.kind, model.numbers, *test);
  if (!channels) {
    complain(channels.failure().reason);
    return kFailed;
  }
  give(*channels, options.output);
  return kDone;
}

}  // namespace

void add_test(CommandLine& app, int& exit_code) {
  Verb verb = app.add_subcommand(
      "test", "Any model through a test: over a cleat, on a flat track, standing, its modes, ...");
  verb.footer(
      "MODEL is a file with a model, or a study at its best point; TEST a file such as\n"
      "  kind = \"drum_cleat\"\n"
      "  speed = \"60 km/h\"\n"
      "  load = \"4 kN\"                       or deflection = \"20 mm\"\n"
      "  drum_diameter = \"2.5 m\"\n"
      "  [cleat]\n"
      "  height = \"15 mm\"\n"
      "  length = \"30 mm\"\n\n"
      "or\n"
      "  kind = \"load_deflection\"\n"
      "  deflections = [\"10 mm\", \"20 mm\"]\n\n"
      "latsch help study has the keys of every test, latsch test --list which models can do "
      "which.\n\n"
      "Examples:\n  latsch test tire.toml test.toml > forces.csv\n"
      "  latsch test tire.tir test.toml --kind rigid_ring -o forces.csv\n"
      "  latsch test studies/tire_b_twin/study.toml modes.toml\n"
      "  latsch test tire.toml test.toml --convergence\n"
      "  latsch test --list");
  auto options = std::make_shared<TestOptions>();
  verb.add_option("model", options->model, "Model or study");
  verb.add_option("test", options->test, "Test file");
  verb.add_option("-o,--output", options->output, "CSV file to write; else the terminal");
  verb.add_option("--kind", options->kind, "Of a .tir: magic_formula unless given")
      .one_of(experiment::language().kind_names());
  verb.add_flag("--list", options->list, "Which models can do which tests");
  verb.add_flag("--convergence",
                options->convergence,
                "Of a drum_cleat: what half the step and half as many segments again change");
  verb.callback([=, &exit_code] { exit_code = test(*options); });
}

}  // namespace latsch::cli
