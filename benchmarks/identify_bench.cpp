// SPDX-License-Identifier: Apache-2.0
// `latsch identify` of a study with 31 variables: size of its journal, time, and the work lost by a
// kill -9 in the middle. The study is studies/race_tire_mf with nine further coefficients. Its
// trials return the derivatives of 2,400 residuals, so one trial takes a third of a megabyte in the
// journal, and profiles take thousands of trials.
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "command.h"
#include "correlation/analysis/refit_trials.h"
#include "evaluation/journal/journal.h"
#include "evaluation/trial/encoding.h"
#include "killed_study.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMore =
    "vary = [\"PHY2\", \"PVY2\", \"PVY3\", \"PKY3\", \"PKY7\", \"PVY4\", \"PPY5\", \"QHZ1\", "
    "\"QBZ2\"]\n";

/// Writes the study with every n-th state (`every`); `is_whole` adds the nine further coefficients.
void write_study(const fs::path& folder, long every, bool is_whole) {
  const fs::path from = fs::path(LATSCH_SOURCE_DIR) / "studies" / "race_tire_mf";
  fs::create_directories(folder);
  fs::copy_file(from / "tire.tir", folder / "tire.tir");
  write_text_file(folder / "study.toml",
                  (is_whole ? kMore : "") + read_text_file(from / "study.toml"));
  std::istringstream all(read_text_file(from / "cornering.csv"));
  std::ofstream some(folder / "cornering.csv");
  long row = -1;  // the header line is not counted
  for (std::string line; std::getline(all, line);)
    if (line.starts_with('#') || row++ % every == 0 || row == 0) some << line << '\n';
}

std::string program() {
  return (fs::read_symlink("/proc/self/exe").parent_path() / "latsch").string();
}

/// Result of a command of the program `latsch`: its JSON output, its progress output and its
/// duration.
struct Done {
  nlohmann::json answer;
  std::string progress;
  double seconds;
};

Done done(const std::string& verb, const fs::path& folder, int workers) {
  const auto begin = std::chrono::steady_clock::now();
  const Printed printed = run_command(fmt::format(
      "{} {} {} --workers {} --json", program(), verb, (folder / "study.toml").string(), workers));
  return {nlohmann::json::parse(printed.output),
          printed.errors,
          std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()};
}

double megabytes(const fs::path& folder) {
  double bytes = 0.0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) bytes += static_cast<double>(entry.file_size());
  return 1e-6 * bytes;
}

/// Reads the journal and the file of the refits; a missing file has no trials.
std::vector<Trial> all_trials(const fs::path& folder) {
  std::vector<Trial> all;
  for (const fs::path& file :
       {folder / "study.latsch", correlation::RefitTrials::file(folder / "study.latsch")}) {
    if (!fs::exists(file)) continue;
    const auto some = Journal::read(file).trials();
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

/// Returns the bits of a trial's design point and outcome, without its computing times.
std::string bits_of(const Trial& trial) {
  std::string bits = trial.point.bits();
  return trial.outcome.result ? bits + encode(*trial.outcome.result)
                              : bits + trial.outcome.result.failure().reason;
}

/// Starts the identification and kills it when this number of refits is stored.
void kill_at(const fs::path& folder, long refits, int workers) {
  const pid_t child = start_latsch("identify", folder / "study.toml", workers);
  const fs::path file = correlation::RefitTrials::file(folder / "study.latsch");
  for (int turn = 0; turn < 600'000; ++turn) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    try {
      if (fs::exists(file) && Journal::read(file).size() >= refits) break;
    } catch (const std::exception&) {  // file incomplete
    }
    if (::waitpid(child, nullptr, WNOHANG) == child)
      throw std::runtime_error("the identification ended before it was killed");
  }
  ::kill(child, SIGKILL);
  (void)end_of(child);
}

int bench(const Options& options) {
  Table table("identify", options);
  const ScratchFolder scratch;
  const fs::path fitted = scratch / "fitted";
  write_study(fitted, options.size(1L, 60L), !options.is_smoke());
  (void)done("run", fitted, 2);
  const fs::path whole = scratch / "whole";
  fs::copy(fitted, whole);
  const Done reference = done("identify", whole, options.size(2, 1));
  const double size = megabytes(whole) - megabytes(fitted);
  const auto refits = Journal::read(correlation::RefitTrials::file(whole / "study.latsch")).size();
  table.note("variables", fmt::format("{}", reference.answer["result"]["variables"].size()));
  table.note("trials of refits", fmt::format("{}", refits));
  table.row("written", fmt::format("{:.1f} MB", size), "<= 50 MB", size <= 50.0);
  table.full_row("time, on two workers",
                 fmt::format("{:.0f} s", reference.seconds),
                 "<= 300 s",
                 reference.seconds <= 300.0);
  const bool foretold = reference.progress.find(" left, ") != std::string::npos;
  table.full_row("says how long it will take", foretold ? "yes" : "no", "yes", foretold);

  long lost = 0, repeated = 0;
  bool is_same = true;
  for (const int workers : {1, 2}) {
    if (options.is_smoke() && workers == 1) continue;  // the reference run had one worker
    const fs::path killed = scratch / fmt::format("killed_{}", workers);
    fs::copy(fitted, killed);
    std::set<std::string> kept;
    for (long share = 1; share <= options.size(2L, 1L); ++share) {
      kill_at(killed, share * refits / 3, workers);
      for (const Trial& trial : all_trials(killed)) kept.insert(bits_of(trial));
    }
    const Done resumed = done("identify", killed, workers);
    std::set<std::string> in_the_end;
    for (const Trial& trial : all_trials(killed))
      repeated += !in_the_end.insert(bits_of(trial)).second;
    for (const std::string& bits : kept) lost += !in_the_end.contains(bits);
    for (const char* of : {"variables", "bands", "missed", "target"})
      is_same = is_same && resumed.answer["result"][of] == reference.answer["result"][of];
  }
  table.row("acknowledged trials lost by kills", fmt::format("{}", lost), "0", lost == 0);
  table.row("trials kept twice", fmt::format("{}", repeated), "0", repeated == 0);
  table.row("results of 1 and 2 workers after kills",
            is_same ? "the same bits" : "differ",
            "the same bits",
            is_same);
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::bench);
}
