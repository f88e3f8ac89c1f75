// SPDX-License-Identifier: Apache-2.0
// What happened to a journal between two of its trials (journal_format.h).
#pragma once

#include <string>

namespace latsch {

struct JournalMark {
  std::string kind;
  std::string text;
  long trials = 0;  // there were when it was made

  bool operator==(const JournalMark&) const = default;
};

}  // namespace latsch
