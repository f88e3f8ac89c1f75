// SPDX-License-Identifier: Apache-2.0
// latsch report: what the journal knows, as one HTML file.
#include "cli/run/trials.h"
#include "cli/verbs/verbs.h"

namespace latsch::cli {
namespace {

int report(const std::string& file, const experiment::Language& language, bool on_the_ground) {
  const auto study = correlation::read_study(file, language);
  return write_report(
      study,
      Journal::read(study.run.journal, correlation::identity(study)),
      language,
      on_the_ground ? experiment::Thoroughness::minutes : experiment::Thoroughness::seconds);
}

}  // namespace

void add_report(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand("report", "Writes one self-contained HTML file beside the study");
  verb.footer("Example:\n  latsch report studies/tire_b_twin/study.toml");
  auto file = std::make_shared<std::string>();
  verb.add_option("study", *file, "Study file (TOML)").required();
  auto on_the_ground = std::make_shared<bool>(false);
  verb.add_flag("--convergence",
                *on_the_ground,
                "Also compares the tire on the ground with finer meshes: some minutes");
  verb.callback(
      [=, &program] { program.exit_code = report(*file, program.language, *on_the_ground); });
}

}  // namespace latsch::cli
