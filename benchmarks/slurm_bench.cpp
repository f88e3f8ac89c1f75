// SPDX-License-Identifier: Apache-2.0
// The program under Slurm on one node: `srun latsch run`, an array job of studies, and killed ranks
// must all give the bits of a single process.
//
//   bench_slurm [REPETITIONS]
//
// The benchmark starts Slurm on separate ports and ends it (one_node_slurm.h; this needs root).
// Every disturbed run is resumed until it ends, and its search path is compared with that of one
// process.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "base/file.h"
#include "base/random.h"
#include "base/scratch_folder_testing.h"
#include "fit_study.h"
#include "killed_study.h"
#include "one_node_slurm.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// number of cores configured in Slurm; most processes sleep, so the machine may have fewer
constexpr int kCores = 8;
constexpr int kRanks = 4;    // ranks of a job, including the master
constexpr int kStudies = 4;  // number of studies in the array job, each on two ranks
constexpr double kPause = 0.05;
// s, longest allowed time from a disturbance to the end of the job
constexpr double kLongest = 30.0;

std::string srun(const std::string& verb, const fs::path& study, const std::string& options) {
  return fmt::format(
      "timeout 300 srun {} {} {} {}", options, program().string(), verb, study.string());
}

/// Writes a study for the array job. Each number has another start point.
fs::path write_study_of_array(const fs::path& folder, int number) {
  fs::create_directories(folder);
  const fs::path study = write_small_study(folder, kPause);
  std::string text = read_text_file(study);
  const std::string was = "initial = 0.9";
  text.replace(text.find(was), was.size(), fmt::format("initial = {}", 0.9 - 0.1 * number));
  write_text_file(study, text);
  return study;
}

/// Returns the search path of one process on a copy of the study.
std::string undisturbed(const fs::path& study) {
  const ScratchFolder folder;
  fs::copy(study.parent_path(), folder.path(), fs::copy_options::recursive);
  const fs::path copy = folder / study.filename();
  if (end_of(start_latsch("run", copy, 1)) != 0) throw std::runtime_error("the study fails");
  return trajectory(correlation::read_study(copy, experiment::language()));
}

/// Kills `latsch run` with kill -9 on the given task of the step that runs the study.
void kill_task(const fs::path& study, int task) {
  for (const pid_t pid : processes_with(study.string())) {
    const fs::path process = fs::path("/proc") / std::to_string(pid);
    const auto read = [&](const char* name) {
      std::ifstream file(process / name, std::ios::binary);
      std::string all, part;
      while (std::getline(file, part, '\0')) all += part + '\0';
      return all;
    };
    const std::string line = read("cmdline"), wanted = fmt::format("SLURM_PROCID={}", task) + '\0';
    if (!line.starts_with(program().string()) || line.find(std::string("\0run\0", 5)) == line.npos)
      continue;
    if (read("environ").find(wanted) != std::string::npos) {
      ::kill(pid, SIGKILL);
      return;
    }
  }
  throw std::runtime_error(fmt::format("the step has no task {}", task));
}

/// Counts the processes that were started with the settings of this Slurm or whose command line
/// contains its folder.
long processes_of(const fs::path& folder) {
  long count = 0;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::string text;
    for (const char* name : {"cmdline", "environ"}) {
      std::ifstream file(entry.path() / name, std::ios::binary);
      std::string part;
      while (std::getline(file, part, '\0')) text += part + '\0';
    }
    count += entry.path().filename() != std::to_string(::getpid()) &&
             text.find(folder.string()) != std::string::npos;
  }
  return count;
}

void plain(Table& table, const std::string& reference) {
  const ScratchFolder folder;
  const fs::path file = write_small_study(folder.path(), 0.0);
  const Said said = said_by(srun("run", file, fmt::format("-n {}", kRanks)));
  const bool same = trajectory(correlation::read_study(file, experiment::language())) == reference;
  table.row(fmt::format("srun -n {} latsch run", kRanks),
            said.exit_code != 0 ? said.text
            : same              ? "same bits"
                                : "other bits",
            "same bits as one process",
            said.exit_code == 0 && same);
}

/// Without PMIx the tasks do not form one MPI job, so the program has to refuse to run.
void refused(Table& table) {
  for (const char* kind : {"none", "pmi2"}) {
    const ScratchFolder folder;
    const fs::path file = write_small_study(folder.path(), 0.0);
    const Said said = said_by(srun("run", file, fmt::format("-n 3 --mpi={}", kind)));
    const auto first = said.text.find("srun --mpi=pmix latsch run");
    const bool once = first != said.text.npos &&
                      said.text.find("srun --mpi=pmix latsch run", first + 1) == said.text.npos;
    const bool untouched =
        !fs::exists(correlation::read_study(file, experiment::language()).run.journal);
    table.row(fmt::format("srun --mpi={}: refused, the command that works", kind),
              fmt::format("{}, {}",
                          once ? "named once" : "not named once",
                          untouched ? "no journal" : "a journal"),
              "named once, no journal",
              said.exit_code != 0 && once && untouched);
  }
}

struct Counts {
  int histories = 0, finished = 0, same_bits = 0;
  long lost = 0, repeated = 0, left = 0;
  double longest = 0.0;  // s, from the fault to the end of the job
};

/// Runs the study in a Slurm step, kills one of its tasks after `trials` trials, and resumes the
/// run.
void live_through(int task, long trials, const std::string& reference, Counts& counts) {
  const ScratchFolder folder;
  const fs::path file = write_small_study(folder.path(), kPause);
  const correlation::Study study = correlation::read_study(file, experiment::language());
  Said said;
  std::thread job([&] { said = said_by(srun("run", file, fmt::format("-n {}", kRanks))); });
  std::vector<Trial> before;
  Clock::time_point struck;
  try {
    wait_for_trials(study, trials);
    before = Journal::read(study.run.journal).trials();
    struck = Clock::now();
    kill_task(file, task);
  } catch (...) {
    job.join();
    throw;
  }
  job.join();
  ++counts.histories;
  counts.finished += said.exit_code == 0;
  counts.longest =
      std::max(counts.longest, std::chrono::duration<double>(Clock::now() - struck).count());
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // time to end the processes
  counts.left += std::ssize(processes_with(folder.path().string()));
  const Said resumed = said_by(srun("resume", file, fmt::format("-n {}", kRanks)));
  if (resumed.exit_code != 0) throw std::runtime_error("resume failed: " + resumed.text);
  const std::vector<Trial> after = trials_of(study);
  counts.lost += count_lost(before, after);
  counts.repeated += count_repeated(after);
  counts.same_bits += trajectory(study) == reference;
}

void report(Table& table, const std::string& fault, const Counts& counts) {
  table.note(fault + ": the job itself finishes",
             fmt::format("{} of {}", counts.finished, counts.histories));
  table.row(fault + ": end of the job after, at most",
            fmt::format("{:.1f} s", counts.longest),
            fmt::format("<= {:.0f} s", kLongest),
            counts.longest <= kLongest);
  table.row(fault + ": trials lost, repeated",
            fmt::format("{}, {}", counts.lost, counts.repeated),
            "0, 0",
            counts.lost == 0 && counts.repeated == 0);
  table.row(
      fault + ": processes left running", fmt::format("{}", counts.left), "0", counts.left == 0);
  table.row(fault + ": result, resumed",
            fmt::format("same bits {} of {}", counts.same_bits, counts.histories),
            "all",
            counts.same_bits == counts.histories);
}

/// Runs an array job of studies, each on two ranks; kills a rank in two of them, then resumes all.
void array(Table& table) {
  const ScratchFolder folder;
  std::vector<fs::path> files;
  std::vector<correlation::Study> studies;
  for (int i = 0; i < kStudies; ++i) {
    files.push_back(write_study_of_array(folder / std::to_string(i), i));
    studies.push_back(correlation::read_study(files.back(), experiment::language()));
  }
  const std::string command = fmt::format(
      "timeout 300 sbatch --wait --array=0-{} -n 2 --output=/dev/null --wrap 'srun {} run "
      "{}/$SLURM_ARRAY_TASK_ID/study.toml'",
      kStudies - 1,
      program().string(),
      folder.path().string());
  std::thread job([&] { (void)said_by(command); });
  std::vector<std::vector<Trial>> before(kStudies);
  try {
    for (const int i : {1, 2}) {
      wait_for_trials(studies[i], 5);
      before[i] = Journal::read(studies[i].run.journal).trials();
      kill_task(files[i], i - 1);  // a worker rank in one study, the master in another
    }
  } catch (...) {
    job.join();
    throw;
  }
  job.join();
  const int ended = said_by(command).exit_code;
  long lost = 0, repeated = 0;
  int same = 0;
  for (int i = 0; i < kStudies; ++i) {
    const std::vector<Trial> after = trials_of(studies[i]);
    lost += count_lost(before[i], after);
    repeated += count_repeated(after);
    same += trajectory(studies[i]) == undisturbed(files[i]);
  }
  table.row(fmt::format("array of {} studies, ranks killed in two, run again", kStudies),
            fmt::format("exit code {}", ended),
            "0",
            ended == 0);
  table.row("array: trials lost, repeated",
            fmt::format("{}, {}", lost, repeated),
            "0, 0",
            lost == 0 && repeated == 0);
  table.row(
      "array: result", fmt::format("same bits {} of {}", same, kStudies), "all", same == kStudies);
}

int run(const Options& options) {
  const long repetitions = options.integer("REPETITIONS", options.size(3, 1));
  Table table("slurm", options);
  if (const auto missing = OneNodeSlurm::missing()) {
    table.skip("Slurm: slurmctld, slurmd, munged, Open MPI, and root", *missing);
    return table.exit_code();
  }
  const ScratchFolder folder;
  {
    const OneNodeSlurm slurm(folder / "slurm", kCores);
    std::string reference;
    {
      const ScratchFolder alone;
      reference = undisturbed(write_small_study(alone.path(), 0.0));
    }
    plain(table, reference);
    refused(table);
    std::vector<int> tasks{1, 0};
    tasks.resize(options.size(tasks.size(), std::size_t{1}));
    for (const int task : tasks) {
      Counts counts;
      for (long i = 0; i < repetitions; ++i) {
        RandomStream random(1, static_cast<std::uint64_t>(i));
        live_through(task, 1 + static_cast<long>(random.below(25)), reference, counts);
      }
      report(table, task == 0 ? "rank that leads killed" : "rank killed", counts);
    }
    if (!options.is_smoke()) array(table);  // takes half a minute, because Slurm acts at intervals
  }
  const long left = processes_of(folder.path());
  table.row("processes left of Slurm", fmt::format("{}", left), "0", left == 0);
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(
      argc, argv, {{"REPETITIONS", "", "of every fault"}}, latsch::benchmarks::run);
}
