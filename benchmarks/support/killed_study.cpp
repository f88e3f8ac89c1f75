// SPDX-License-Identifier: Apache-2.0
#include "killed_study.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <set>
#include <stdexcept>
#include <thread>

#include "base/file.h"
#include "correlation/search/study_method.h"
#include "correlation/target/study_trials.h"
#include "evaluation/schedule/scheduler.h"
#include "evaluation/trial/encoding.h"
#include "fit_study.h"

namespace latsch::benchmarks {

namespace fs = std::filesystem;

namespace {

// The optimum of this study is {x, y} = {0.3, 0.7}; the benchmark does not judge it.
constexpr const char* kStudy = R"(title = "Two variables, to be killed"
[simulator]
command = ["awk", "-f", "{study}/model.awk", "in.txt"]
inputs = ["in.txt"]
[simulator.output.out]
file = "out.csv"
reader = "table"
quantities = ["t [s]", "z [mm]"]
[variable.x]
lower = 0
upper = 1
initial = 0.9
[variable.y]
lower = 0
upper = 1
initial = 0.1
[experiment.e]
kind = "curve"
x = "out/t"
y = "out/z"
measurement = "measured.csv"
[optimizer]
method = "gss"
step_tolerance = 0.01
[run]
intervals = false
timeout = "60 s"
)";

}  // namespace

fs::path write_small_study(const fs::path& folder, double pause) {
  const std::string wait = pause > 0.0 ? fmt::format("system(\"sleep {}\"); ", pause) : "";
  write_text_file(folder / "model.awk",
                  "{ " + wait +
                      "printf \"t [s],z [mm]\\n0,%.17g\\n1,%.17g\\n2,%.17g\\n\", $1, $1 + $2, "
                      "$1 * $2 > \"out.csv\" }\n");
  write_text_file(folder / "in.txt", "{x} {y}\n");
  write_text_file(folder / "measured.csv", "t [s],z [mm]\n0,0.3\n1,1\n2,0.21\n");
  write_text_file(folder / "study.toml", kStudy);
  return folder / "study.toml";
}

pid_t start(const std::vector<std::string>& arguments) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  if (!std::freopen("/dev/null", "w", stdout) || !std::freopen("/dev/null", "w", stderr)) _exit(1);
  ::execvp(argv[0], argv.data());
  ::_exit(1);
}

pid_t start_latsch(const std::string& verb, const fs::path& study, int workers) {
  return start({program().string(), verb, study.string(), "--workers", std::to_string(workers)});
}

int end_of(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::vector<Trial> trials_of(const correlation::Study& study) {
  if (!fs::exists(study.run.journal)) return {};
  return Journal::open(study.run.journal, correlation::identity(study)).trials();
}

void wait_for_trials(const correlation::Study& study, long count) {
  const auto known = [&]() -> long {
    try {
      return fs::exists(study.run.journal) ? Journal::read(study.run.journal).size() : 0;
    } catch (const std::exception&) {  // the journal is being created
      return 0;
    }
  };
  const auto start = std::chrono::steady_clock::now();
  while (known() < count) {
    if (std::chrono::steady_clock::now() - start > std::chrono::minutes(1)) {
      throw std::runtime_error("no trials come");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

std::string trajectory(const correlation::Study& study) {
  const auto optimizer = correlation::make_optimizer(study);
  const Run run = replay(
      *optimizer, correlation::objective(study), Journal::read(study.run.journal), study.max_steps);
  if (run.end != RunEnd::converged) return {};
  std::string bits;
  for (const Step& step : run.steps) {
    bits += step.point.bits();
    bits +=
        step.outcome ? DesignPoint{{step.outcome->value}}.bits() : step.outcome.failure().reason;
  }
  return bits;
}

long count_lost(const std::vector<Trial>& before, const std::vector<Trial>& after) {
  long lost = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    lost += i >= after.size() || before[i].point.bits() != after[i].point.bits() ||
            encode(before[i].outcome) != encode(after[i].outcome);
  }
  return lost;
}

long count_repeated(const std::vector<Trial>& trials) {
  std::set<std::string> points;
  for (const Trial& trial : trials) points.insert(trial.point.bits());
  return std::ssize(trials) - std::ssize(points);
}

std::vector<pid_t> processes_with(const std::string& text) {
  std::vector<pid_t> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream file(entry.path() / "cmdline", std::ios::binary);
    std::string line, argument;
    while (std::getline(file, argument, '\0')) line += argument + '\0';
    if (line.find(text) != std::string::npos) found.push_back(std::stoi(name));
  }
  return found;
}

}  // namespace latsch::benchmarks
