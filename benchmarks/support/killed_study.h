// SPDX-License-Identifier: Apache-2.0
// A study that is killed and resumed, and what has become of it.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "evaluation/trial/trial.h"

namespace latsch::benchmarks {

/// Writes a study of two variables to the folder whose trials, an awk program, take `pause` seconds
/// and a few milliseconds.
std::filesystem::path write_small_study(const std::filesystem::path& folder, double pause);

/// Starts a program, its output thrown away.
pid_t start(const std::vector<std::string>& arguments);

/// latsch VERB STUDY --workers N
pid_t start_latsch(const std::string& verb, const std::filesystem::path& study, int workers);

/// Exit code of the program, -1 where a signal ended it.
int end_of(pid_t child);

/// None while there is no journal.
std::vector<Trial> trials_of(const correlation::Study& study);

/// Until the journal, read beside the run that writes it, has so many. Throws std::runtime_error
/// after a minute.
void wait_for_trials(const correlation::Study& study, long count);

/// The whole trajectory, bit by bit; empty where it did not converge.
std::string trajectory(const correlation::Study& study);

/// How many of the trials before are not, bit by bit, at their place after.
long count_lost(const std::vector<Trial>& before, const std::vector<Trial>& after);

/// Trials whose point had been evaluated before.
long count_repeated(const std::vector<Trial>& trials);

/// Processes that have the text in their command line.
std::vector<pid_t> processes_with(const std::string& text);

}  // namespace latsch::benchmarks
