// SPDX-License-Identifier: Apache-2.0
// The output of the program: where it goes and in which form. A process has one console, as it has
// one standard output.
//
//   say      a sentence or a table for a person: standard output; not with --quiet or --json
//   note     the same if standard output carries data: standard error
//   put      requested data, a table to be piped on: standard output, also with --quiet
//   warn     a possible problem, for a person: standard error; "warnings" of the JSON answer
//   complain the reason why the verb failed: standard error; "error" of the JSON answer
//   answer   the results for a program, printed at the end with --json
//
// With --json standard output is one JSON object in every case:
//   {"verb": "run", "exit_code": 0, "status": "done", "warnings": [], "result": {...}}
//   {"verb": "run", "exit_code": 2, "status": "wrong input", "warnings": [], "error": {"message":
//    "...", "file": "...", "line": 7}}
// "status" is "done", "failed", "wrong input" or "stopped"; a run that the user stops has no
// "error". All output of say, warn, complain and the progress is appended to the log file, with the
// time of the start and of the end.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>

#include "base/error.h"
#include "formats/text/json.h"

namespace latsch::cli {

/// Options that every verb has.
struct CommonOptions {
  bool json = false, quiet = false;
  std::string log;  // name of the log file; empty: none
};

/// Opens the console; called once, before the verb runs. Throws InputError if the log file cannot
/// be written.
void open_console(const CommonOptions& options, const std::string& verb, const std::string& line);
/// Prints the JSON answer and ends the log; returns the exit code.
int close_console(int exit_code);

/// Writes the JSON answer of a stopped verb, without results, if JSON was requested. A signal
/// handler may call it.
void answer_stopped();

/// Silences this process. A worker calls it, because nobody reads its messages.
void be_silent();

void say_text(std::string_view text);
template <class... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  say_text(fmt::format(format, std::forward<Arguments>(arguments)...));
}

void put(std::string_view data);

/// Prints lines for a person on standard error if standard output carries data, and in the log.
/// Prints nothing on standard error with --quiet or --json.
void note_text(std::string_view text);

/// Reports a warning: one sentence, without "latsch: " before it and without line end.
void warn(const std::string& sentence, const Place& place = {});
/// Returns the number of warnings so far.
int warnings();
void complain(const std::string& sentence, const Place& place = {});

/// Returns the result for the JSON answer, which the verb fills; it is empty at first.
Json& answer();
/// True if the answer is printed as JSON (--json).
bool answers_in_json();
/// Says "wrote FILE" and names the file in the answer.
void say_written(const std::string& file);

/// Shows the progress of a run: on standard error unless --quiet, and in the log.
class RunningNote {
 public:
  RunningNote();
  ~RunningNote();
  /// Shows that `done` of `total` trials are finished; `total` is 0 if unknown.
  void update(long done, long total, const std::string& note);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::cli
