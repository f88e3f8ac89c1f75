// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/comparison/checked_comparison.h"

#include <fmt/ranges.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/console/console.h"
#include "cli/console/implausible.h"
#include "correlation/comparison/model_comparison.h"
#include "correlation/comparison/model_comparison_file.h"
#include "correlation/laboratory/virtual_recording.h"

namespace latsch::cli {
namespace {

using correlation::ComparedModel;
using correlation::ModelComparisonFile;

void print_models(const ModelComparisonFile& file) {
  say("\nModels\n");
  for (const ComparedModel& model : file.models) {
    std::vector<std::string> fits;
    for (const std::size_t k : model.fits) fits.push_back(file.fits[k].name);
    say("  {:<16} {}, {}{}\n",
        model.name,
        model.title,
        model.numbers.file(),
        fits.empty() ? "" : fmt::format("; its numbers from fit {}", fmt::join(fits, ", ")));
    answer()["models"].push_back(
        {{"name", model.name}, {"file", model.numbers.file()}, {"fits", fits}});
  }
}

void print_fits(const ModelComparisonFile& file) {
  if (!file.fits.empty()) say("\nFits\n");
  for (const correlation::FitSource& fit : file.fits) {
    const bool has_trials = std::filesystem::exists(fit.study->run.journal);
    say("  {:<16} {}, {}\n",
        fit.name,
        fit.study->file.string(),
        has_trials ? "has trials" : "has no trials yet");
    answer()["fits"].push_back(
        {{"name", fit.name}, {"study", fit.study->file.string()}, {"has_trials", has_trials}});
  }
}

/// Returns a clause that says where the reference's channels of a case come from.
std::string source_in_words(const ModelComparisonFile& file,
                            std::size_t i,
                            const experiment::Language& language) {
  if (file.recordings.empty()) return "the reference is simulated";
  const std::size_t source = file.find_case(file.cases[i].recording);
  const std::string recording = correlation::recording_file(file, source).string();
  if (!file.is_virtual)
    return recording + (std::filesystem::exists(recording) ? "" : ", which does not exist");
  const std::string why =
      correlation::why_to_record(recording, correlation::recipe_of_case(file, source, language));
  return recording + (why.empty() ? ", up to date" : ", which latsch run records, because " + why);
}

}  // namespace

void check_comparison(const std::string& name, const experiment::Language& language) {
  const ModelComparisonFile file = correlation::read_model_comparison(name, language);
  examine_model(*file.reference.kind, file.reference.numbers, file.reference.numbers.file());
  for (const ComparedModel& model : file.models)
    examine_model(*model.kind, model.numbers, model.numbers.file());
  answer() = {{"title", file.title}, {"channels", file.channels}};
  say("{}\n\nCompares {} of {} with those of the reference, {} ({})\n",
      file.title,
      fmt::join(file.channels, ", "),
      file.models.size() == 1 ? "a model" : fmt::format("{} models", file.models.size()),
      file.reference.title,
      file.reference.numbers.file());
  print_models(file);
  print_fits(file);
  say("\nCases\n");
  for (std::size_t i = 0; i < file.cases.size(); ++i) {
    const std::string source = source_in_words(file, i, language);
    say("  {:<16} {}{}\n",
        file.cases[i].name,
        file.cases[i].in_words.empty() ? "" : file.cases[i].in_words + "; ",
        source);
    answer()["cases"].push_back({{"name", file.cases[i].name}, {"reference", source}});
  }
}

}  // namespace latsch::cli
