// SPDX-License-Identifier: Apache-2.0
// A study that is killed and resumed, and checks of its state.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "evaluation/trial/trial.h"

namespace latsch::benchmarks {

/// Writes a study of two variables to the folder. Its trials, an awk program, take `pause` seconds
/// and a few milliseconds.
std::filesystem::path write_small_study(const std::filesystem::path& folder, double pause);

/// Starts a program and discards its output.
pid_t start(const std::vector<std::string>& arguments);

/// Starts latsch VERB STUDY --workers N.
pid_t start_latsch(const std::string& verb, const std::filesystem::path& study, int workers);

/// Returns the exit code of the program, -1 if a signal ended it.
int end_of(pid_t child);

/// Returns the trials; none while there is no journal.
std::vector<Trial> trials_of(const correlation::Study& study);

/// Waits until the journal, read while the run writes it, has `count` trials. Throws
/// std::runtime_error after a minute.
void wait_for_trials(const correlation::Study& study, long count);

/// Returns the whole path, bit by bit; empty if it did not converge.
std::string trajectory(const correlation::Study& study);

/// Counts the earlier trials that are not found, bit by bit, at the same position later.
long count_lost(const std::vector<Trial>& before, const std::vector<Trial>& after);

/// Counts the trials whose point had been evaluated before.
long count_repeated(const std::vector<Trial>& trials);

/// Returns processes that have the text in their command line.
std::vector<pid_t> processes_with(const std::string& text);

}  // namespace latsch::benchmarks
