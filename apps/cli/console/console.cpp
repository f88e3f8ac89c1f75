// SPDX-License-Identifier: Apache-2.0
#include "cli/console/console.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/progress.h"
#include "cli/verbs/verbs.h"

namespace latsch::cli {
namespace {

/// Throws if the file for the log exists and is no log: a log is appended, and this file was
/// probably named by mistake.
void refuse_to_log_into_other_file(const std::string& file) {
  if (!std::filesystem::is_regular_file(file)) return;
  std::ifstream there(file, std::ios::binary);
  std::string line;
  if (!std::getline(there, line)) return;
  if (!line.starts_with("# 2"))  // every first line of a log begins with the date, so with the year
    throw InputError({file, 1},
                     "exists and is no log of latsch, so nothing is appended to it: expected "
                     "another name for the log");
}

/// State of the console. The process has one, like standard output, and every verb writes to it.
struct Console {
  CommonOptions options;
  std::ofstream log;
  std::FILE* answers = nullptr;  // original standard output, kept for the JSON answer
  Json head = Json::object(), result = Json::object();
  std::string if_stopped = {};  // the answer to write if a signal stops the verb
};

Console& console() {
  static Console one;
  return one;
}

std::string now() {
  const std::time_t time = std::time(nullptr);
  char text[sizeof("2000-01-01T00:00:00Z")];
  std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&time));
  return text;
}

void log(std::string_view text) {
  if (console().log.is_open()) console().log << text << std::flush;
}

Json note(const std::string& sentence, const Place& place) {
  Json found = {{"message", sentence}};
  if (!place.file.empty()) found["file"] = place.file;
  if (place.line > 0) found["line"] = place.line;
  return found;
}

void to_standard_error(const std::string& sentence) {
  // The sentence already begins with the name of the program, such as "latsch run: ..." for an
  // invalid argument.
  const bool named = sentence.starts_with("latsch ");
  const std::string line = (named ? "" : "latsch: ") + sentence + "\n";
  std::fflush(stdout);  // keeps the order if both streams go to one file
  std::fwrite(line.data(), 1, line.size(), stderr);
  log(line);
}

/// Flushes the output. Returns the exit code, or that of a failure if the output could not be
/// written, for example to a full disk or a closed terminal.
int printed(FILE* out, int exit_code) {
  errno = 0;
  if (std::fflush(out) == 0 && !std::ferror(out)) return exit_code;
  const char* why = errno == 0 ? "an error of the device" : std::strerror(errno);
  std::fprintf(stderr, "latsch: the standard output cannot be written: %s\n", why);
  return exit_code == kDone ? kFailed : exit_code;
}

const char* status_of(int exit_code) {
  switch (exit_code) {
    case kDone:
      return "done";
    case kWrongInput:
      return "wrong input";
    case kStopped:
      return "stopped";
    default:
      return "failed";
  }
}

/// Redirects output of other code, such as libraries, from standard output to standard error,
/// because it would damage the JSON.
void keep_standard_output() {
  std::fflush(stdout);
  console().answers = ::fdopen(::dup(STDOUT_FILENO), "w");
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
}

}  // namespace

void open_console(const CommonOptions& options, const std::string& verb, const std::string& line) {
  Console& c = console();
  c.options = options;
  c.head = Json{
      {"verb", verb}, {"exit_code", 0}, {"status", status_of(kDone)}, {"warnings", Json::array()}};
  if (options.json) {
    c.if_stopped = fmt::format(
        "{{\n  \"verb\": \"{}\",\n  \"exit_code\": {},\n  \"status\": \"{}\",\n  \"warnings\": "
        "[]\n}}\n",
        verb,
        kStopped,
        status_of(kStopped));
  }
  if (options.json && !c.answers) keep_standard_output();
  if (options.log.empty()) return;
  refuse_to_log_into_other_file(options.log);
  c.log.open(options.log, std::ios::app | std::ios::binary);
  if (!c.log) throw InputError({options.log, 0}, "cannot be written, expected a log file");
  log(fmt::format("# {} {}\n", now(), line));
}

int close_console(int exit_code) {
  Console& c = console();
  exit_code = printed(stdout, exit_code);
  log(fmt::format("# {} ended with exit code {}\n", now(), exit_code));
  if (c.log.is_open() && !c.log.flush()) {
    std::fprintf(
        stderr, "latsch: %s: the log cannot be written to its end\n", c.options.log.c_str());
  }
  if (!c.answers) return exit_code;
  c.head["exit_code"] = exit_code;
  c.head["status"] = status_of(exit_code);
  if (!c.result.empty()) c.head["result"] = c.result;
  // replaces invalid bytes of names that are not valid UTF-8
  const auto replace = nlohmann::detail::error_handler_t::replace;
  const std::string text = c.head.dump(2, ' ', false, replace) + "\n";
  std::fwrite(text.data(), 1, text.size(), c.answers);
  exit_code = printed(c.answers, exit_code);
  std::fclose(c.answers);
  c.answers = nullptr;
  return exit_code;
}

void answer_stopped() {
  const Console& c = console();
  if (!c.answers) return;
  const int out = ::fileno(c.answers);
  const char* from = c.if_stopped.data();
  for (std::size_t left = c.if_stopped.size(); left > 0;) {
    const ssize_t written = ::write(out, from, left);
    if (written <= 0) return;
    from += written;
    left -= static_cast<std::size_t>(written);
  }
}

void be_silent() {
  console().options.quiet = true;
  console().answers = nullptr;
}

void say_text(std::string_view text) {
  log(text);
  if (console().options.quiet || console().options.json) return;
  std::fwrite(text.data(), 1, text.size(), stdout);
}

void note_text(std::string_view text) {
  log(text);
  if (console().options.quiet || console().options.json) return;
  std::fflush(stdout);  // keeps the order if both streams go to one file
  std::fwrite(text.data(), 1, text.size(), stderr);
}

void put(std::string_view data) {
  if (console().options.json) return;
  std::fwrite(data.data(), 1, data.size(), stdout);
}

void warn(const std::string& sentence, const Place& place) {
  to_standard_error(sentence);
  console().head["warnings"].push_back(note(sentence, place));
}

int warnings() { return static_cast<int>(console().head["warnings"].size()); }

void complain(const std::string& sentence, const Place& place) {
  to_standard_error(sentence);
  console().head["error"] = note(sentence, place);
}

Json& answer() { return console().result; }

bool answers_in_json() { return console().options.json; }

void say_written(const std::string& file) {
  say("wrote {}\n", file);
  answer()["files"].push_back(file);
}

struct RunningNote::Impl {
  std::optional<Progress> terminal, log;
};

RunningNote::RunningNote() : impl_(std::make_unique<Impl>()) {
  if (!console().options.quiet) impl_->terminal.emplace(std::cerr, is_terminal());
  if (console().log.is_open()) impl_->log.emplace(console().log, /*terminal=*/false);
}

RunningNote::~RunningNote() = default;

void RunningNote::update(long done, long total, const std::string& note) {
  if (impl_->terminal) impl_->terminal->update(done, total, note);
  if (impl_->log) impl_->log->update(done, total, note);
}

}  // namespace latsch::cli
