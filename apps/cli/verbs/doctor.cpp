// SPDX-License-Identifier: Apache-2.0
// Implements `latsch doctor`: examines whether a journal is as it was written, which parts are
// damaged and which trials can be saved.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/console/console.h"
#include "cli/verbs/verbs.h"
#include "correlation/study/run_settings.h"
#include "correlation/study/study.h"
#include "evaluation/journal/journal_doctor.h"

namespace latsch::cli {
namespace {

void print_findings(const std::string& file, const JournalReport& report) {
  answer() = {{"journal", file},
              {"healthy", report.healthy()},
              {"intact_trials", report.rows.size()},
              {"expected_trials", report.expected >= 0 ? Json(report.expected) : Json(nullptr)},
              {"notes", report.notes},
              {"damage", report.findings}};
  const std::string expected =
      report.expected >= 0 ? fmt::format(" of {}", report.expected) : std::string();
  say("{}: {}{} trials are as they were written\n", file, report.rows.size(), expected);
  for (const std::string& note : report.notes) say("  note: {}\n", note);
  for (const std::string& finding : report.findings) say("  damage: {}\n", finding);
  if (report.healthy()) say("Every page and every hash is in order.\n");
}

/// Returns the file itself if it is a journal, or the journal of a study.
std::string journal_of(const std::string& file) {
  if (std::filesystem::path(file).extension() != ".toml") return file;
  const Document study = Document::read(file);
  const auto run = study.root().find_table("run");
  const auto journal = correlation::read_run_settings(run ? &*run : nullptr, file).journal;
  if (!std::filesystem::exists(journal))
    throw InputError({file, 0},
                     "is a study without a journal: " + journal.string() +
                         " does not exist yet; the first latsch run creates it");
  return journal.string();
}

int examine(const std::string& named,
            const std::string& salvaged,
            const std::string& study,
            const experiment::Language& language) {
  const std::string file = journal_of(named);
  const JournalReport report = examine_journal(file);
  print_findings(file, report);
  if (!salvaged.empty()) {
    std::optional<StudyIdentity> identity;
    if (!study.empty()) identity = correlation::identity(correlation::read_study(study, language));
    salvage_journal(report, identity, salvaged);
    say("{} trials are saved in {}; replace the damaged file by it and continue with "
        "latsch resume\n",
        report.rows.size(),
        salvaged);
  } else if (!report.healthy() && !report.rows.empty()) {
    say("Save the intact trials with: latsch doctor {} --salvage NEW.latsch\n", file);
  }
  return report.healthy() ? kDone : kFailed;
}

}  // namespace

void add_doctor(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand(
      "doctor", "Checks every page and hash of a journal, says what is damaged, saves the rest");
  verb.footer(
      "Example:\n  latsch doctor my_tire/study.latsch\n"
      "  latsch doctor my_tire/study.latsch --salvage saved.latsch\n\n"
      "Exit code 0: as it was written; 1: damaged.");
  auto file = std::make_shared<std::string>();
  auto salvaged = std::make_shared<std::string>();
  auto study = std::make_shared<std::string>();
  verb.add_option("journal", *file, "Journal of a study (.latsch), or the study").required();
  verb.add_option("--salvage", *salvaged, "Write the intact trials to this new journal");
  verb.add_option("--study", *study, "The study it belongs to, if the journal cannot say");
  verb.forms({{"examines a journal", {}}, {"saves the intact trials", {"--salvage"}, {"--study"}}});
  verb.callback(
      [=, &program] { program.exit_code = examine(*file, *salvaged, *study, program.language); });
}

}  // namespace latsch::cli
