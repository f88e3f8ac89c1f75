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

TEST(LedgerOfAFile, OfAScriptSaysThatItIsTakenWhole) {
  Ledger script{"/studies/quarter_car.py"};
  script.rows.push_back({.written = "quarter_car.py", .taken_as = "outside program"});
  EXPECT_EQ(in_one_line(script), "1 column: 0 used, 1 not used (`quarter_car.py`)");
  Ledger::use(script.rows.front(), "test response");
  EXPECT_EQ(in_one_line(script), "taken whole, as outside program");
  Ledger table{"/studies/x.csv"};  // one column is no file
  table.rows.push_back({.written = "x", .taken_as = "x"});
  Ledger::use(table.rows.front(), "test response");
  EXPECT_EQ(in_one_line(table), "1 column: 1 used");
}

TEST(LedgerOfAFile, FindsNoAssumedRowByAnEmptyName) {
  EXPECT_EQ(some_ledger().find_written(""), nullptr);
  EXPECT_EQ(some_ledger().find_taken(""), nullptr);
}

}  // namespace
}  // namespace latsch
