// SPDX-License-Identifier: Apache-2.0
// Checks that a study gives the same bits with 1, 2 and 4 workers and after up to 100 kills by kill
// -9, and that no trial is lost or repeated. Two studies are fitted by the program itself:
// undisturbed with one, two and four workers, and then killed at random moments and resumed until
// they end. One study is a coarse tire with trials of some tenths of a second. The other runs an
// outside program that takes milliseconds, so that many kills hit the write of a result to the
// journal.
#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "base/file.h"
#include "base/random.h"
#include "base/scratch_folder_testing.h"
#include "coarse_mesh.h"
#include "correlation/study/study.h"
#include "killed_study.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

namespace fs = std::filesystem;
using Seconds = std::chrono::duration<double>;

constexpr std::uint64_t kSeed = 1;

// The coarse mesh makes a trial short, because the identified values are not judged. The benchmark
// appends a step tolerance to this text.
constexpr const char* kStudy = R"(title = "A coarse tire B, to be killed"
model = "tire.toml"
[variable.matrix]
path = "rubber.matrix.young_modulus"
lower = "4 N/mm^2"
upper = "50 N/mm^2"
initial = "25 N/mm^2"
scale = "logarithmic"
[variable.carcass]
path = "layer.carcass.young_modulus"
lower = "60 N/mm^2"
upper = "2000 N/mm^2"
initial = "180 N/mm^2"
scale = "logarithmic"
[experiment.stiffness]
kind = "load_deflection"
pressure = "2.6 bar"
measurement = "stiffness.csv"
deflections = {unit = "mm", values = [5, 10]}
[run]
intervals = false
[optimizer]
method = "gss"
)";

constexpr const char* kMeasurement = "deflection [mm],force [N]\n5,900\n10,2000\n";

fs::path write_tire_study(const fs::path& folder, const CoarseMesh& mesh, double step_tolerance) {
  const fs::path tire = fs::path(LATSCH_SOURCE_DIR) / "studies/tires/passenger_225_50R16.toml";
  write_text_file(folder / "tire.toml", with_coarse_mesh(read_text_file(tire), mesh));
  write_text_file(folder / "stiffness.csv", kMeasurement);
  write_text_file(folder / "study.toml",
                  fmt::format("{}step_tolerance = {}\n", kStudy, step_tolerance));
  return folder / "study.toml";
}

/// Kills the process after `time`. Returns false if it had ended before.
bool kill_after(pid_t child, Seconds time) {
  std::this_thread::sleep_for(time);
  ::kill(child, SIGKILL);
  return end_of(child) == -1;
}

struct Prey {
  std::string name;
  std::function<fs::path(const fs::path& folder)> write;
  int kills;
  double longest;  // latest time of a kill, relative to the undisturbed run
};

std::string undisturbed(const Prey& prey, int workers) {
  const ScratchFolder folder;
  const fs::path file = prey.write(folder.path());
  if (end_of(start_latsch("run", file, workers)) != 0) return {};
  return trajectory(correlation::read_study(file, experiment::language()));
}

struct Killed {
  int kills = 0;
  long finished_before_a_kill = 0;
  long lost = 0;
  long repeated = 0;
  int left_running = 0;
  bool same_bits = true;
};

/// Returns the number of workers of the study in `folder` that are still running after the run has
/// ended. A busy system gets some seconds to end them.
int left_running(const fs::path& folder) {
  constexpr Seconds kPatience{2.0};
  const auto give_up = std::chrono::steady_clock::now() + kPatience;
  std::size_t left = processes_with(folder.string()).size();
  while (left > 0 && std::chrono::steady_clock::now() < give_up) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    left = processes_with(folder.string()).size();
  }
  return static_cast<int>(left);
}

/// Runs one study and kills it until it ends or has been killed often enough, then resumes it to
/// its end.
void kill_and_resume(const Prey& prey,
                     Seconds longest,
                     RandomStream& random,
                     const std::string& reference,
                     Killed& killed) {
  const ScratchFolder folder;
  const fs::path file = prey.write(folder.path());
  const correlation::Study study = correlation::read_study(file, experiment::language());
  std::vector<Trial> before;
  for (bool ended = false; !ended;) {
    const bool resuming = fs::exists(study.run.journal);
    const pid_t child = start_latsch(resuming ? "resume" : "run", file, 2);
    if (killed.kills < prey.kills && kill_after(child, random.uniform() * longest)) {
      ++killed.kills;
    } else {
      ended = true;
      if (killed.kills >= prey.kills && end_of(child) != 0)
        throw std::runtime_error("resume failed");
    }
    killed.left_running += left_running(folder.path());
    const std::vector<Trial> after = trials_of(study);
    killed.finished_before_a_kill += ended ? 0 : std::ssize(after) - std::ssize(before);
    killed.lost += count_lost(before, after);
    before = after;
  }
  killed.repeated += count_repeated(before);
  killed.same_bits = killed.same_bits && trajectory(study) == reference;
}

void report(Table& table, const Prey& prey, const Killed& killed) {
  table.row(prey.name + ": kill -9 at random moments",
            fmt::format("{}", killed.kills),
            fmt::format(">= {}", prey.kills),
            killed.kills >= prey.kills);
  table.note("trials finished before a kill", fmt::format("{}", killed.finished_before_a_kill));
  table.row("finished trials lost", fmt::format("{}", killed.lost), "0", killed.lost == 0);
  table.row(
      "finished trials repeated", fmt::format("{}", killed.repeated), "0", killed.repeated == 0);
  table.row("workers left running",
            fmt::format("{}", killed.left_running),
            "0",
            killed.left_running == 0);
  table.row("result after kills and resumes",
            killed.same_bits ? "same bits" : "differs",
            "same bits",
            killed.same_bits);
}

void hunt(Table& table, const Prey& prey, const std::vector<int>& workers_beside_one) {
  const auto begin = std::chrono::steady_clock::now();
  const std::string reference = undisturbed(prey, 1);
  const Seconds time = std::chrono::steady_clock::now() - begin;
  table.row(prey.name + ": one worker",
            fmt::format("{:.1f} s", time.count()),
            "converged",
            !reference.empty());
  if (reference.empty()) return;
  for (const int workers : workers_beside_one) {
    const bool same = undisturbed(prey, workers) == reference;
    table.row(
        fmt::format("{} workers", workers), same ? "same bits" : "differs", "same bits", same);
  }
  RandomStream random(kSeed, 0);
  Killed killed;
  while (killed.kills < prey.kills) {
    kill_and_resume(prey, prey.longest * time, random, reference, killed);
  }
  report(table, prey, killed);
}

int run(const Options& options) {
  Table table("crash", options);
  const std::vector<int> workers = options.size(std::vector<int>{2, 4}, std::vector<int>{2});
  const auto write_tire = [&](const fs::path& folder) {
    return write_tire_study(
        folder, options.size(CoarseMesh{13, 24}, CoarseMesh{13, 12}), options.size(0.02, 0.05));
  };
  hunt(table, {"coarse tire", write_tire, options.size(20, 2), 0.2}, workers);
  const auto write_fast_study = [](const fs::path& folder) {
    return write_small_study(folder, 0.0);
  };
  hunt(table, {"fast program", write_fast_study, options.size(80, 3), 0.5}, workers);
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::run);
}
