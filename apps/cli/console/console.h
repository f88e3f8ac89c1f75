// SPDX-License-Identifier: Apache-2.0
// The output of the program: its receivers and its forms. There is one console, as there is one
// standard output.
//
//   say      a sentence or a table for a person: standard output; not with --quiet or --json
//   note     the same where standard output carries data: standard error
//   put      requested data, a table to be piped on: standard output, also with --quiet
//   warn     what a person should know: standard error; "warnings" of the JSON answer
//   complain why it ended: standard error; "error" of the JSON answer
//   answer   the same results for a program, printed at the end with --json
//
// With --json standard output is one JSON object whatever happens:
//   {"verb": "run", "exit_code": 0, "status": "done", "warnings": [], "result": {...}}
//   {"verb": "run", "exit_code": 2, "status": "wrong input", "warnings": [], "error": {"message":
//    "...", "file": "...", "line": 7}}
// "status" is "done", "failed", "wrong input" or "stopped"; who stops a run gets no "error".
// A log file gets all of say, warn, complain and the progress, appended, with the time of the start
// and of the end.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>

#include "base/error.h"
#include "formats/text/json.h"

namespace latsch::cli {

/// Options of every verb.
struct CommonOptions {
  bool json = false, quiet = false;
  std::string log;  // name of the log file; empty: none
};

/// Called once, before the verb runs. Throws InputError if the log file cannot be written.
void open_console(const CommonOptions& options, const std::string& verb, const std::string& line);
/// Prints the JSON answer and ends the log; returns the exit code.
int close_console(int exit_code);

/// For a signal handler: writes the JSON answer of a verb that was stopped, without results, if one
/// was requested.
void answer_stopped();

/// Silences this process: it works for another one, and nobody reads its answer.
void be_silent();

void say_text(std::string_view text);
template <class... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  say_text(fmt::format(format, std::forward<Arguments>(arguments)...));
}

void put(std::string_view data);

/// Prints lines for a person where standard output carries data: on standard error, not with
/// --quiet or --json; and in the log.
void note_text(std::string_view text);

/// Reports one sentence, without "latsch: " and line end.
void warn(const std::string& sentence, const Place& place = {});
/// The count of warnings so far.
int warnings();
void complain(const std::string& sentence, const Place& place = {});

/// The result for programs; empty until a verb fills it.
Json& answer();
/// True if the answer is printed.
bool answers_in_json();
/// Says "wrote FILE" and names the file in the answer.
void say_written(const std::string& file);

/// Shows the progress of a run: on standard error unless --quiet, and in the log.
class RunningNote {
 public:
  RunningNote();
  ~RunningNote();
  /// `total` is 0 if unknown.
  void update(long done, long total, const std::string& note);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::cli
