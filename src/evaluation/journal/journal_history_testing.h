// SPDX-License-Identifier: Apache-2.0
// Test support: a journal that is written until the power fails, and the conditions that it has to
// fulfill when the power returns.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "base/scratch_folder_testing.h"
#include "evaluation/journal/journal.h"
#include "evaluation/journal/journal_doctor.h"
#include "evaluation/journal/power_loss_testing.h"
#include "evaluation/trial/encoding.h"

namespace latsch {

struct PowerHistory {
  long acknowledged = 0;  // number of trials acknowledged when the power failed
  long kept = 0;
  long sectors_lost = 0;
  bool while_open = false;  // true if the power failed before the journal was closed
  /// The broken condition; empty if nothing acknowledged was lost or changed.
  std::string wrong;
};

/// Returns a trial that depends only on its number. Every fifth trial is large, so that some test
/// runs reach a checkpoint of SQLite's log.
inline Trial trial_of_history(long number) {
  Channels channels;
  channels.add(
      {"Fz",
       "N",
       std::vector<double>(number % 5 == 0 ? 60'000 : 20, 1.5 * static_cast<double>(number))});
  return {{{static_cast<double>(number)}}, {channels, 1.5, 1.25, 0}};
}

inline constexpr int kLargestGroup = 3;

/// Writes groups of trials, closing and opening the journal now and then, until the power fails.
inline void write_until_loss(const std::filesystem::path& file,
                             const StudyIdentity& study,
                             Journal::Log log,
                             RandomStream& random,
                             const PowerLoss& disk,
                             PowerHistory& history) {
  constexpr long kTrials = 80;
  try {
    while (history.acknowledged < kTrials && !disk.failed()) {
      Journal journal = Journal::open(file, study, log);
      for (std::uint64_t group = 0; group < 1 + random.below(30); ++group) {
        std::vector<Trial> trials;
        for (std::uint64_t i = 0; i < 1 + random.below(kLargestGroup); ++i) {
          trials.push_back(trial_of_history(history.acknowledged + 1 + std::ssize(trials)));
        }
        journal.append(trials);
        history.acknowledged += std::ssize(trials);
      }
    }
  } catch (const JournalError&) {
    history.while_open = true;
  } catch (const InputError&) {
    history.while_open = true;
  }
}

inline PowerHistory live_through_power_loss(std::uint64_t seed, Journal::Log log) {
  const ScratchFolder folder;
  const auto file = folder / "j";
  const StudyIdentity study{{"model", "a square"}};
  RandomStream random(seed, 8);
  PowerHistory history;
  {
    PowerLoss disk(seed, 1 + static_cast<long>(random.below(900)));
    write_until_loss(file, study, log, random, disk, history);
    disk.come_back();
    history.sectors_lost = disk.sectors_lost();
  }
  try {
    Journal journal = Journal::open(file, study, log);
    const std::vector<Trial> trials = journal.trials();
    history.kept = std::ssize(trials);
    for (long i = 0; i < history.kept; ++i) {
      const Trial written = trial_of_history(i + 1);
      if (trials[i].point == written.point &&
          encode(trials[i].outcome) == encode(written.outcome)) {
        continue;
      }
      history.wrong = "trial " + std::to_string(i + 1) + " is not what was written";
    }
    if (history.kept < history.acknowledged) history.wrong = "an acknowledged trial is lost";
    if (history.kept > history.acknowledged + kLargestGroup)
      history.wrong = "more trials than were written";
    journal.append(trial_of_history(history.kept + 1));
  } catch (const std::exception& error) {
    history.wrong = error.what();
  }
  if (history.wrong.empty() && !examine_journal(file).healthy()) history.wrong = "not healthy";
  return history;
}

}  // namespace latsch
