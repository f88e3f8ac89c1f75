// SPDX-License-Identifier: Apache-2.0
// The end of the chain from the description of a tire to a car on a kerb: the push-rod forces of a
// car on four reduced finite-element tires beside those on four full ones, over one passage of the
// exit kerb (studies/fe_kerb). The passage on full tires is the recording of that study, which
// belongs to its tire and its test by its recipe; the car on reduced tires is driven here.
//
// With --smoke both cars are driven for some milliseconds on a mesh of few elements.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "correlation/comparison/comparison_effects.h"
#include "correlation/comparison/model_comparison.h"
#include "cpu_time.h"
#include "table.h"

namespace {

using namespace latsch;
namespace fs = std::filesystem;

const fs::path kStudies = fs::path(LATSCH_SOURCE_DIR) / "studies";
/// Greatest accepted distance of the spectra.
constexpr double kAsked = 0.10;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw InputError("the study has no " + from);
  return text.replace(at, from.size(), to);
}

/// Copies the study into a folder with a mesh of few elements, a passage of some milliseconds and a
/// reference that is driven.
fs::path small_study(const fs::path& folder) {
  for (const char* name : {"fe_kerb", "kerb"}) {
    fs::create_directories(folder / name);
    for (const auto& one : fs::directory_iterator(kStudies / name))
      if (one.path().extension() == ".toml")
        fs::copy_file(one.path(), folder / name / one.path().filename());
  }
  const fs::path study = folder / "fe_kerb";
  fs::create_directories(study / "tests");
  for (const char* name : {"tire.toml", "tire_reduced.toml"}) {
    std::string text = read_text_file(study / name);
    const auto begin = text.find("columns = "), end = text.find("rows_inside");
    text.replace(begin, end - begin, "columns = [0, 0.33, 0.54, 0.58, 0.76, 0.9, 1]\n");
    text = replaced(text, "sectors = 44", "sectors = 24");
    text = replaced(text, "sector_zones = [[6, \"4 deg\"], [2, \"6 deg\"]]\n", "");
    while (text.find("loss_factor = 0.15\n") != std::string::npos)  // elastic: found sooner
      text = replaced(text, "loss_factor = 0.15\n", "");
    if (text.find("\"200 Hz\"") != std::string::npos)
      text = replaced(text, "\"200 Hz\"", "\"50 Hz\"");
    write_text_file(study / name, text);
  }
  const std::string test = read_text_file(kStudies / "fe_kerb/tests/passage.toml");
  write_text_file(study / "tests/passage.toml",
                  replaced(replaced(test, "duration = \"0.15 s\"", "duration = \"8 ms\""),
                           "sample_step = \"1 ms\"",
                           "sample_step = \"0.5 ms\""));
  std::string text = read_text_file(study / "reduced.toml");
  text = replaced(text, "recordings = \"measured\"", "");
  text = replaced(text, "virtual = true", "");
  text = replaced(text, "segment = \"0.15 s\"", "segment = \"8 ms\"");
  text = replaced(text, "[\"6 Hz\", \"150 Hz\"]", "[\"100 Hz\", \"400 Hz\"]");
  write_text_file(study / "reduced.toml", text);
  return study / "reduced.toml";
}

/// Returns the root mean square of a difference over that of the reference about its mean.
double time_error(const std::vector<double>& values, const std::vector<double>& reference) {
  double mean = 0.0, square = 0.0, difference = 0.0;
  for (const double value : reference) mean += value / static_cast<double>(reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i) {
    square += std::pow(reference[i] - mean, 2);
    difference += std::pow(values[i] - reference[i], 2);
  }
  return std::sqrt(difference / square);
}

int run(const benchmarks::Options& options) {
  benchmarks::Table table("chain", options);
  const ScratchFolder scratch;
  const fs::path file =
      options.is_smoke() ? small_study(scratch.path()) : kStudies / "fe_kerb/reduced.toml";
  const auto comparison = correlation::read_model_comparison(file, experiment::language());
  const double begin = benchmarks::cpu_seconds();
  const auto found = correlation::compare_models(comparison, experiment::language(), 1);
  const double seconds = benchmarks::cpu_seconds() - begin;
  const auto& reference = found.cases.at(0);
  const correlation::ModelRun& reduced = reference.models.at(0);
  for (std::size_t c = 0; c < comparison.channels.size(); ++c) {
    table.note(comparison.channels[c] + ": PSD distance to full tires",
               fmt::format("{:.1f} %", 1e2 * reduced.distance[0][c]));
    table.note(comparison.channels[c] + ": error in time about the mean",
               fmt::format("{:.1f} %", 1e2 * time_error(reduced.samples[c], reference.samples[c])));
  }
  const double mean = reduced.mean_distance(0);
  table.full_row("push-rod PSD on reduced tires beside full ones, mean of four",
                 fmt::format("{:.1f} %", 1e2 * mean),
                 fmt::format("<= {:.0f} %", 1e2 * kAsked),
                 mean <= kAsked);
  table.row("a density is known of every push-rod",
            fmt::format("{}", reduced.distance[0].size()),
            "4, finite",
            reduced.distance[0].size() == 4 && std::isfinite(mean));
  table.note("processor time of the car on reduced tires", fmt::format("{:.0f} s", reduced.cpu));
  table.note("processor time of all", fmt::format("{:.0f} s", seconds));
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) { return benchmarks::run_benchmark(argc, argv, {}, run); }
