// SPDX-License-Identifier: Apache-2.0
// Injects 1,000 hangs, crashes, garbage outputs, exits, exceptions and floods of output into trials
// and checks that no study is lost. Further faults are a full disk, a damaged journal, a second run
// on one journal, and Ctrl-C.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <thread>

#include "base/error.h"
#include "base/file.h"
#include "base/random.h"
#include "base/scratch_folder_testing.h"
#include "evaluation/executors/inline_executor.h"
#include "evaluation/executors/process_executor.h"
#include "evaluation/executors/worker.h"
#include "evaluation/journal/journal.h"
#include "evaluation/journal/journal_doctor.h"
#include "evaluation/journal/journal_history_testing.h"
#include "evaluation/schedule/scheduler.h"
#include "evaluation/trial/encoding.h"
#include "fit_study.h"
#include "killed_study.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

namespace fs = std::filesystem;

constexpr int kPoints = 3000, kFewPoints = 90;
constexpr double kTimeout = 0.25;  // s
const StudyIdentity kStudy{{"model", "a square"}};

enum Fault { none, segfault, abort_, hang, not_a_number, exception, exit_code, garbage, memory };
constexpr std::array kNames{"none",
                            "segmentation fault",
                            "abort",
                            "hang",
                            "not a number",
                            "exception",
                            "exit code",
                            "garbage answer",
                            "out of memory"};
constexpr int kKinds = 8;

/// Returns the fault injected at a point: every third point has none, the others fail in a random
/// way.
Fault fault_of(int point) {
  return point % 3 != 0 ? none : static_cast<Fault>(1 + RandomStream(1, point).below(kKinds));
}

Result<Channels> square(const DesignPoint& point) {
  Channels channels;
  channels.add({"y", "1", {point.values[0] * point.values[0]}});
  return channels;
}

Result<Channels> faulty(const DesignPoint& point) {
  switch (fault_of(static_cast<int>(point.values[0]))) {
    case segfault:
      std::raise(SIGSEGV);
      break;
    case abort_:
      std::abort();
    case hang:
      while (true) std::this_thread::sleep_for(std::chrono::hours(1));
    case not_a_number: {
      Channels channels;
      channels.add({"y", "1", {std::nan("")}});
      return channels;
    }
    case exception:
      throw std::runtime_error("element 17 is inverted");
    case exit_code:
      std::_Exit(7);
    case garbage:
      if (::write(kWorkerOutput, "what a solver prints, on the wrong line", 39) < 0) std::abort();
      break;
    case memory: {
      std::vector<std::unique_ptr<char[]>> blocks;
      while (true) blocks.emplace_back(new char[std::size_t{1} << 26]);
    }
    case none:
      break;
  }
  return square(point);
}

const std::map<Fault, std::string> kReasons{{segfault, "signal 11"},
                                            {abort_, "signal 6"},
                                            {hang, "took more than the 0.25 s"},
                                            {not_a_number, "is nan"},
                                            {exception, "element 17"},
                                            {exit_code, "exited with code 7"},
                                            {garbage, "not readable"},
                                            {memory, "out of memory"}};

ProcessOptions workers() {
  ProcessOptions options;
  options.arguments = {fs::read_symlink("/proc/self/exe").string(), "worker"};
  options.workers = 2;
  options.timeout = kTimeout;
  options.memory_limit = 1e9;
  return options;
}

SamplingPlan plan(int points) {
  SamplingPlan plan;
  for (int i = 0; i < points; ++i) plan.points.push_back({{1.0 * i}});
  return plan;
}

void evaluator_faults(Table& table, int points) {
  const ScratchFolder folder;
  Journal journal = Journal::open(folder / "j", kStudy);
  ProcessExecutor executor(workers());
  const bool ended = run_doe(plan(points), executor, journal) == RunEnd::converged;
  std::map<Fault, int> injected, told;
  long spoiled = 0;
  double longest = 0.0;
  for (const Trial& trial : journal.trials()) {
    const Fault fault = fault_of(static_cast<int>(trial.point.values[0]));
    ++injected[fault];
    if (fault == none) {
      spoiled += !trial.outcome.result || !(*trial.outcome.result == *square(trial.point));
      continue;
    }
    const std::string reason = trial.outcome.result ? "" : trial.outcome.result.failure().reason;
    told[fault] += reason.find(kReasons.at(fault)) != std::string::npos;
    if (fault == hang) longest = std::max(longest, trial.outcome.wall_time - kTimeout);
  }
  int all = 0;
  for (int kind = 1; kind <= kKinds; ++kind) {
    const auto fault = static_cast<Fault>(kind);
    all += injected[fault];
    table.row(fmt::format("{} injected, stored with its reason (F3)", kNames[kind]),
              fmt::format("{} of {}", told[fault], injected[fault]),
              "all",
              told[fault] == injected[fault]);
  }
  table.row("faults injected",
            fmt::format("{}", all),
            fmt::format(">= {}", points / 3),
            all >= points / 3);
  table.row("study came to its end", ended ? "yes" : "no", "yes", ended);
  table.row("trials lost or spoiled beside the faults",
            fmt::format("{}", spoiled + points - journal.size()),
            "0",
            spoiled == 0 && journal.size() == points);
  table.full_row("killed after the timeout, at most",
                 fmt::format("{:.2f} s", longest),
                 "<= 1 s",
                 longest <= 1.0);
}

/// Proposes one point at a time and waits for its outcome, so that a point that hangs stops the
/// whole search.
class OneByOne : public Optimizer {
 public:
  explicit OneByOne(std::vector<DesignPoint> points) : points_(std::move(points)) {}
  std::vector<DesignPoint> propose(int) const override { return {points_[next_]}; }
  void observe(const DesignPoint&, const Result<Score>& outcome) override {
    ++next_;
    expired_ += !outcome && outcome.failure().cause == Cause::timeout;
  }
  bool converged() const override { return next_ == points_.size(); }
  int expired() const { return expired_; }

 private:
  std::vector<DesignPoint> points_;
  std::size_t next_ = 0;
  int expired_ = 0;
};

/// Returns `good` points without a fault, followed by `hanging` ones that hang.
std::vector<DesignPoint> points_with_hangs(int good, int hanging) {
  std::vector<DesignPoint> points, last;
  for (int i = 0; good > 0 || hanging > 0; ++i) {
    if (fault_of(i) == none && good-- > 0) points.push_back({{1.0 * i}});
    if (fault_of(i) == hang && hanging-- > 0) last.push_back({{1.0 * i}});
  }
  points.insert(points.end(), last.begin(), last.end());
  return points;
}

/// Runs a search that reaches points which always hang, and counts how often each of them is
/// started again.
void hanging_points(Table& table, const Options& options) {
  constexpr int kGood = 20, kHanging = 3;
  const std::vector<int> counts = options.size(std::vector<int>{1, 2, 4}, std::vector<int>{2});
  for (const int count : counts) {
    ProcessOptions processes = workers();
    processes.workers = count;
    ProcessExecutor executor(processes);
    OneByOne optimizer(points_with_hangs(kGood, kHanging));
    long again = 0;
    RunOptions run;
    run.on_progress = [&](const RunProgress& progress) {
      again = progress.copied + progress.repeated;
    };
    const auto start = std::chrono::steady_clock::now();
    run.stop_requested = [&] {
      return std::chrono::steady_clock::now() - start > std::chrono::seconds(20);
    };
    const Objective any = [](const Channels&) -> Result<Score> { return Score{}; };
    const Run ended = run_optimizer(optimizer, any, executor, nullptr, run);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    table.row(
        fmt::format("{} points that always hang, {} worker{}: each expires (F3)",
                    kHanging,
                    count,
                    count > 1 ? "s" : ""),
        fmt::format(
            "{} expired, {} started again, {:.1f} s", optimizer.expired(), again, time.count()),
        fmt::format("{}, <= {}, <= 5 s", kHanging, kHanging),
        ended.end == RunEnd::converged && optimizer.expired() == kHanging && again <= kHanging &&
            (time.count() <= 5.0 || options.is_smoke()));
  }
}

/// Kills a worker of this process with kill -9, whatever it is doing.
void kill_a_worker(RandomStream& random) {
  std::vector<pid_t> children;
  for (const pid_t pid : processes_with(std::string("\0worker", 7))) {
    std::ifstream stat(fs::path("/proc") / std::to_string(pid) / "stat");
    std::string number, name, state;
    pid_t parent = 0;
    if (stat >> number >> name >> state >> parent && parent == ::getpid()) children.push_back(pid);
  }
  if (!children.empty()) ::kill(children[random.below(children.size())], SIGKILL);
}

/// Injects several faults at once (hanging points, killed workers, a full disk), and then resumes
/// the run.
void several_at_once(Table& table, const Options& options) {
  const int good = options.size(200, 60), hanging = options.size(6, 2);
  SamplingPlan plan;
  plan.points = points_with_hangs(good, hanging);
  const ScratchFolder folder;
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  std::jthread killer([](const std::stop_token& end) {
    RandomStream random(3, 0);
    while (!end.stop_requested()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20 + random.below(60)));
      kill_a_worker(random);
    }
  });
  int full = 0;
  long kept = 0, lost = 0;
  for (rlim_t size = 60'000;; size += 20'000) {
    Journal journal = Journal::open(folder / "j", kStudy);
    lost += journal.size() < kept;
    const rlimit tight{size, before.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &tight);
    ProcessExecutor executor(workers());
    bool done = false;
    try {
      done = run_doe(plan, executor, journal) == RunEnd::converged;
    } catch (const JournalError&) {
      ++full;
    }
    kept = journal.size();
    ::setrlimit(RLIMIT_FSIZE, &before);
    if (done || size > 10'000'000) break;
  }
  killer.request_stop();
  killer.join();
  long right = 0, failed = 0;
  for (const Trial& trial : Journal::read(folder / "j").trials()) {
    const bool hangs = fault_of(static_cast<int>(trial.point.values[0])) == hang;
    right += !hangs && trial.outcome.result && *trial.outcome.result == *square(trial.point);
    failed += hangs && !trial.outcome.result;
  }
  table.note("hanging points, workers killed, disk full at once: full",
             fmt::format("{} times", full));
  table.row("at once: right, hanging ones failed, lost",
            fmt::format("{}, {}, {}", right, failed, lost),
            fmt::format("{}, {}, 0", good, hanging),
            right == good && failed == hanging && lost == 0 && full > 0);
}

void full_disk(Table& table, int disks) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  int told = 0, kept = 0;
  for (int i = 0; i < disks; ++i) {
    const ScratchFolder folder;
    long acknowledged = 0;
    {
      Journal journal = Journal::open(folder / "j", kStudy);
      const rlimit tight{60'000 + 7'001u * static_cast<unsigned>(i), before.rlim_max};
      ::setrlimit(RLIMIT_FSIZE, &tight);
      try {
        InlineExecutor executor(square);
        (void)run_doe(plan(kPoints), executor, journal);
      } catch (const JournalError& error) {
        told += std::string(error.what()).find("the disk is full") != std::string::npos;
      }
      acknowledged = journal.size();
      ::setrlimit(RLIMIT_FSIZE, &before);
    }
    Journal journal = Journal::open(folder / "j", kStudy);
    InlineExecutor executor(square);
    const bool all = journal.size() == acknowledged &&
                     run_doe(plan(kPoints), executor, journal) == RunEnd::converged;
    kept += all && journal.size() == kPoints;
  }
  table.row(
      "full disk told in words (F4)", fmt::format("{} of {}", told, disks), "all", told == disks);
  table.row("resumed without loss or repetition",
            fmt::format("{} of {}", kept, disks),
            "all",
            kept == disks);
}

Trial stored_trial(int number) {
  Channels channels;
  channels.add({"Fz", "N", std::vector<double>(number % 2 ? 20 : 1200, 1.5 * number)});
  return {{{1.0 * number}}, {channels, 1.5, 1.25, 0}};
}

/// True if every trial that can be read from a damaged journal equals the written one, and if a
/// missing trial is reported.
bool is_honest(const JournalReport& report, int trials) {
  for (const auto& row : report.rows) {
    const auto read = row.decode();
    if (!read) return false;
    const Trial written = stored_trial(static_cast<int>(read->point.values[0]));
    if (encode(read->outcome) != encode(written.outcome)) return false;
  }
  return std::ssize(report.rows) == trials || !report.healthy();
}

void damaged_journal(Table& table, int damages) {
  constexpr int kTrials = 40;
  const ScratchFolder folder;
  {
    Journal journal = Journal::open(folder / "a", kStudy);
    for (int i = 1; i <= kTrials; ++i) journal.append(stored_trial(i));
  }
  const std::string whole = read_text_file(folder / "a");
  long dishonest = 0, most_lost = 0;
  for (int i = 0; i < damages; ++i) {
    RandomStream random(2, i);
    std::string bytes = whole;
    const std::size_t at = random.below(bytes.size());
    if (i % 10 < 6) {
      bytes[at] ^= static_cast<char>(1u << random.below(8));
    } else if (i % 10 < 8) {
      bytes.resize(at);
    } else {
      for (std::size_t k = at / 4096 * 4096; k < std::min(bytes.size(), at / 4096 * 4096 + 4096);
           ++k) {
        bytes[k] = 0;
      }
    }
    std::ofstream(folder / "b", std::ios::binary) << bytes;
    const JournalReport report = examine_journal(folder / "b");
    dishonest += !is_honest(report, kTrials);
    if (i % 10 < 6) most_lost = std::max(most_lost, kTrials - std::ssize(report.rows));
  }
  table.row(fmt::format("damages of a journal not detected, of {} (F5)", damages),
            fmt::format("{}", dishonest),
            "0",
            dishonest == 0);
  // A flipped bit damages one row of the journal, so it may cost one trial at most.
  table.row("trials that a bit flip costs, at most",
            fmt::format("{}", most_lost),
            "<= 1",
            most_lost <= 1);
}

void power_losses(Table& table, Journal::Log log, const std::string& name, int losses) {
  int broken = 0, while_open = 0;
  long acknowledged = 0, sectors = 0;
  for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(losses); ++seed) {
    const PowerHistory history = live_through_power_loss(seed, log);
    if (!history.wrong.empty()) fmt::print(stderr, "seed {}: {}\n", seed, history.wrong);
    broken += !history.wrong.empty();
    while_open += history.while_open;
    acknowledged += history.acknowledged;
    sectors += history.sectors_lost;
  }
  table.note(fmt::format("power losses, {} log; with an open journal (F2)", name),
             fmt::format("{}; {}", losses, while_open));
  table.note("sectors lost by them, wholly or in part", fmt::format("{}", sectors));
  table.row(fmt::format("journals that miss one of {} acknowledged trials", acknowledged),
            fmt::format("{}", broken),
            "0",
            broken == 0);
}

void second_run(Table& table) {
  const ScratchFolder folder;
  Journal journal = Journal::open(folder / "j", kStudy);
  std::string said;
  try {
    (void)Journal::open(folder / "j", kStudy);
  } catch (const InputError& error) {
    said = error.what();
  }
  const bool told = said.find(fmt::format("in use by process {}", ::getpid())) != std::string::npos;
  table.row(
      "second run on one journal is told who holds it (F13)", told ? "yes" : "no", "yes", told);
  journal.append(stored_trial(1));
  const long read = Journal::read(folder / "j").size();
  const bool healthy = examine_journal(folder / "j").healthy();
  table.row("reading and the doctor meanwhile",
            fmt::format("{} of 1 trials, {}", read, healthy ? "healthy" : "damaged"),
            "1, healthy",
            read == 1 && healthy);
}

/// Writes a study whose program never ends.
fs::path write_endless_study(const fs::path& folder) {
  write_text_file(folder / "in.txt", "{x}\n");
  write_text_file(folder / "measured.csv", "y [1]\n1\n");
  write_text_file(folder / "study.toml", R"([simulator]
command = ["sleep", "1000"]
inputs = ["in.txt"]
[simulator.output.out]
file = "out.txt"
reader = "keys"
quantities = ["y"]
[variable.x]
lower = 0
upper = 1
initial = 0.5
[experiment.e]
kind = "curve"
y = "out/y"
measurement = "measured.csv"
[run]
workers = 2
)");
  return folder / "study.toml";
}

pid_t start_run(const fs::path& study) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  const std::string file = program().string();
  if (!std::freopen("/dev/null", "w", stdout) || !std::freopen("/dev/null", "w", stderr))
    ::_exit(1);
  ::execl(file.c_str(), "latsch", "run", study.c_str(), nullptr);
  ::_exit(1);
}

/// Counts processes whose working folder is `folder`: outside programs that outlived their run.
int count_left_in(const fs::path& folder) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::error_code not_ours;
    const fs::path where = fs::read_symlink(entry.path() / "cwd", not_ours);
    count += !not_ours && where.string().starts_with(folder.string());
  }
  return count;
}

/// Returns the time, s, between a signal, sent `times` times, and the end of a run whose trials
/// never end.
double time_to_stop(int signal, int times, int& left) {
  const ScratchFolder folder;
  const fs::path study = write_endless_study(folder.path());
  const pid_t child = start_run(study);
  while (!fs::exists(folder / "study.scratch")) {  // wait until a trial has begun
    if (::waitpid(child, nullptr, WNOHANG) != 0) throw std::runtime_error("latsch run ended early");
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < times; ++i) {
    ::kill(child, signal);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  for (int i = 0; i < 20 && count_left_in(folder.path()) > 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // time for the system to end them
  }
  left += count_left_in(folder.path());
  return time.count();
}

void signals(Table& table, int times) {
  double once = 0.0, twice = 0.0;
  int left = 0;
  for (int i = 0; i < times; ++i) {
    for (const int signal : {SIGINT, SIGTERM}) {
      once = std::max(once, time_to_stop(signal, 1, left));
      twice = std::max(twice, time_to_stop(signal, 2, left));
    }
  }
  table.full_row("SIGINT, SIGTERM to the end of a run that hangs (F16)",
                 fmt::format("{:.2f} s", once),
                 "<= 2 s",
                 once <= 2.0);
  table.full_row("the second signal", fmt::format("{:.2f} s", twice), "<= 0.5 s", twice <= 0.5);
  table.row("outside programs left running", fmt::format("{}", left), "0", left == 0);
}

int run(const Options& options) {
  Table table("faults", options);
  evaluator_faults(table, options.size(kPoints, kFewPoints));
  hanging_points(table, options);
  several_at_once(table, options);
  full_disk(table, options.size(20, 2));
  damaged_journal(table, options.size(1000, 40));
  const int losses = options.size(1000, 20);
  power_losses(table, Journal::Log::write_ahead, "write-ahead", losses);
  power_losses(table, Journal::Log::rollback, "rollback", losses);
  second_run(table);
  signals(table, options.size(3, 1));
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  if (argc > 1 && std::strcmp(argv[1], "worker") == 0) {
    return latsch::serve(latsch::benchmarks::faulty);
  }
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::run);
}
