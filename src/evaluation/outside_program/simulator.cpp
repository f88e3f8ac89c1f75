// SPDX-License-Identifier: Apache-2.0
#include "evaluation/outside_program/simulator.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <iterator>
#include <set>

#include "base/error.h"
#include "base/file.h"
#include "evaluation/outside_program/named_files.h"
#include "evaluation/outside_program/outside_program.h"
#include "evaluation/trial/encoding.h"
#include "evaluation/trial/host_name.h"

namespace latsch {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPrinted = "printed.txt";

/// Removes folders with names "...-HOST-PROCESS" that belong to processes of this machine that have
/// ended. A killed trial cannot remove its own folder, and its files may have filled the disk.
void remove_abandoned(const fs::path& scratch) {
  const std::string ours = fmt::format("-{}-", host_name());
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(scratch, ignored)) {
    const std::string name = entry.path().filename();
    const std::size_t at = name.find(ours);
    if (at == std::string::npos) continue;
    const char* end = name.data() + name.size();
    pid_t process = 0;
    if (std::from_chars(name.data() + at + ours.size(), end, process).ptr != end) continue;
    const bool alive = ::kill(process, 0) == 0 || errno != ESRCH;
    if (!alive) fs::remove_all(entry.path(), ignored);
  }
}

/// The folder of one trial. Machine and process are part of its name, because the same point may
/// run twice at once.
class TrialFolder {
 public:
  TrialFolder(const fs::path& scratch, const DesignPoint& point)
      : path_(scratch / fmt::format("{:016x}-{}-{}", hash(point.bits()), host_name(), ::getpid())) {
    std::error_code error;
    fs::remove_all(path_, error);
    fs::create_directories(path_, error);
    if (error)
      throw InputError(
          {path_.string(), 0},
          "the folder in which the outside program runs cannot be created: " + error.message() +
              "; copy the study's folder to a place that can be written");
  }
  ~TrialFolder() {
    std::error_code ignored;
    if (!kept_) fs::remove_all(path_, ignored);
  }
  TrialFolder(const TrialFolder&) = delete;
  TrialFolder& operator=(const TrialFolder&) = delete;

  const fs::path& path() const { return path_; }
  void keep() { kept_ = true; }

 private:
  fs::path path_;
  bool kept_ = false;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

void write_inputs(const Simulator& simulator,
                  const DesignSpace& space,
                  const DesignPoint& point,
                  const fs::path& folder) {
  for (const fs::path& file : simulator.copied) {
    fs::copy_file(simulator.study_folder / file, folder / file.filename());
  }
  for (const Simulator::Input& input : simulator.inputs) {
    write_text_file(folder / input.file, input.text.filled(space, point));
  }
}

Result<Channels> run(const Simulator& simulator,
                     const DesignSpace& space,
                     const DesignPoint& point,
                     const fs::path& folder) {
  write_inputs(simulator, space, point, folder);
  const Status ran = run_program(command(simulator), folder, folder / kPrinted, simulator.timeout);
  if (!ran) return ran.failure();
  Channels channels;
  for (const OutputReader& output : simulator.outputs) {
    auto read = read_output(output, folder);
    if (!read) return read.failure();
    for (Channel& channel : *read) channels.add(std::move(channel));
  }
  return channels;
}

/// Returns why the program's printed output cannot be continued, such as a full disk; empty if it
/// can. Programs report a full disk in many different ways or not at all.
std::string full_disk(const fs::path& printed) {
  const int file = ::open(printed.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0) return errno == ENOSPC || errno == EDQUOT ? std::strerror(errno) : "";
  const off_t size = ::lseek(file, 0, SEEK_END);
  constexpr std::array<char, 4096> kBlock{};
  errno = 0;
  const bool is_written =
      ::write(file, kBlock.data(), kBlock.size()) == std::ssize(kBlock) && ::fsync(file) == 0;
  const int error = errno == 0 ? ENOSPC : errno;  // a partial write sets no error
  const bool is_restored = ::ftruncate(file, size) == 0;
  ::close(file);
  const bool is_full = error == ENOSPC || error == EDQUOT || error == EFBIG;
  return !is_written && is_restored && is_full ? std::strerror(error) : "";
}

/// Returns the path of the program latsch: this process itself, the program in the same folder (if
/// this is a benchmark), or the one in the search path.
std::string this_program() {
  const std::string name = "latsch";
  std::error_code ignored;
  const fs::path self = fs::read_symlink("/proc/self/exe", ignored);
  if (self.filename() == name) return self.string();
  const fs::path beside = self.parent_path() / name;
  return !self.empty() && fs::exists(beside, ignored) ? beside.string() : name;
}

}  // namespace

std::vector<std::string> command(const Simulator& simulator) {
  const std::string folder = fs::absolute(simulator.study_folder).string();
  std::vector<std::string> arguments;
  for (const std::string& argument : simulator.arguments) {
    arguments.push_back(
        replaced(replaced(argument, "{study}", folder), "{latsch}", this_program()));
  }
  return arguments;
}

Evaluator evaluator(const Simulator& simulator, const DesignSpace& space) {
  return [simulator, space](const DesignPoint& point) -> Result<Channels> {
    if (!simulator.keep_failed) remove_abandoned(simulator.scratch);
    TrialFolder folder(simulator.scratch, point);
    auto result = run(simulator, space, point, folder.path());
    if (result) return result;
    Failure failure = result.failure();
    const std::string full = full_disk(folder.path() / kPrinted);
    if (!full.empty()) {
      failure = {fmt::format("the disk is full, nothing more can be written to {} ({}); {}",
                             simulator.scratch.string(),
                             full,
                             failure.reason),
                 Cause::transient};
    }
    if (simulator.keep_failed) {
      folder.keep();
      failure.reason += "; its folder is " + folder.path().string();
    }
    return failure;
  };
}

namespace {

constexpr std::uintmax_t kLargestRead = std::uintmax_t{256} << 20;

/// Returns a text that identifies a file independently of its folder, such as "python3: 6831736
/// bytes, 0123456789abcdef".
std::string told(const std::string& argument, const fs::path& file) {
  std::error_code error;
  const auto size = fs::file_size(file, error);
  if (error) return "";
  // A program above kLargestRead is identified by its size and date, because reading it would take
  // too long.
  if (size > kLargestRead) {
    const auto time = fs::last_write_time(file, error).time_since_epoch().count();
    return fmt::format("{}: {} bytes, written {}\n", argument, size, time);
  }
  return fmt::format(
      "{}: {} bytes, {:016x}\n", argument, size, hash(read_text_file(file, kLargestRead)));
}

bool is_in_study(const Simulator& simulator, const fs::path& file) {
  const fs::path folder = fs::weakly_canonical(simulator.study_folder);
  const fs::path relative = fs::weakly_canonical(file).lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

std::vector<fs::path> watched_files(const Simulator& simulator) {
  std::set<std::string> of_the_trial;  // files of the trial's own folder
  for (const Simulator::Input& input : simulator.inputs) of_the_trial.insert(input.file);
  for (const OutputReader& output : simulator.outputs)
    of_the_trial.insert(output.file.filename().string());
  std::vector<fs::path> files;
  for (const std::string& argument : command(simulator)) {
    std::error_code ignored;
    if (!argument.starts_with('/') || !fs::is_regular_file(argument, ignored) ||
        !is_in_study(simulator, argument))
      continue;
    for (const fs::path& file : files_named_beside(argument, of_the_trial))
      if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  }
  return files;
}

namespace {

/// Returns a text that identifies the program, the files among its arguments, and the files that
/// these name beside them. If the program is Latsch itself, its versions identify it.
std::string program_files(const Simulator& simulator) {
  const std::vector<std::string> arguments = command(simulator);
  std::string text;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& written = simulator.arguments[i];
    if (written.find("{latsch}") != std::string::npos) continue;
    std::optional<fs::path> file;
    if (i == 0) file = file_of_program(arguments[i]);
    if (i > 0 && arguments[i].starts_with('/')) file = arguments[i];
    std::error_code ignored;
    if (file && fs::is_regular_file(*file, ignored)) text += told(written, *file);
  }
  for (const fs::path& file : watched_files(simulator))
    text += told(file.filename().string(), file);
  return text;
}

}  // namespace

StudyIdentity identity(const Simulator& simulator, const DesignSpace& space) {
  std::string inputs, readers, variables;
  for (const Simulator::Input& input : simulator.inputs) {
    inputs += fmt::format("{}\n{}\n", input.file, input.text.text());
  }
  for (const fs::path& file : simulator.copied) {
    inputs += fmt::format("{}\n{}\n", file.string(), read_text_file(simulator.study_folder / file));
  }
  for (const OutputReader& r : simulator.outputs) {
    readers += fmt::format("{} {} kind {} columns {} keys {} pattern {} after {} samples {}",
                           r.name,
                           r.file.string(),
                           static_cast<int>(r.kind),
                           fmt::join(r.columns, " "),
                           fmt::join(r.keys, " "),
                           r.pattern,
                           r.after,
                           r.samples);
    for (const auto& quantity : r.quantities) {
      readers += fmt::format(" {} [{}]", quantity.name, quantity.unit);
    }
    readers += "\n";
  }
  for (const DesignVariable& variable : space.variables()) {
    variables += fmt::format("{} [{}]\n", variable.name, variable.unit);
  }
  return {{"program", fmt::format("{}\n", fmt::join(simulator.arguments, "\n"))},
          {"inputs", inputs},
          {"outputs", readers},
          {"variables", variables},
          {kProgramFilesPart, program_files(simulator)}};
}

}  // namespace latsch
