// SPDX-License-Identifier: Apache-2.0
// Implements `latsch report`: writes the contents of the journal as one HTML file.
#include "cli/run/trials.h"
#include "cli/verbs/verbs.h"
#include "correlation/search/search_standing.h"
#include "correlation/search/stage_runs.h"

namespace latsch::cli {
namespace {

int report(const std::string& file,
           const experiment::Language& language,
           bool on_the_ground,
           const std::string& output) {
  const auto study = correlation::read_study(file, language);
  const Journal journal = Journal::read(study.run.journal, correlation::identity(study));
  correlation::require_best(correlation::with_estimated_noise(study, journal), journal);
  return write_report(
      study,
      journal,
      language,
      on_the_ground ? experiment::Thoroughness::minutes : experiment::Thoroughness::seconds,
      output);
}

}  // namespace

void add_report(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand("report", "Writes one self-contained HTML file beside the study");
  verb.footer(
      "Examples:\n  latsch report studies/tire_b_twin/study.toml\n"
      "  latsch report my_tire/study.toml -o report.html   # if the study's folder may not be "
      "written");
  auto file = std::make_shared<std::string>();
  verb.add_option("study", *file, "Study file (TOML)").required();
  auto output = std::make_shared<std::string>();
  verb.add_option("-o,--output", *output, "HTML file to write; beside the study unless given")
      .written_as("HTML", {".html", ".htm"});
  auto on_the_ground = std::make_shared<bool>(false);
  verb.add_flag("--convergence",
                *on_the_ground,
                "Also compares the tire on the ground with finer meshes: some minutes");
  verb.callback([=, &program] {
    program.exit_code = report(*file, program.language, *on_the_ground, *output);
  });
}

}  // namespace latsch::cli
