// SPDX-License-Identifier: Apache-2.0
#include "studio/shelf/study_runs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>

#include "base/error.h"

extern char** environ;

namespace latsch::studio {

namespace fs = std::filesystem;

namespace {

constexpr int kStoppedOnRequest = 130;  // exit code of the program after Ctrl-C or SIGTERM
constexpr std::size_t kLogLines = 40;
constexpr std::streamoff kLogTail = 16'384;  // bytes

constexpr const char* kVerbs[] = {"run", "resume", "doe", "identify"};

class SpawnSettings {
 public:
  explicit SpawnSettings(const fs::path& log) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&actions_, 1, 2);
    posix_spawnattr_init(&attributes_);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK);
  }
  ~SpawnSettings() {
    posix_spawnattr_destroy(&attributes_);
    posix_spawn_file_actions_destroy(&actions_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  int spawn(std::vector<std::string> arguments, pid_t& process) const {
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    return ::posix_spawn(
        &process, arguments.front().c_str(), &actions_, &attributes_, pointers.data(), environ);
  }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

/// Returns the last lines of a file. If a line was overwritten by carriage returns (progress), only
/// its last text counts.
std::vector<std::string> last_lines(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  in.seekg(0, std::ios::end);
  const std::streamoff size = in.tellg();
  if (size <= 0) return {};
  in.seekg(std::max<std::streamoff>(0, size - kLogTail));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    while (!line.empty() && line.back() == '\r') line.pop_back();
    line = line.substr(line.find_last_of('\r') + 1);
    if (!line.empty() || !lines.empty()) lines.push_back(line);
  }
  if (lines.size() > kLogLines) lines.erase(lines.begin(), lines.end() - kLogLines);
  return lines;
}

}  // namespace

std::optional<RunVerb> run_verb(const std::string& name) {
  for (int verb = 0; verb < static_cast<int>(std::size(kVerbs)); ++verb)
    if (name == kVerbs[verb]) return static_cast<RunVerb>(verb);
  return std::nullopt;
}

fs::path run_log(const fs::path& study) {
  fs::path log = study;
  return log.replace_extension(".run.log");
}

void StudyRuns::reap() {
  for (auto& [id, process] : started_) {
    int status = 0;
    if (process.exit_code || ::waitpid(process.id, &status, WNOHANG) != process.id) continue;
    process.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    process.was_stopped = process.was_stopped || process.exit_code == kStoppedOnRequest;
  }
}

void StudyRuns::start(const ShelvedStudy& study, const Asked& asked) {
  const std::lock_guard lock(mutex_);
  reap();
  const auto ours = started_.find(study.id());
  const auto holder = study.look([](const auto& sight) { return sight.holder; });
  if (holder) throw InputError({study.file().string(), 0}, "is being run by " + holder->words);
  if (ours != started_.end() && !ours->second.exit_code)
    throw InputError({study.file().string(), 0}, "has just been started");
  std::vector<std::string> arguments{
      program_.string(), kVerbs[static_cast<int>(asked.verb)], study.file().string()};
  if (asked.workers > 0) {
    arguments.emplace_back("--workers");
    arguments.push_back(std::to_string(asked.workers));
  }
  if (asked.anew && asked.verb == RunVerb::run) arguments.emplace_back("--anew");
  pid_t process = 0;
  const int error = SpawnSettings(run_log(study.file())).spawn(std::move(arguments), process);
  if (error != 0)
    throw InputError({study.file().string(), 0},
                     fmt::format("cannot be started: {}; may {} be written?",
                                 std::strerror(error),
                                 run_log(study.file()).string()));
  started_[study.id()] = {process, asked.verb};
}

void StudyRuns::stop(const ShelvedStudy& study) {
  const std::lock_guard lock(mutex_);
  reap();
  const auto holder = study.look([](const auto& sight) { return sight.holder; });
  const auto ours = started_.find(study.id());
  int process = 0;
  if (ours != started_.end() && !ours->second.exit_code) process = ours->second.id;
  if (holder && holder->process) process = *holder->process;
  if (process > 0) {
    if (::kill(process, SIGINT) == 0) {
      if (ours != started_.end() && ours->second.id == process) ours->second.was_stopped = true;
      return;
    }
    throw InputError(
        {study.file().string(), 0},
        fmt::format("process {} cannot be stopped: {}", process, std::strerror(errno)));
  }
  throw InputError({study.file().string(), 0},
                   holder ? "is run on another machine, by " + holder->words +
                                ": stop it there, with Ctrl-C or scancel"
                          : "is not running: nothing to stop");
}

StudyRuns::Run StudyRuns::of(const ShelvedStudy& study) {
  const std::lock_guard lock(mutex_);
  reap();
  Run run;
  const auto ours = started_.find(study.id());
  if (ours != started_.end()) {
    run.is_ours = true;
    run.is_alive = !ours->second.exit_code;
    run.exit_code = ours->second.exit_code;
    run.was_stopped = ours->second.was_stopped;
    run.verb = ours->second.verb;
  }
  if (fs::exists(run_log(study.file()))) run.log = last_lines(run_log(study.file()));
  return run;
}

}  // namespace latsch::studio
