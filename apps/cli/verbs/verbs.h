// SPDX-License-Identifier: Apache-2.0
// The verbs of the program, each in a file of its own. An add_...() function adds the verb to the
// command line; if the user chooses the verb, it runs and sets the exit code.
#pragma once

#include "cli/console/command_line.h"
#include "experiment/language.h"

namespace latsch::cli {

/// Exit codes of the program.
inline constexpr int kDone = 0;  // the request was carried out
/// The run failed: no trial succeeded, the journal cannot be written, or a model is not accepted.
inline constexpr int kFailed = 1;
inline constexpr int kWrongInput = 2;  // wrong arguments or wrong files
/// Ctrl-C or SIGTERM stopped the program on request, which is no failure. The number is that of
/// shells, 128 + SIGINT.
inline constexpr int kStopped = 130;

/// Data that all verbs share: the program's models and tests, and its exit code.
struct Program {
  const experiment::Language& language;  // available models and tests
  int exit_code = kDone;
};

void add_new(CommandLine& app, Program& program);
void add_check(CommandLine& app, Program& program);
void add_mesh(CommandLine& app, Program& program);
void add_simulate(CommandLine& app, Program& program);
void add_doe(CommandLine& app, Program& program);
void add_run(CommandLine& app, Program& program);  // run and resume
void add_identify(CommandLine& app, Program& program);
void add_serve(CommandLine& app, Program& program);
void add_pareto(CommandLine& app, Program& program);
void add_report(CommandLine& app, Program& program);
void add_doctor(CommandLine& app, Program& program);
void add_validate(CommandLine& app, Program& program);
void add_export(CommandLine& app, Program& program);
void add_compare(CommandLine& app, Program& program);
void add_road(CommandLine& app, Program& program);
void add_test(CommandLine& app, Program& program);
void add_show(CommandLine& app, Program& program);
void add_help(CommandLine& app, Program& program);
void add_process(CommandLine& app, Program& program);
/// not listed in the help: run and doe start it
void add_worker(CommandLine& app, Program& program);

}  // namespace latsch::cli
