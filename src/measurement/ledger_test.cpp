// SPDX-License-Identifier: Apache-2.0
#include "measurement/ledger.h"

#include <gtest/gtest.h>

namespace latsch {
namespace {

Ledger some_ledger() {
  Ledger ledger{"run4.dat"};
  ledger.rows.push_back({.written = "SA", .line = 2, .column = 3, .taken_as = "alpha"});
  ledger.rows.push_back({.written = "NFX"});
  ledger.rows.push_back({.written = "TSTC", .taken_as = "tread_center"});
  ledger.rows.push_back({.taken_as = "p", .state = LedgerState::assumed, .remark = "220 kPa"});
  return ledger;
}

TEST(LedgerOfAFile, CountsWhatIsUsedAndNamesWhatIsNot) {
  Ledger ledger = some_ledger();
  Ledger::use(*ledger.find_taken("alpha"), "test steady");
  Ledger::use(*ledger.find_written("SA"), "test steady");
  EXPECT_EQ(ledger.find_written("SA")->used_by, std::vector<std::string>{"test steady"});
  EXPECT_EQ(in_one_line(ledger),
            "3 columns: 1 used, 2 not used (`NFX`, `TSTC`), 1 assumed: p 220 kPa");
}

TEST(LedgerOfAFile, KeepsADoubtWhenARowIsUsed) {
  Ledger ledger = some_ledger();
  LedgerRow& row = *ledger.find_written("SA");
  row.state = LedgerState::doubtful;
  Ledger::use(row, "test steady");
  EXPECT_EQ(row.state, LedgerState::doubtful);
  EXPECT_NE(in_one_line(ledger).find("1 in doubt (`SA`)"), std::string::npos);
}

TEST(LedgerOfAFile, FindsNoAssumedRowByAnEmptyName) {
  EXPECT_EQ(some_ledger().find_written(""), nullptr);
  EXPECT_EQ(some_ledger().find_taken(""), nullptr);
}

}  // namespace
}  // namespace latsch
