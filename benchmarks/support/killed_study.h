// SPDX-License-Identifier: Apache-2.0
// A small study for benchmarks that kill and resume runs, and checks of its state.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "evaluation/trial/trial.h"

namespace latsch::benchmarks {

/// Writes a study of two variables to the folder. Its trials are an awk program that takes `pause`
/// seconds and a few milliseconds.
std::filesystem::path write_small_study(const std::filesystem::path& folder, double pause);

/// Starts a program and discards its output.
pid_t start(const std::vector<std::string>& arguments);

/// Starts latsch VERB STUDY --workers N.
pid_t start_latsch(const std::string& verb, const std::filesystem::path& study, int workers);

/// Returns the exit code of the program, -1 if a signal ended it.
int end_of(pid_t child);

/// Returns the trials in the study's journal; an empty list if there is no journal yet.
std::vector<Trial> trials_of(const correlation::Study& study);

/// Waits until the journal, which a run is writing, has `count` trials. Throws std::runtime_error
/// after a minute.
void wait_for_trials(const correlation::Study& study, long count);

/// Returns the search path as text, exact to the bit; empty if the search did not converge.
std::string trajectory(const correlation::Study& study);

/// Counts the trials of the earlier list that are not at the same position of the later one, with
/// the same bits.
long count_lost(const std::vector<Trial>& before, const std::vector<Trial>& after);

/// Counts the trials whose point occurs at an earlier position.
long count_repeated(const std::vector<Trial>& trials);

/// Returns processes that have the text in their command line.
std::vector<pid_t> processes_with(const std::string& text);

}  // namespace latsch::benchmarks
