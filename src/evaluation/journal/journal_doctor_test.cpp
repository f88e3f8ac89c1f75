// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal/journal_doctor.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <map>

#include "base/error.h"
#include "base/file.h"
#include "base/random.h"
#include "base/scratch_folder_testing.h"
#include "evaluation/journal/journal.h"
#include "evaluation/trial/encoding.h"

namespace latsch {
namespace {

const StudyIdentity kPatient{{"model", "a = 1\nb = 2\n"}, {"variables", "E: layer.E\n"}};

/// Returns a trial. Every second one has long channels of random numbers, so that its row extends
/// to overflow pages and no row is packed by reference to another.
Trial patient_trial(int number) {
  RandomStream random(static_cast<std::uint64_t>(number), 0);
  std::vector<double> values(number % 2 ? 20 : 1200);
  for (double& value : values) value = random.uniform();
  Channels channels;
  channels.add({"Fz", "N", values});
  return {{{1.0 / 3.0, 1.0 * number}}, {channels, 1.5, 1.25, 0}};
}

void write_journal(const std::filesystem::path& file, int trials) {
  Journal journal = Journal::open(file, kPatient);
  for (int i = 1; i <= trials; ++i) journal.append(patient_trial(i));
}

void put_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

/// Expects that every row of the report, looked up by its point, is as written. Returns true if no
/// row is missing.
bool all_authentic(const JournalReport& report, int trials, const std::string& what) {
  for (const auto& row : report.rows) {
    const auto read = row.decode();
    EXPECT_TRUE(read) << what;
    if (!read) return false;
    const int number = static_cast<int>(read->point.values[1]);
    EXPECT_TRUE(encode(read->outcome) == encode(patient_trial(number).outcome)) << what;
    EXPECT_TRUE(read->point == patient_trial(number).point) << what;
  }
  return std::ssize(report.rows) == trials;
}

TEST(JournalDoctor, ACommitThatDidNotComeToItsEndIsNoDamage) {
  const ScratchFolder folder;
  const auto file = folder / "a";
  {
    Journal journal = Journal::open(file, kPatient, Journal::Log::rollback);
    for (int i = 1; i <= 12; ++i) journal.append(patient_trial(i));
  }
  const pid_t child = ::fork();
  if (child == 0) {  // the process ends during a commit that has already reached the file
    SQLite::Database database(file.string(), SQLite::OPEN_READWRITE);
    database.exec("PRAGMA cache_size = 1; BEGIN; UPDATE trials SET point = zeroblob(9000)");
    ::_exit(0);
  }
  ::waitpid(child, nullptr, 0);
  ASSERT_TRUE(std::filesystem::exists(folder / "a-journal"));
  try {
    (void)Journal::read(file);
    ADD_FAILURE() << "what is half written was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("resume puts it in order"), std::string::npos);
  }
  const std::string before = read_text_file(file);
  const JournalReport report = examine_journal(file);
  EXPECT_TRUE(report.healthy()) << report.findings.front();
  EXPECT_TRUE(all_authentic(report, 12, "unfinished"));
  EXPECT_EQ(report.notes.size(), 1u);
  EXPECT_EQ(read_text_file(file), before);  // the file itself is never changed
  EXPECT_EQ(Journal::open(file, kPatient).size(), 12);
}

TEST(JournalDoctor, AHealthyJournalIsCalledHealthyAndSalvagedToTheSameTrials) {
  const ScratchFolder folder;
  write_journal(folder / "a", 12);
  const JournalReport report = examine_journal(folder / "a");
  EXPECT_TRUE(report.healthy()) << report.findings.front();
  EXPECT_EQ(report.expected, 12);
  EXPECT_EQ(report.format, 5);
  EXPECT_TRUE(all_authentic(report, 12, "healthy"));
  salvage_journal(report, std::nullopt, folder / "b");
  const auto trials = Journal::open(folder / "b", kPatient).trials();
  ASSERT_EQ(trials.size(), 12u);
  for (int i = 0; i < 12; ++i) {
    EXPECT_TRUE(encode(trials[i].outcome) == encode(patient_trial(i + 1).outcome));
  }
  EXPECT_THROW(salvage_journal(report, std::nullopt, folder / "b"), InputError);
}

// Every change of a written byte is detected, and costs only the trials whose bytes were changed.
TEST(JournalDoctor, NoDamageIsTakenForDataAndIntactTrialsAreSaved) {
  const ScratchFolder folder;
  constexpr int kTrials = 30;
  write_journal(folder / "a", kTrials);
  const std::string whole = read_text_file(folder / "a");
  RandomStream random(5, 0);
  for (int i = 0; i < 100; ++i) {
    std::string bytes = whole;
    bytes[random.below(bytes.size())] ^= static_cast<char>(1u << random.below(8));
    put_bytes(folder / "b", bytes);
    const JournalReport report = examine_journal(folder / "b");
    const bool all = all_authentic(report, kTrials, "bit flip");
    EXPECT_TRUE(all || !report.healthy());
    EXPECT_GE(std::ssize(report.rows), kTrials - 1);
  }
  for (std::size_t at = 0; at < whole.size(); at += 4096) {
    std::string bytes = whole;
    bytes.replace(at, std::min<std::size_t>(4096, whole.size() - at), 4096, '\0');
    bytes.resize(whole.size());
    put_bytes(folder / "b", bytes);
    const JournalReport report = examine_journal(folder / "b");
    const bool all = all_authentic(report, kTrials, "zeroed page");
    EXPECT_TRUE(all || !report.healthy()) << at;
    EXPECT_GE(std::ssize(report.rows), kTrials / 2) << at;
    put_bytes(folder / "b", whole.substr(0, at));
    const JournalReport shorter = examine_journal(folder / "b");
    EXPECT_FALSE(shorter.healthy()) << at;
    all_authentic(shorter, kTrials, "truncated");
  }
}

TEST(JournalDoctor, ForeignFilesAndOtherVersionsAreNamed) {
  const ScratchFolder folder;
  const auto findings = [&](const char* name) {
    std::string all;
    for (const std::string& finding : examine_journal(folder / name).findings) all += finding;
    return all;
  };
  put_bytes(folder / "text", "this is no database at all, but a text that is long enough");
  EXPECT_NE(findings("text").find("not a database"), std::string::npos) << findings("text");
  EXPECT_NE(findings("text").find("STUDY.latsch"), std::string::npos) << findings("text");
  SQLite::Database((folder / "other").string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
      .exec("CREATE TABLE t (a)");
  EXPECT_NE(findings("other").find("is not marked as a journal"), std::string::npos);
  write_journal(folder / "newer", 3);
  SQLite::Database((folder / "newer").string(), SQLite::OPEN_READWRITE)
      .exec("PRAGMA user_version = 99");
  EXPECT_NE(findings("newer").find("format 99"), std::string::npos);
  EXPECT_THROW(examine_journal(folder / "absent"), InputError);
}

TEST(JournalDoctor, ADamagedIdentityNeedsTheStudyToBeSaved) {
  const ScratchFolder folder;
  write_journal(folder / "a", 4);
  SQLite::Database((folder / "a").string(), SQLite::OPEN_READWRITE)
      .exec("UPDATE identity SET text = 'x' WHERE position = 1");
  const JournalReport report = examine_journal(folder / "a");
  EXPECT_FALSE(report.healthy());
  EXPECT_FALSE(report.identity);
  EXPECT_THROW(salvage_journal(report, std::nullopt, folder / "b"), InputError);
  salvage_journal(report, kPatient, folder / "b");
  EXPECT_EQ(Journal::open(folder / "b", kPatient).size(), 4);
}

// The log is in the state in which a killed writer leaves it.
TEST(JournalDoctor, DamageInTheLogIsFoundAndTheTrialsInItAreSaved) {
  const ScratchFolder folder;
  Journal journal = Journal::open(folder / "a", kPatient);
  for (int i = 1; i <= 10; ++i) journal.append(patient_trial(i));
  const std::string database = read_text_file(folder / "a");
  const std::string log = read_text_file(folder / "a-wal");
  ASSERT_GT(log.size(), 50'000u);
  RandomStream random(6, 0);
  for (int i = 0; i < 50; ++i) {
    std::string bytes = log;
    bytes[random.below(bytes.size())] ^= static_cast<char>(1u << random.below(8));
    std::filesystem::remove(folder / "b-shm");
    put_bytes(folder / "b", database);
    put_bytes(folder / "b-wal", bytes);
    const JournalReport report = examine_journal(folder / "b");
    const bool all = all_authentic(report, 10, "log");
    EXPECT_TRUE(all || !report.healthy() || !report.notes.empty());
    EXPECT_GE(std::ssize(report.rows), 9);
  }
}

}  // namespace
}  // namespace latsch
