// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/comparison/compared_models.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "cli/console/console.h"
#include "cli/console/implausible.h"
#include "cli/run/virtual_recordings.h"
#include "correlation/comparison/comparison_effects.h"
#include "correlation/comparison/model_comparison_page.h"
#include "correlation/laboratory/virtual_recording.h"
#include "formats/tables/csv_table.h"

namespace latsch::cli {
namespace {

using correlation::ModelComparison;
using correlation::ModelComparisonFile;

/// Writes the recording of a case by the reference, rounded to the resolution of sensors.
void write_recording(const ModelComparisonFile& file,
                     std::size_t i,
                     const experiment::Language& language,
                     const std::filesystem::path& folder) {
  Channels rounded;
  std::vector<std::string> limits;
  const Channels all =
      correlation::kept_of(file, correlation::record_reference(file, i, language, &limits));
  for (const std::string& limit : limits)
    warn(fmt::format("{}: {} ({})", file.reference.title, limit, file.cases[i].name),
         {file.file.string(), 0});
  for (Channel channel : all.all()) {
    const double digits = channel.unit == "N" ? 1.0 : 1e4;  // inverse resolution of the sensors
    for (double& value : channel.values) value = std::round(value * digits) / digits;
    rounded.add(std::move(channel));
  }
  const auto to = folder / (file.cases[i].name + ".csv");
  write_text_file(
      to,
      correlation::recording_text(fmt::format("{} in {}", file.reference.title, file.cases[i].name),
                                  correlation::recipe_of_case(file, i, language),
                                  formats::csv_text(rounded)));
  say_written(to.string());
}

void write_recordings(const ModelComparisonFile& file,
                      const experiment::Language& language,
                      const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (std::size_t i = 0; i < file.cases.size(); ++i)
    if (correlation::is_recorded_here(file, i)) write_recording(file, i, language, folder);
}

Json json_of(const correlation::FactorialEffects& effects) {
  return {{"distance", effects.distance},
          {"first", effects.first},
          {"second", effects.second},
          {"interaction", effects.interaction},
          {"first_is_larger", effects.first_is_larger}};
}

Json json_of(const ModelComparisonFile& file, const ModelComparison& comparison, std::size_t i) {
  const auto& compared = comparison.cases[i];
  Json one = {{"name", file.cases[i].name},
              {"what", file.cases[i].in_words},
              {"mark", file.cases[i].mark},
              {"frequency", compared.reference[0].frequency}};
  for (std::size_t c = 0; c < file.channels.size(); ++c)
    one["reference"][file.channels[c]] = compared.reference[c].value;
  for (std::size_t m = 0; m < file.models.size(); ++m) {
    const auto& run = compared.models[m];
    Json& model = one["models"][file.models[m].name];
    for (std::size_t b = 0; b < file.bands.size(); ++b) {
      model["distance"][file.bands[b].name] = run.mean_distance(b);
      model["decibels"][file.bands[b].name] = run.mean_decibels(b);
    }
    model["coverage"] = run.coverage;
    model["reach"] = run.reach;
    model["cpu"] = run.cpu;
    for (std::size_t k = 0; k < file.told.size(); ++k)
      if (std::isfinite(run.told[k])) model["told"][file.told[k]] = run.told[k];
    for (std::size_t c = 0; c < file.channels.size(); ++c) {
      Json& channel = model["channels"][file.channels[c]];
      channel["density"] = run.densities[c].value;
      if (run.lower.empty()) continue;
      channel["lower"] = run.lower[c];
      channel["upper"] = run.upper[c];
    }
  }
  return one;
}

}  // namespace

void record_reference(const std::string& name, const experiment::Language& language) {
  const ModelComparisonFile file = correlation::read_model_comparison(name, language);
  if (!file.is_virtual) return;
  for (std::size_t i = 0; i < file.cases.size(); ++i) {
    if (!correlation::is_recorded_here(file, i)) continue;
    const auto recording = correlation::recording_file(file, i);
    const std::string why =
        correlation::why_to_record(recording, correlation::recipe_of_case(file, i, language));
    if (!begin_recording(
            recording, fmt::format("{} of {}", file.cases[i].name, file.reference.title), why))
      continue;
    std::filesystem::create_directories(file.recordings);
    write_recording(file, i, language, file.recordings);
  }
}

void compare_models(const std::string& name,
                    const experiment::Language& language,
                    const std::filesystem::path& measurements,
                    const std::string& output,
                    int threads) {
  const ModelComparisonFile file = correlation::read_model_comparison(name, language);
  for (const correlation::ComparedModel& model : file.models)
    examine_model(*model.kind, model.numbers, model.numbers.file());
  if (!measurements.empty()) return write_recordings(file, language, measurements);
  ModelComparison comparison;
  {
    RunningNote progress;
    comparison =
        correlation::compare_models(file, language, std::max(1, threads), [&](long done, long all) {
          progress.update(done, all, "runs");
        });
  }
  const auto limits = limits_of_models(file, comparison);
  for (const std::string& limit : limits) warn(limit, {name, 0});
  write_text_file(output, model_comparison_page(file, comparison));
  say("{}\n\n", file.title);
  for (std::size_t i = 0; i < file.cases.size(); ++i)
    answer()["cases"].push_back(json_of(file, comparison, i));
  for (const auto& fit : comparison.fits)
    answer()["fits"].push_back({{"name", fit.name},
                                {"excess", fit.excess},
                                {"held_out", fit.held_out},
                                {"frequency", fit.discrepancy.frequency},
                                {"discrepancy", fit.discrepancy.deviation},
                                {"remarks", fit.remarks}});
  answer()["bands"] = bands_in_words(file);
  if (!file.factors.empty())
    for (std::size_t b = 0; b < file.bands.size(); ++b)
      answer()["factorial"][file.bands[b].name] =
          json_of(mean_effects(file, comparison, all_cases(file), b, false));
  for (const auto& one : sensitivities(file, comparison)) {
    Json ranges;
    for (std::size_t m = 0; m < file.models.size(); ++m) ranges[file.models[m].name] = one.range(m);
    answer()["sensitivity"].push_back({{"test", file.tests[one.test].name},
                                       {"over", file.tests[one.test].varied[one.varied].path},
                                       {"range", ranges}});
  }
  answer()["limits"] = limits;
  answer()["findings"] = findings(file, comparison);
  answer()["report"] = output;
  for (const std::string& sentence : findings(file, comparison)) say("{}\n", sentence);
  say("\nReport: {}\n", output);
}

}  // namespace latsch::cli
