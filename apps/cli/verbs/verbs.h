// SPDX-License-Identifier: Apache-2.0
// The verbs of the program, one file each. A verb adds itself to the app; when chosen it runs and
// sets the exit code.
#pragma once

#include "cli/console/command_line.h"

namespace latsch::cli {

/// Exit codes of the program.
inline constexpr int kDone = 0;  // it did what was asked
inline constexpr int kFailed =
    1;  // the run failed: no trial succeeded, the journal cannot be written, interrupted
inline constexpr int kWrongInput = 2;  // wrong arguments or wrong files

void add_new(CommandLine& app, int& exit_code);
void add_check(CommandLine& app, int& exit_code);
void add_mesh(CommandLine& app, int& exit_code);
void add_simulate(CommandLine& app, int& exit_code);
void add_evaluate(CommandLine& app, int& exit_code);
void add_doe(CommandLine& app, int& exit_code);
void add_run(CommandLine& app, int& exit_code);  // run and resume
void add_identify(CommandLine& app, int& exit_code);
void add_pareto(CommandLine& app, int& exit_code);
void add_report(CommandLine& app, int& exit_code);
void add_doctor(CommandLine& app, int& exit_code);
void add_export(CommandLine& app, int& exit_code);
void add_compare(CommandLine& app, int& exit_code);
void add_road(CommandLine& app, int& exit_code);
void add_test(CommandLine& app, int& exit_code);
void add_footprint(CommandLine& app, int& exit_code);
void add_ring(CommandLine& app, int& exit_code);
void add_show(CommandLine& app, int& exit_code);
void add_help(CommandLine& app, int& exit_code);
void add_process(CommandLine& app, int& exit_code);
void add_worker(CommandLine& app, int& exit_code);  // hidden: what run and doe start

}  // namespace latsch::cli
