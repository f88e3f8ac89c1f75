// SPDX-License-Identifier: Apache-2.0
// Implements `latsch compare`: runs tires of several kinds through the same drum tests, or models
// of any kind through the same tests, and compares them with measurements.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "cli/console/console.h"
#include "cli/console/implausible.h"
#include "cli/console/ledgers.h"
#include "cli/verbs/comparison/compared_models.h"
#include "cli/verbs/verbs.h"
#include "correlation/comparison/comparison_page.h"
#include "correlation/comparison/model_comparison_file.h"
#include "correlation/comparison/tire_comparison.h"
#include "correlation/study/ledgers/file_ledgers.h"
#include "formats/tables/csv_table.h"

namespace latsch::cli {
namespace {

namespace fs = std::filesystem;
using correlation::ComparisonFile;
using correlation::TireComparison;

constexpr int kUsualThreads = 2;

/// Writes the simulated results of the specimen as measured tables, to which a study can be fitted.
void write_measurements(const ComparisonFile& file, const fs::path& folder) {
  if (!file.specimen)
    throw InputError({file.file.string(), 0}, "has no [specimen] to write measurements from");
  fs::create_directories(folder);
  for (std::size_t t = 0; t < file.tests.size(); ++t) {
    std::vector<std::string> limits;
    const Channels all = correlation::measure(*file.specimen, file.tests[t], t, &limits);
    for (const std::string& limit : limits)
      warn(fmt::format("the specimen: {} (test {})", limit, file.tests[t].name),
           {file.file.string(), 0});
    Channels kept;
    kept.add({"time", "s", all["time"]});
    for (const std::string& channel : file.channels) {
      std::vector<double> rounded = all[channel];  // rounded to a tenth, the resolution of a rig
      for (double& value : rounded) value = std::round(10.0 * value) / 10.0;
      kept.add({channel, all.find(channel)->unit, std::move(rounded)});
    }
    const fs::path to = folder / (file.tests[t].name + ".csv");
    write_text_file(to, formats::csv_text(kept));
    say_written(to.string());
  }
}

/// Returns the ledgers of the recordings that the tests name, each once.
std::vector<Ledger> ledgers_of_recordings(const ComparisonFile& file) {
  std::vector<Ledger> all;
  for (const correlation::ComparisonTest& test : file.tests)
    for (Ledger& ledger : test.measurement ? test.measurement->ledgers() : std::vector<Ledger>())
      if (std::none_of(
              all.begin(), all.end(), [&](const Ledger& one) { return one.file == ledger.file; }))
        all.push_back(std::move(ledger));
  return all;
}

/// Reports how the files that the comparison names were read: the recordings, then the others.
void say_files(const std::string& name, std::vector<Ledger> recordings) {
  auto others = correlation::ledgers_of_named_files(name, "the comparison", recordings);
  for (Ledger& ledger : others) recordings.push_back(std::move(ledger));
  say_ledgers(recordings, LinesTo::output, "Files");
}

/// Returns the errors of a tire in every test, and over the tests that were held out.
nlohmann::ordered_json answer_of_tire(const ComparisonFile& file,
                                      const TireComparison& comparison,
                                      std::size_t tire,
                                      const std::vector<std::string>& limits) {
  const correlation::TireSummary& sum = comparison.tires[tire];
  nlohmann::ordered_json all = {{"name", file.tires[tire].name},
                                {"channels", file.channels},
                                {"time_error", sum.time_error},
                                {"psd_error", sum.psd_error},
                                {"cpu_over_time", sum.cpu_over_time},
                                {"limits", limits}};
  if (!sum.held_out_psd_error.empty())
    all["held_out"] = {{"channels", file.channels},
                       {"time_error", sum.held_out_time_error},
                       {"psd_error", sum.held_out_psd_error}};
  for (std::size_t t = 0; t < file.tests.size(); ++t) {
    const correlation::TireRun& run = comparison.tests[t].tires[tire];
    all["tests"].push_back({{"name", file.tests[t].name},
                            {"fitted", file.tests[t].fitted},
                            {"channels", file.channels},
                            {"time_error", run.time_error},
                            {"psd_error", run.psd_error},
                            {"cpu_over_time", run.cpu_over_time}});
  }
  return all;
}

void compare(const std::string& name,
             const experiment::Language& language,
             const std::string& measurements,
             std::string output,
             int threads) {
  expect_no_pipe(name);
  const bool models = correlation::compares_models(name);
  if (models) say_files(name, {});
  if (threads > 0 && !models)
    throw InputError({name, 0},
                     "compares tires one after the other, so that their times are comparable; "
                     "expected the command without --threads");
  if (output.empty()) output = fs::path(name).replace_extension(".html").string();
  if (models)
    return compare_models(
        name, language, measurements, output, threads > 0 ? threads : kUsualThreads);
  const ComparisonFile file = correlation::read_comparison_file(name, language);
  say_files(name, ledgers_of_recordings(file));
  for (const correlation::ComparedTire& tire : file.tires)
    examine_model(*tire.kind, tire.numbers, tire.file.string());
  if (!measurements.empty()) return write_measurements(file, measurements);
  TireComparison comparison;
  {
    RunningNote progress;
    long done = 0;
    comparison = correlation::compare_tires(file, [&](const std::string& test) {
      progress.update(done++, static_cast<long>(file.tests.size()), test);
    });
  }
  for (const std::string& remark : comparison.remarks) warn(remark, {name, 0});
  for (const std::string& limit : comparison.limits_of_specimen)
    warn("the specimen: " + limit, {name, 0});
  write_text_file(output, comparison_page(file, comparison));
  say("{}\n\n", file.title);
  for (std::size_t t = 0; t < file.tires.size(); ++t) {
    const auto limits = limits_of_tire(file, comparison, t);
    for (const std::string& limit : limits) warn(file.tires[t].title + ": " + limit, {name, 0});
    answer()["tires"].push_back(answer_of_tire(file, comparison, t, limits));
  }
  if (file.specimen) answer()["specimen"] = {{"cpu_over_time", comparison.specimen_cpu_over_time}};
  answer()["verdicts"] = verdicts(file, comparison);
  answer()["report"] = output;
  for (const std::string& sentence : verdicts(file, comparison)) say("{}\n", sentence);
  if (file.specimen)
    say("The specimen: CPU time {:.2g} x real time.\n", comparison.specimen_cpu_over_time);
  say("\nReport: {}\n", output);
}

}  // namespace

void add_compare(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand(
      "compare", "Several tires over the same cleats, beside what was measured: what each can do");
  verb.footer(
      "COMPARISON is a TOML file such as\n"
      "  channels = [\"Fx\", \"Fz\"]\n"
      "  [test.slow]\n"
      "  file = \"slow.toml\"                  a drum test, as latsch test reads it\n"
      "  measurement = \"slow_measured.csv\"   columns time and the channels; or [specimen], a "
      "tire\n"
      "  [tire.rigid_ring]                   as many as there are\n"
      "  kind = \"rigid_ring\"                 ring_tire, rigid_ring, magic_formula\n"
      "  file = \"rigid_ring.tir\"\n\n"
      "or one with a [reference], a [model.NAME] for each of several models of any kind, and "
      "grids\nof tests, whose spectra are compared: studies/kerb/comparison.toml\n\n"
      "Examples:\n  latsch compare studies/tire_model_comparison/comparison.toml\n"
      "  latsch compare studies/kerb/comparison.toml -o kerb.html --json > kerb.json\n"
      "  # The results of the specimen, as tables to which a tire can be fitted.\n"
      "  latsch compare studies/tire_model_comparison/comparison.toml --write-measurements "
      "measured");
  auto file = std::make_shared<std::string>();
  auto measurements = std::make_shared<std::string>();
  auto output = std::make_shared<std::string>();
  verb.add_option("comparison", *file, "Comparison file (TOML)").required();
  verb.add_option("-o,--output", *output, "Page to write (HTML); beside the file unless given")
      .written_as("HTML", {".html", ".htm"});
  verb.add_option("--write-measurements",
                  *measurements,
                  "Write the specimen's results in every test to this folder, and end");
  auto threads = std::make_shared<int>(0);
  verb.add_option("--threads",
                  *threads,
                  "Threads for a comparison of models, 2 unless given; the result is the "
                  "same for any number")
      .between(1, 1024);
  verb.forms({{"writes a page", {}, {"--output", "--threads"}},
              {"writes the results of the specimen and ends", {"--write-measurements"}}});
  verb.callback(
      [=, &program] { compare(*file, program.language, *measurements, *output, *threads); });
}

}  // namespace latsch::cli
