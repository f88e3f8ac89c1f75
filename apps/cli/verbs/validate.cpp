// SPDX-License-Identifier: Apache-2.0
// Implements `latsch validate`: runs a model through a suite of checks, each with its limit and its
// source.

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/units.h"
#include "cli/console/console.h"
#include "cli/console/ledgers.h"
#include "cli/run/model_source.h"
#include "cli/verbs/verbs.h"
#include "correlation/study/ledgers/file_ledgers.h"
#include "correlation/study/ledgers/study_ledgers.h"
#include "correlation/validation/validation.h"

namespace latsch::cli {
namespace {

using correlation::CheckResult;
using correlation::Validation;

Json limit_answer(const std::optional<double>& limit) {
  return limit ? Json(*limit) : Json(nullptr);
}

void answer_results(const Validation& validation, const std::string& page) {
  answer()["accepted"] = validation.accepted();
  answer()["report"] = page;
  for (const CheckResult& one : validation.results)
    answer()["checks"].push_back({{"check", one.check},
                                  {"what", one.what},
                                  {"value", limit_answer(one.value)},
                                  {"lower", limit_answer(one.lower)},
                                  {"upper", limit_answer(one.upper)},
                                  {"unit", si_unit(Unit::of(one.unit).dimension())},
                                  {"accepted", one.accepted},
                                  {"source", one.source},
                                  {"reason", one.reason}});
}

void print_results(const std::vector<CheckResult>& results) {
  std::size_t check = 5, what = 2, limit = 5;
  for (const CheckResult& one : results) {
    check = std::max(check, one.check.size());
    what = std::max(what, one.what.size());
    limit = std::max(limit, limit_text(one).size());
  }
  const auto line = [&](const std::string& a,
                        const std::string& b,
                        const std::string& c,
                        const std::string& d,
                        const std::string& e,
                        const std::string& f) {
    say("{:<{}}  {:<{}}  {:>12}  {:>{}}  {:<3}  {}\n", a, check, b, what, c, d, limit, e, f);
  };
  line("check", "of", "value", "limit", "ok", "source");
  for (const CheckResult& one : results) {
    line(one.check,
         one.what,
         value_text(one),
         limit_text(one),
         one.accepted ? "yes" : "NO",
         one.source);
    if (!one.reason.empty()) say("{:<{}}  {}\n", "", check, one.reason);
  }
}

/// Returns the ledgers of all files that the model and the suite read.
std::vector<Ledger> ledgers_of(const correlation::Suite& suite,
                               const std::string& model_file,
                               const experiment::Language& language) {
  std::vector<correlation::StudyExperiment> experiments;
  for (const correlation::Check& check : suite.checks)
    if (check.experiment) experiments.push_back(*check.experiment);
  const std::string model = is_study(model_file)
                                ? study_with_model(model_file, language).model_file.string()
                                : model_file;
  auto all =
      ledgers_of_test(model, "{}", {}, correlation::ledgers_of({}, experiments, suite.tests));
  for (Ledger& ledger : correlation::ledgers_of_named_files(suite.file, "the suite", all))
    all.push_back(std::move(ledger));
  return all;
}

int validate(const std::string& model_file,
             const std::string& suite_file,
             const std::string& kind,
             std::string page,
             const experiment::Language& language) {
  const ModelSource model = model_source(model_file, language, kind);
  const auto suite = correlation::read_suite(suite_file, *model.kind, language);
  say_ledgers(ledgers_of(suite, model_file, language), LinesTo::output, "Files");
  Validation validation;
  {
    RunningNote progress;
    long done = 0;
    validation =
        correlation::validate(suite, *model.kind, model.numbers, [&](const std::string& test) {
          progress.update(done++, static_cast<long>(suite.tests.size()), test);
        });
  }
  for (const std::string& note : validation.notes) warn(note, {model_file, 0});
  if (page.empty()) page = std::filesystem::path(suite_file).replace_extension(".html").string();
  validation.page.model_file = model_file;
  write_text_file(page, report::html(validation.page));
  answer_results(validation, page);
  say("{}\n{}\n\n", suite.title, validation.page.tire);
  print_results(validation.results);
  const auto accepted = std::count_if(validation.results.begin(),
                                      validation.results.end(),
                                      [](const CheckResult& one) { return one.accepted; });
  say("\n{} of {} accepted\nReport: {}\n", accepted, validation.results.size(), page);
  return validation.accepted() ? kDone : kFailed;
}

}  // namespace

void add_validate(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand(
      "validate", "Runs a model through a suite of checks, each with a limit and its source");
  verb.footer(
      "MODEL is a file with a model, or a study at its best point; SUITE a file such as\n"
      "  [test.standing]\n"
      "  file = \"standing.toml\"               a test, as latsch test reads it\n"
      "  [check.vertical]                     a number of a channel, between bounds\n"
      "  channel = \"standing/vertical\"\n"
      "  lower = \"200 N/mm\"\n"
      "  upper = \"240 N/mm\"\n"
      "  source = \"drawing 12-345, sheet 2\"\n"
      "  [check.curve]                        or an experiment of a study, with limits of its "
      "errors\n"
      "  kind = \"load_deflection\"\n"
      "  measurement = \"stiffness.csv\"\n"
      "  mean_error = \"5 %\"                   of all values; limits are inclusive\n"
      "  largest_error = \"10 %\"               of each\n"
      "  source = \"test report 4711\"\n\n"
      "Exit codes: 0 all accepted; 1 some not, or a test failed; 2 wrong input.\n\n"
      "Examples:\n"
      "  latsch validate studies/ring_tires/passenger_205_55R16.toml "
      "studies/ring_tires/suite.toml -o acceptance.html");
  auto model = std::make_shared<std::string>(), suite = std::make_shared<std::string>(),
       kind = std::make_shared<std::string>(), page = std::make_shared<std::string>();
  verb.add_option("model", *model, "Model or study").required();
  verb.add_option("suite", *suite, "Suite of checks (TOML)").required();
  verb.add_option("-o,--output", *page, "Page to write (HTML); beside the suite unless given")
      .written_as("HTML", {".html", ".htm"});
  verb.add_option("--kind", *kind, "Kind of model, for a file that can be read as several")
      .one_of(program.language.kind_names());
  verb.callback([=, &program] {
    program.exit_code = validate(*model, *suite, *kind, *page, program.language);
  });
}

}  // namespace latsch::cli
