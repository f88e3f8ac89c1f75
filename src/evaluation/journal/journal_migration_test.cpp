// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal/journal_migration.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "base/scratch_folder_testing.h"
#include "evaluation/journal/journal.h"
#include "evaluation/journal/journal_doctor.h"
#include "evaluation/journal/journal_testing.h"

namespace latsch {
namespace {

// Writes a journal as the program of format 1 did, with the tables and hashes of that format.
void write_format_1(const std::filesystem::path& file, int trials) {
  SQLite::Database database(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  database.exec(R"(PRAGMA application_id = 0x4C747368; PRAGMA user_version = 1;
      CREATE TABLE identity (position INTEGER PRIMARY KEY, name TEXT, text TEXT, hash INTEGER);
      CREATE TABLE trials (number INTEGER PRIMARY KEY, point BLOB, outcome BLOB, finished TEXT,
                           hash INTEGER);
      CREATE TABLE tally (only INTEGER PRIMARY KEY, trials INTEGER, hash INTEGER))");
  std::uint64_t state = kHashStart;
  for (std::size_t i = 0; i < kStudy.size(); ++i) {
    state = hash(kStudy[i].text, hash(kStudy[i].name + "\n", state));
    SQLite::Statement insert(database, "INSERT INTO identity VALUES (?, ?, ?, ?)");
    insert.bind(1, static_cast<int>(i) + 1);
    insert.bind(2, kStudy[i].name);
    insert.bind(3, kStudy[i].text);
    insert.bind(4, static_cast<std::int64_t>(state));
    insert.exec();
  }
  const std::string finished = "2026-01-01T00:00:00Z";
  for (int i = 1; i <= trials; ++i) {
    const Trial t = i % 2 ? trial(i) : failed_trial(i);
    const std::string point = encode(t.point), outcome = encode(t.outcome);
    for (const std::string& part : {std::to_string(i), point, outcome, finished}) {
      state = hash(part, hash(std::to_string(part.size()) + ":", state));
    }
    SQLite::Statement insert(database, "INSERT INTO trials VALUES (?, ?, ?, ?, ?)");
    insert.bind(1, i);
    insert.bind(2, point.data(), static_cast<int>(point.size()));
    insert.bind(3, outcome.data(), static_cast<int>(outcome.size()));
    insert.bind(4, finished);
    insert.bind(5, static_cast<std::int64_t>(state));
    insert.exec();
  }
  SQLite::Statement tally(database, "INSERT INTO tally VALUES (1, ?, ?)");
  tally.bind(1, trials);
  tally.bind(2, static_cast<std::int64_t>(state));
  tally.exec();
}

TEST(JournalMigration, AnOlderFormatIsReadAndMigratedWithABackup) {
  const ScratchFolder folder;
  const auto file = folder / "old";
  write_format_1(file, 6);
  EXPECT_EQ(Journal::read(file).trials().size(), 6u);
  EXPECT_FALSE(std::filesystem::exists(folder / "old.format1"));  // reading changes nothing
  {
    Journal journal = Journal::open(file, kStudy);
    EXPECT_EQ(journal.size(), 6);
    journal.append(trial(7));
  }
  const std::vector<Trial> trials = Journal::open(file, kStudy).trials();
  ASSERT_EQ(trials.size(), 7u);
  for (int i = 1; i <= 7; ++i) {
    expect_same(trials[i - 1], i % 2 ? trial(i) : failed_trial(i));
  }
  EXPECT_EQ(Journal::read(folder / "old.format1").trials().size(), 6u);
}

// A journal of format 4 is one of format 5 without slopes; only the number differs.
TEST(JournalMigration, FormatFourIsReadAndMigratedWithABackup) {
  const ScratchFolder folder;
  const auto file = folder / "old";
  {
    Journal journal = Journal::open(file, kStudy);
    for (int i = 0; i < 70; ++i) journal.append(long_trial(i));
    journal.mark("start", "before");
  }
  SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 4");
  EXPECT_EQ(Journal::read(file).trials().size(), 70u);
  {
    Journal journal = Journal::open(file, kStudy);
    EXPECT_EQ(journal.marks().size(), 1u);
    Trial sloping = long_trial(70);
    Channels channels;
    for (Channel channel : sloping.outcome.result->all()) {
      channel.slopes.assign(3 * channel.values.size(), 0.5);
      channels.add(std::move(channel));
    }
    sloping.outcome.result = channels;
    journal.append(sloping);
  }
  const std::vector<Trial> trials = Journal::open(file, kStudy).trials();
  ASSERT_EQ(trials.size(), 71u);
  for (int i = 0; i < 70; ++i) expect_same(trials[i], long_trial(i));
  EXPECT_EQ(trials[70].outcome.result->find("Fy")->slopes, std::vector<double>(3 * 1200, 0.5));
  EXPECT_EQ(Journal::read(folder / "old.format4").trials().size(), 70u);
}

TEST(JournalMigration, ADamagedOlderFormatIsNotMigrated) {
  const ScratchFolder folder;
  write_format_1(folder / "old", 6);
  SQLite::Database((folder / "old").string(), SQLite::OPEN_READWRITE)
      .exec("UPDATE trials SET point = zeroblob(24) WHERE number = 3");
  expect_contains(complaint([&] { Journal::open(folder / "old", kStudy); }), "trial 3");
  EXPECT_FALSE(std::filesystem::exists(folder / "old.format1"));
}

TEST(JournalMigration, OfAnotherVersionOfTheModelItIsRefusedAndMayBeAdopted) {
  const ScratchFolder folder;
  const auto file = folder / "a";
  const auto versioned = [](const std::string& text) {
    StudyIdentity study = kStudy;
    study.push_back({kModelVersionPart, text});
    return study;
  };
  {
    // The journal of a program that stored no versions.
    Journal journal = Journal::open(file, kStudy);
    journal.append(trial(1));
    journal.mark("start", "x");
    journal.append(failed_trial(2));
  }
  expect_contains(complaint([&] { Journal::open(file, versioned("tire 2\n")); }),
                  "is older and does not contain its \"model version\"");
  expect_contains(complaint([&] { Journal::open(file, versioned("tire 2\n")); }), "--adopt");
  EXPECT_TRUE(Journal::adopt(file, versioned("tire 2\n")));
  EXPECT_FALSE(Journal::adopt(file, versioned("tire 2\n")));
  expect_contains(complaint([&] { Journal::open(file, versioned("tire 3\n")); }),
                  "the journal has `tire 2`, the study has `tire 3`");
  {
    Journal journal = Journal::open(file, versioned("tire 2\n"));
    EXPECT_EQ(journal.marks(), (std::vector<JournalMark>{{"start", "x", 1}}));
    journal.append(trial(3));
  }
  const std::vector<Trial> trials = Journal::read(file, versioned("tire 2\n")).trials();
  ASSERT_EQ(trials.size(), 3u);
  expect_same(trials[0], trial(1));
  expect_same(trials[1], failed_trial(2));
  EXPECT_TRUE(examine_journal(file).healthy());
  EXPECT_EQ(Journal::read(folder / "a.before_adoption", kStudy).size(), 2);
  StudyIdentity other = versioned("tire 3\n");
  other.front().text += "c = 3\n";
  expect_contains(complaint([&] { Journal::adopt(file, other); }), "belongs to another study");
}

}  // namespace
}  // namespace latsch
