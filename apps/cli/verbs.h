// SPDX-License-Identifier: Apache-2.0
// The verbs of the program, one file each. A verb adds itself to the app; when chosen it runs and
// sets the exit code.
#pragma once

#include <CLI/CLI.hpp>

namespace latsch::cli {

/// Exit codes of the program.
inline constexpr int kDone = 0;  // it did what was asked
inline constexpr int kFailed =
    1;  // the run failed: no trial succeeded, the journal cannot be written, interrupted
inline constexpr int kWrongInput = 2;  // wrong arguments or wrong files

void add_new(CLI::App& app, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_mesh(CLI::App& app, int& exit_code);
void add_simulate(CLI::App& app, int& exit_code);
void add_evaluate(CLI::App& app, int& exit_code);
void add_doe(CLI::App& app, int& exit_code);
void add_run(CLI::App& app, int& exit_code);  // run and resume
void add_identify(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
void add_doctor(CLI::App& app, int& exit_code);
void add_export(CLI::App& app, int& exit_code);
void add_compare(CLI::App& app, int& exit_code);
void add_road(CLI::App& app, int& exit_code);
void add_drum(CLI::App& app, int& exit_code);
void add_ring(CLI::App& app, int& exit_code);
void add_show(CLI::App& app, int& exit_code);
void add_process(CLI::App& app, int& exit_code);
void add_worker(CLI::App& app, int& exit_code);  // hidden: what run and doe start

}  // namespace latsch::cli
