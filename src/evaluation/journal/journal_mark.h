// SPDX-License-Identifier: Apache-2.0
// Event in a journal between two of its trials (journal_format.h).
#pragma once

#include <string>

namespace latsch {

struct JournalMark {
  std::string kind;
  std::string text;
  long trials = 0;  // number of trials when the mark was made

  bool operator==(const JournalMark&) const = default;
};

}  // namespace latsch
