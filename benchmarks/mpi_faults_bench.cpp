// SPDX-License-Identifier: Apache-2.0
// Ranks of an MPI job are killed, throw an exception or lose their master. The job must not hang,
// and no finished trial may be lost.
//
//   bench_mpi_faults [REPETITIONS]          recovery on: with mpirun --enable-recovery
//
// The program itself runs under mpirun on a small study and is disturbed after a random number of
// trials. Every disturbed job is resumed until it ends, and its search path is compared with an
// undisturbed one.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <optional>
#include <stdexcept>
#include <thread>

#include "base/file.h"
#include "base/random.h"
#include "base/scratch_folder_testing.h"
#include "fit_study.h"
#include "killed_study.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kRanks = 4;  // including the master
constexpr double kPause = 0.05;
// s, longest allowed time from a disturbance to the end of the job
constexpr double kLongest = 30.0;

enum class Recovery { off, on };

pid_t start_job(const fs::path& study, Recovery recovery) {
  std::vector<std::string> arguments{"mpirun", "--oversubscribe", "-n", std::to_string(kRanks)};
  if (::geteuid() == 0) arguments.emplace_back("--allow-run-as-root");
  if (recovery == Recovery::on) arguments.emplace_back("--enable-recovery");
  for (const std::string& text : {program().string(), std::string("run"), study.string()}) {
    arguments.push_back(text);
  }
  return start(arguments);
}

/// Returns the process id of this rank of the job that runs the given study, or of the rank's
/// worker.
pid_t process_of(const fs::path& study, int rank, const std::string& verb) {
  for (const pid_t pid : processes_with(study.string())) {
    const fs::path process = fs::path("/proc") / std::to_string(pid);
    const auto read = [&](const char* name) {
      std::ifstream file(process / name, std::ios::binary);
      std::string all, part;
      while (std::getline(file, part, '\0')) all += part + '\0';
      return all;
    };
    const std::string wanted = fmt::format("OMPI_COMM_WORLD_RANK={}", rank) + '\0';
    const bool is_verb = read("cmdline").find('\0' + verb + '\0') != std::string::npos &&
                         !read("cmdline").starts_with("mpirun");
    if (is_verb && read("environ").find(wanted) != std::string::npos) return pid;
  }
  throw std::runtime_error(fmt::format("the job has no {} on rank {}", verb, rank));
}

struct Fault {
  std::string name;
  Recovery recovery;
  bool finishes;  // true: the job itself ends without a resume
  std::function<void(const fs::path& study)> strike;
};

void kill_rank(const fs::path& study, int rank) { ::kill(process_of(study, rank, "run"), SIGKILL); }

/// Makes a rank throw an exception: it can no longer start a worker, as if its node had lost a
/// disk.
void make_throw(const fs::path& study) {
  const std::string whole = read_text_file(study);
  write_text_file(study, "no study");
  const pid_t rank = process_of(study, 1, "run");
  ::kill(process_of(study, 1, "worker"), SIGKILL);
  const auto start = Clock::now();
  // The running ranks have already read the study; a resume needs the file again, so it is
  // restored.
  while (::kill(rank, 0) == 0 && Clock::now() - start < std::chrono::seconds(3)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  write_text_file(study, whole);
}

std::vector<Fault> faults() {
  const auto rank_1 = [](const fs::path& study) { kill_rank(study, 1); };
  const auto master = [](const fs::path& study) { kill_rank(study, 0); };
  return {{"rank killed, recovery on", Recovery::on, true, rank_1},
          {"rank killed", Recovery::off, false, rank_1},
          {"rank throws, recovery on", Recovery::on, true, make_throw},
          {"rank throws", Recovery::off, false, make_throw},
          {"master killed, recovery on", Recovery::on, false, master},
          {"master killed", Recovery::off, false, master}};
}

struct Counts {
  int histories = 0, finished = 0, same_bits = 0;
  long lost = 0, repeated = 0, left_running = 0;
  double longest = 0.0;  // s, from the fault to the end of the job
};

void live_through(const Fault& fault, const std::string& reference, long trials, Counts& counts) {
  const ScratchFolder folder;
  const fs::path file = write_small_study(folder.path(), kPause);
  const correlation::Study study = correlation::read_study(file, experiment::language());
  const pid_t job = start_job(file, fault.recovery);
  wait_for_trials(study, trials);
  const std::vector<Trial> before = Journal::read(study.run.journal).trials();
  const auto struck = Clock::now();
  fault.strike(file);
  ++counts.histories;
  counts.finished += end_of(job) == 0;
  counts.longest =
      std::max(counts.longest, std::chrono::duration<double>(Clock::now() - struck).count());
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // time for the system to end them
  counts.left_running += std::ssize(processes_with(folder.path().string()));
  if (end_of(start_latsch("resume", file, 2)) != 0) throw std::runtime_error("resume failed");
  const std::vector<Trial> after = trials_of(study);
  counts.lost += count_lost(before, after);
  counts.repeated += count_repeated(after);
  counts.same_bits += trajectory(study) == reference;
}

void report(Table& table, const Fault& fault, const Counts& counts) {
  const int all = counts.histories;
  if (fault.finishes) {
    table.row(fault.name + ": the job finishes",
              fmt::format("{} of {}", counts.finished, all),
              "all",
              counts.finished == all);
  } else {
    table.note(fault.name + ": the job finishes", fmt::format("{} of {}", counts.finished, all));
  }
  table.row(fault.name + ": end of the job after, at most",
            fmt::format("{:.1f} s", counts.longest),
            fmt::format("<= {:.0f} s", kLongest),
            counts.longest <= kLongest);
  table.row(fault.name + ": trials lost, repeated",
            fmt::format("{}, {}", counts.lost, counts.repeated),
            "0, 0",
            counts.lost == 0 && counts.repeated == 0);
  table.row(fault.name + ": processes left running",
            fmt::format("{}", counts.left_running),
            "0",
            counts.left_running == 0);
  table.row(fault.name + ": result, resumed",
            fmt::format("same bits {} of {}", counts.same_bits, all),
            "all",
            counts.same_bits == all);
}

int run(const Options& options) {
  const long repetitions = options.integer("REPETITIONS", options.size(10, 1));
  Table table("mpi_faults", options);
  if (std::system("command -v mpirun > /dev/null 2>&1") != 0) {
    table.skip("MPI faults", "no mpirun here: install Open MPI");
    return table.exit_code();
  }
  std::string reference;
  {
    const ScratchFolder folder;
    const fs::path file = write_small_study(folder.path(), 0.0);
    if (end_of(start_latsch("run", file, 1)) != 0) throw std::runtime_error("the study fails");
    reference = trajectory(correlation::read_study(file, experiment::language()));
  }
  std::vector<Fault> all = faults();
  all.resize(options.size(all.size(), std::size_t{2}));
  for (const Fault& fault : all) {
    Counts counts;
    for (long i = 0; i < repetitions; ++i) {
      RandomStream random(1, static_cast<std::uint64_t>(i));
      live_through(fault, reference, 1 + static_cast<long>(random.below(25)), counts);
    }
    report(table, fault, counts);
  }
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(
      argc, argv, {{"REPETITIONS", "", "of every fault"}}, latsch::benchmarks::run);
}
