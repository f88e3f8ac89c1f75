// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal/journal.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "base/random.h"
#include "base/scratch_folder_testing.h"
#include "evaluation/journal/journal_history_testing.h"
#include "evaluation/journal/journal_lock.h"
#include "evaluation/journal/journal_testing.h"
#include "evaluation/journal/local_file_system.h"
#include "evaluation/trial/encoding.h"

namespace {
int error_of_locks = 0;  // 0: locks work
}

/// Replaces the system's flock(2) in this program, so that tests can make it fail.
extern "C" int flock(int file, int operation) {
  if (error_of_locks == 0) return static_cast<int>(::syscall(SYS_flock, file, operation));
  errno = error_of_locks;
  return -1;
}

namespace latsch {
namespace {

std::string host() {
  char name[256] = {};
  ::gethostname(name, sizeof name - 1);
  return name;
}

std::string read_bytes(const std::filesystem::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

TEST(Journal, GivesBackEveryBitOfEveryTrial) {
  const ScratchFolder folder;
  {
    Journal journal = Journal::open(folder / "a.journal", kStudy);
    journal.append(trial(1));
    journal.append(failed_trial(2));
  }
  Journal journal = Journal::open(folder / "a.journal", kStudy);
  journal.append(trial(3));
  const std::vector<Trial> trials = journal.trials();
  ASSERT_EQ(trials.size(), 3u);
  EXPECT_EQ(journal.size(), 3);
  expect_same(trials[0], trial(1));
  expect_same(trials[1], failed_trial(2));
  expect_same(trials[2], trial(3));
  EXPECT_EQ(journal.identity(), kStudy);
}

TEST(Journal, RefusesAnotherStudyAndSaysWhatDiffers) {
  const ScratchFolder folder;
  { Journal::open(folder / "a.journal", kStudy); }
  const auto open_as = [&](const StudyIdentity& study) {
    return complaint([&] { Journal::open(folder / "a.journal", study); });
  };
  expect_contains(open_as({{"model", "a = 1\nb = 3\n"}, kStudy[1]}),
                  "\"model\" differs in line 2: the journal has `b = 2`, the study has `b = 3`");
  expect_contains(open_as({{"model", "a = 1\n"}, kStudy[1]}), "line 2");
  expect_contains(open_as({kStudy[0]}), "it has \"variables\"");
  expect_contains(open_as({kStudy[0], kStudy[1], {"rig", ""}}), "it has no \"rig\"");
}

TEST(Journal, IsReadForItsOwnStudyAlone) {
  const ScratchFolder folder;
  StudyIdentity other = kStudy;
  other.back().text += "x";
  { Journal::open(folder / "a", kStudy); }
  EXPECT_EQ(Journal::read(folder / "a", kStudy).size(), 0);
  expect_contains(complaint([&] { Journal::read(folder / "a", other); }),
                  "belongs to another study");
}

TEST(Journal, RefusesForeignFilesAndOtherVersions) {
  const ScratchFolder folder;
  const auto open = [&](const char* name) {
    return complaint([&] { Journal::open(folder / name, kStudy); });
  };
  write_bytes(folder / "text", "this is a text that is no database at all, and long enough to see");
  expect_contains(open("text"), "is not a journal");
  SQLite::Database((folder / "other").string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
      .exec("CREATE TABLE t (a)");
  expect_contains(open("other"), "not a journal");
  write_bytes(folder / "empty", "");
  expect_contains(complaint([&] { Journal::read(folder / "empty"); }), "is empty");
  { Journal::open(folder / "newer", kStudy); }
  SQLite::Database((folder / "newer").string(), SQLite::OPEN_READWRITE)
      .exec("PRAGMA user_version = 99");
  expect_contains(open("newer"), "format 99");
  expect_contains(open("no_such_folder/a"), "cannot write beside it");
  expect_contains(complaint([&] { Journal::read(folder / "absent"); }), "does not exist");
}

TEST(Journal, PackedTrialsAreTheSameAfterAnyNumberOfOpenings) {
  const ScratchFolder folder;
  constexpr int kTrials = 150;  // more trials than a block of packed rows has
  for (int i = 0; i < kTrials;) {
    Journal journal = Journal::open(folder / "a", kStudy);
    for (int group = 0; group < 40 && i < kTrials; ++group) journal.append(long_trial(i++));
  }
  const std::vector<Trial> trials = Journal::read(folder / "a").trials();
  ASSERT_EQ(std::ssize(trials), kTrials);
  for (int i = 0; i < kTrials; ++i) expect_same(trials[i], long_trial(i));
  EXPECT_LT(std::filesystem::file_size(folder / "a"), kTrials * 1200 * sizeof(double) / 2);
}

TEST(Journal, RemembersItsMarksAndDetectsThatOneIsSpoiled) {
  const ScratchFolder folder;
  {
    Journal journal = Journal::open(folder / "a", kStudy);
    journal.append(trial(1));
    journal.mark("start", "study A");
    journal.append(trial(2));
    journal.append(trial(3));
    journal.mark("retry", "all");
  }
  const std::vector<JournalMark> marks{{"start", "study A", 1}, {"retry", "all", 3}};
  EXPECT_EQ(Journal::open(folder / "a", kStudy).marks(), marks);
  EXPECT_EQ(examine_journal(folder / "a").marks, marks);
  for (const char* spoiled : {"UPDATE marks SET text = 'none' WHERE number = 2",
                              "UPDATE marks SET trials = 2 WHERE number = 1",
                              "DELETE FROM marks WHERE number = 2"}) {
    std::filesystem::copy_file(
        folder / "a", folder / "b", std::filesystem::copy_options::overwrite_existing);
    SQLite::Database((folder / "b").string(), SQLite::OPEN_READWRITE).exec(spoiled);
    expect_contains(complaint([&] { Journal::read(folder / "b"); }), "marks");
    EXPECT_FALSE(examine_journal(folder / "b").healthy());
    EXPECT_EQ(examine_journal(folder / "b").rows.size(), 3u);
  }
}

TEST(Journal, IsReadWhereItsProgramIsNotInstalled) {
  const ScratchFolder folder;
  StudyIdentity with = kStudy;
  with.push_back({kProgramFilesPart, "ccx: 9 bytes, 0123\n"});
  { Journal::open(folder / "a", with); }
  EXPECT_EQ(Journal::read(folder / "a", kStudy).identity(), with);
  expect_contains(complaint([&] { Journal::open(folder / "a", kStudy); }), "program files");
}

TEST(Journal, AGroupOfTrialsIsKeptAsAWhole) {
  const ScratchFolder folder;
  const std::vector<Trial> group{trial(1), failed_trial(2), trial(3)};
  {
    Journal journal = Journal::open(folder / "a.journal", kStudy);
    journal.append(group);
    EXPECT_EQ(journal.size(), 3);
  }
  const std::vector<Trial> trials = Journal::read(folder / "a.journal").trials();
  ASSERT_EQ(trials.size(), 3u);
  for (int i = 0; i < 3; ++i) expect_same(trials[i], group[i]);
}

TEST(Journal, ASecondWriterIsToldWhoHoldsItAndReadersMayComeIn) {
  const ScratchFolder folder;
  Journal writer = Journal::open(folder / "a.journal", kStudy);
  writer.append(trial(1));
  const std::string text = complaint([&] { Journal::open(folder / "a.journal", kStudy); });
  expect_contains(text, "in use by process " + std::to_string(::getpid()));
  const Journal reader = Journal::read(folder / "a.journal");
  EXPECT_EQ(reader.trials().size(), 1u);
  writer.append(trial(2));
  EXPECT_EQ(reader.trials().size(), 2u);
}

// If a writer is killed while it starts a worker, the child process still holds the lock until it
// executes the worker program.
TEST(Journal, OfAKilledWriterWhoseChildIsOnItsWayItIsFreeAfterAMoment) {
  const ScratchFolder folder;
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t writer = ::fork();
  if (writer == 0) {
    const Journal journal = Journal::open(folder / "a", kStudy);
    if (::fork() == 0) {
      const char byte = 1;
      if (::write(ready[1], &byte, 1) != 1) std::_Exit(1);
      ::usleep(300'000);
      std::_Exit(0);
    }
    ::pause();
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  ::kill(writer, SIGKILL);
  ::waitpid(writer, nullptr, 0);
  Journal journal = Journal::open(folder / "a", kStudy);
  journal.append(trial(1));
  EXPECT_EQ(journal.size(), 1);
}

TEST(Journal, WhoWritesItIsToldWithoutTakingTheLock) {
  const ScratchFolder folder;
  EXPECT_FALSE(journal_holder(folder / "a.journal"));
  {
    const Journal journal = Journal::open(folder / "a.journal", kStudy);
    const auto holder = journal_holder(folder / "a.journal");
    ASSERT_TRUE(holder);
    EXPECT_EQ(holder->process, ::getpid());
    expect_contains(holder->words, std::to_string(::getpid()));
  }
  EXPECT_FALSE(journal_holder(folder / "a.journal"));
  write_bytes(folder / "a.journal.lock", "process 1 on " + host() + " since 2026-03-01\n");
  EXPECT_FALSE(journal_holder(folder / "a.journal")) << "a lock file that a kill has left behind";
  write_bytes(folder / "a.journal.lock", "process 1 on elsewhere since 2026-03-01\n");
  const auto far = journal_holder(folder / "a.journal");
  ASSERT_TRUE(far);
  EXPECT_FALSE(far->process);
}

/// While an object of this class exists, flock(2) fails with the given error in this program.
class FailingLocks {
 public:
  explicit FailingLocks(int error) { error_of_locks = error; }
  ~FailingLocks() { error_of_locks = 0; }
};

TEST(Journal, AFileSystemWithoutLocksIsNotCalledInUse) {
  const ScratchFolder folder;
  for (const int error : {ENOLCK, ENOSYS, EOPNOTSUPP, EIO}) {
    const FailingLocks locks(error);
    const std::string text = complaint([&] { Journal::open(folder / "a", kStudy); });
    expect_contains(text, std::string("cannot be locked (") + std::strerror(error));
    expect_contains(text, "journal = \"...\" in [run]");
    EXPECT_EQ(text.find("in use"), std::string::npos) << text;
  }
  const FailingLocks locks(EWOULDBLOCK);
  expect_contains(complaint([&] { Journal::open(folder / "a", kStudy); }), "in use by another");
}

// Hard links in two folders have different lock files.
TEST(Journal, OneThatIsOpenIsInUseUnderItsHardLinks) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder / "deep");
  {
    Journal writer = Journal::open(folder / "a", kStudy);
    writer.append(trial(1));
    for (const char* link : {"b", "deep/c"}) {
      std::filesystem::create_hard_link(folder / "a", folder / link);
      const std::string text = complaint([&] { Journal::open(folder / link, kStudy); });
      expect_contains(text, "in use by process " + std::to_string(::getpid()));
      expect_contains(text, "hard link");
      EXPECT_FALSE(std::filesystem::exists(folder / (std::string(link) + ".lock")));
    }
    writer.append(trial(2));
  }
  Journal writer = Journal::open(folder / "b", kStudy);
  EXPECT_EQ(writer.size(), 2);
  expect_contains(complaint([&] { Journal::open(folder / "a", kStudy); }), "hard link");
}

// A killed writer leaves its log under the name by which it opened the journal.
TEST(Journal, AHardLinkWithoutTheLogOfAKilledWriterIsRefused) {
  const ScratchFolder folder;
  const pid_t writer = ::fork();
  if (writer == 0) {
    Journal journal = Journal::open(folder / "a", kStudy, Journal::Log::write_ahead);
    journal.append(trial(1));
    std::_Exit(0);  // ends without closing the journal
  }
  ::waitpid(writer, nullptr, 0);
  ASSERT_TRUE(std::filesystem::exists(folder / "a-wal"));
  std::filesystem::create_hard_link(folder / "a", folder / "b");
  expect_contains(complaint([&] { Journal::open(folder / "b", kStudy); }), "open it by that name");
  EXPECT_EQ(Journal::open(folder / "a", kStudy).size(), 1);
  // The log was merged when the journal was opened.
  EXPECT_EQ(Journal::open(folder / "b", kStudy).size(), 1);
}

/// Runs `action` and returns the message of the JournalError that it throws.
template <class Action>
std::string loss(Action&& action) {
  try {
    action();
  } catch (const JournalError& error) {
    return error.what();
  }
  return "";
}

TEST(Journal, OneThatIsDeletedWhileItIsWrittenKeepsItsTrials) {
  for (const Journal::Log log : {Journal::Log::write_ahead, Journal::Log::rollback}) {
    const ScratchFolder folder;
    const bool is_rollback = log == Journal::Log::rollback;
    {
      Journal writer = Journal::open(folder / "a.journal", kStudy, log);
      writer.append(trial(1));
      std::filesystem::remove(folder / "a.journal");
      const std::string text = loss([&] { writer.append(trial(2)); });
      expect_contains(text, "was deleted while it was written");
      expect_contains(text, "saved under its name again");
      EXPECT_EQ(loss([&] { writer.append(trial(3)); }), text);
      EXPECT_EQ(loss([&] { writer.trials(); }), text);
    }
    Journal again = Journal::open(folder / "a.journal", kStudy, log);
    EXPECT_EQ(again.trials().size(), is_rollback ? 1u : 2u);
    again.append(trial(4));
  }
}

TEST(Journal, AReaderOfItsOwnTrialsNoticesThatItWasDeleted) {
  const ScratchFolder folder;
  Journal writer = Journal::open(folder / "a.journal", kStudy);
  writer.append(trial(1));
  std::filesystem::remove(folder / "a.journal");
  expect_contains(loss([&] { writer.trials(); }), "its 1 trials are saved");
}

TEST(Journal, OneThatIsReplacedWhileItIsWrittenKeepsItsTrialsBesideIt) {
  const ScratchFolder folder;
  { Journal::open(folder / "other", kStudy).append(trial(7)); }
  {
    Journal writer = Journal::open(folder / "a.journal", kStudy);
    writer.append(trial(1));
    std::filesystem::rename(folder / "other", folder / "a.journal");
    const std::string text = loss([&] { writer.append(trial(2)); });
    expect_contains(text, "was replaced by another file");
    expect_contains(text, "its 2 trials are saved in " + (folder / "a.saved.journal").string());
  }
  EXPECT_EQ(Journal::open(folder / "a.saved.journal", kStudy).trials().size(), 2u);
  const std::vector<Trial> others = Journal::open(folder / "a.journal", kStudy).trials();
  ASSERT_EQ(others.size(), 1u);  // the log of the first journal was not applied to the other one
  expect_same(others[0], trial(7));
}

TEST(Journal, OneThatIsMovedWhileItIsWrittenSaysWhereItIs) {
  const ScratchFolder folder;
  {
    Journal writer = Journal::open(folder / "a.journal", kStudy);
    writer.append(trial(1));
    std::filesystem::rename(folder / "a.journal", folder / "b.journal");
    expect_contains(loss([&] { writer.append(trial(2)); }),
                    "was moved to " + (folder / "b.journal").string());
  }
  EXPECT_EQ(Journal::open(folder / "b.journal", kStudy).trials().size(), 2u);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.journal"));
}

TEST(Journal, OneThatIsOpenIsInUseUnderEveryNameItHas) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder / "deep");
  std::filesystem::create_symlink("../a", folder / "deep" / "link");
  { Journal::open(folder / "a", kStudy); }
  const Journal writer = Journal::open(folder / "deep" / "link", kStudy);
  for (const auto& name : {folder / "a", folder / "deep" / "link", folder / "deep/../a"}) {
    expect_contains(complaint([&] { Journal::open(name, kStudy); }), "in use by process");
  }
}

TEST(Journal, LeavesNoLockBehind) {
  const ScratchFolder folder;
  { Journal::open(folder / "a.journal", kStudy); }
  { Journal::open(folder / "a.journal", kStudy); }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.journal.lock"));
}

// A file-size limit makes write(2) fail as on a full disk.
TEST(Journal, OnAFullDiskNothingIsLostAndWritingGoesOnOnceThereIsRoom) {
  const ScratchFolder folder;
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_IGN);
  long written = 0;
  {
    Journal journal = Journal::open(folder / "a.journal", kStudy);
    const rlimit tight{120'000, before.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &tight);
    const std::string text = complaint([&] {
      for (int i = 0; i < 10'000; ++i, ++written) journal.append(trial(i));
    });
    ::setrlimit(RLIMIT_FSIZE, &before);
    expect_contains(text, "the disk is full");
    expect_contains(text, std::to_string(written) + " trials in it are safe");
    EXPECT_GT(written, 10);
    journal.append(trial(static_cast<int>(written++)));
  }
  const Journal journal = Journal::read(folder / "a.journal");
  const std::vector<Trial> trials = journal.trials();
  ASSERT_EQ(static_cast<long>(trials.size()), written);
  for (long i = 0; i < written; ++i) expect_same(trials[i], trial(static_cast<int>(i)));
}

// Expects that reading either returns the trials as written or reports that the file is damaged.
void expect_intact_or_detected(const std::filesystem::path& file, int trials, const char* what) {
  try {
    const Journal journal = Journal::read(file);
    const std::vector<Trial> read = journal.trials();
    ASSERT_EQ(static_cast<int>(read.size()), trials) << what;
    for (int i = 0; i < trials; ++i) expect_same(read[i], trial(i));
    EXPECT_EQ(journal.identity(), kStudy) << what;
  } catch (const JournalError&) {
  } catch (const InputError&) {
  }
}

// ./bench.sh faults repeats this test with many more seeds.
TEST(Journal, APowerLossLosesNothingThatWasAcknowledged) {
  for (const auto log : {Journal::Log::write_ahead, Journal::Log::rollback}) {
    long sectors = 0, while_open = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const PowerHistory history = live_through_power_loss(seed, log);
      EXPECT_EQ(history.wrong, "") << "seed " << seed << ", log " << static_cast<int>(log);
      sectors += history.sectors_lost;
      while_open += history.while_open;
    }
    EXPECT_GT(sectors, 100);  // confirms that unsynced data existed
    EXPECT_GT(while_open, 10);
  }
}

TEST(Journal, OnlyAFileSystemKnownToBeLocalGetsAWriteAheadLog) {
  for (const unsigned long local : {0xEF53ul,
                                    0x58465342ul,
                                    0x9123683Eul,
                                    0x01021994ul,
                                    0x794C7630ul,
                                    0x2FC12FC1ul,
                                    0xF2F52010ul,
                                    0xFFFFFFFFF2F52010ul}) {
    EXPECT_EQ(shared_file_system(local), std::nullopt) << std::hex << local;
  }
  EXPECT_EQ(shared_file_system(0x6969), "NFS");
  // A 32-bit number whose sign was extended.
  EXPECT_EQ(shared_file_system(0xFFFFFFFFFF534D42), "CIFS");
  // The numbers belong to file systems of VirtualBox and VMware folders, of Coda, Orange, IBM and
  // Quantum, and to an unknown one.
  for (const unsigned long shared :
       {0x786F4256ul, 0xBACBACBCul, 0x73757245ul, 0x20030528ul, 0x7ul}) {
    EXPECT_NE(shared_file_system(shared), std::nullopt) << std::hex << shared;
  }
  const ScratchFolder folder;
  { Journal::open(folder / "local", kStudy); }
  EXPECT_EQ(shared_file_system(folder / "local"), std::nullopt);
  EXPECT_EQ(shared_file_system("/proc/self/j"),
            "a file system that is not known to be local (0x9FA0)");
}

TEST(Journal, OnANetworkFileSystemThereIsNoSharedMemory) {
  const ScratchFolder folder;
  const auto file = folder / "j";
  // The journal is written on a local disk; afterwards it is opened as one on a network file
  // system.
  Journal::open(file, kStudy, Journal::Log::write_ahead).append(trial(1));
  Journal journal = Journal::open(file, kStudy, Journal::Log::rollback);
  for (int i = 2; i <= 5; ++i) {
    journal.append(trial(i));
    EXPECT_EQ(Journal::read(file).size(), i);
    EXPECT_FALSE(std::filesystem::exists(folder / "j-wal"));
    EXPECT_FALSE(std::filesystem::exists(folder / "j-shm"));
  }
  expect_contains(complaint([&] { Journal::open(file, kStudy, Journal::Log::rollback); }),
                  "is in use by process");
}

// Without the syncs, equal power losses do cost trials, which shows that the simulated disk loses
// data as a real one may.
TEST(PowerLoss, WhatIsNotSyncedMayBeGone) {
  int lost = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const ScratchFolder folder;
    PowerLoss disk(seed, 1'000'000);
    {
      SQLite::Database database((folder / "d").string(),
                                SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
      database.exec("PRAGMA journal_mode = WAL");
      // With synchronous = NORMAL, SQLite does not sync at each commit.
      database.exec("PRAGMA synchronous = NORMAL; CREATE TABLE t (i INTEGER)");
      database.exec("INSERT INTO t VALUES (1)");
      disk.fail();
    }
    disk.come_back();
    try {
      SQLite::Database database((folder / "d").string());
      lost += database.execAndGet("SELECT count(*) FROM t").getInt() == 0;
    } catch (const SQLite::Exception&) {
      ++lost;
    }
  }
  EXPECT_GT(lost, 3);
}

TEST(Journal, ABitFlipIsDetectedOrChangesNothing) {
  const ScratchFolder folder;
  constexpr int kTrials = 40;
  {
    Journal journal = Journal::open(folder / "a.journal", kStudy);
    for (int i = 0; i < kTrials; ++i) journal.append(trial(i));
  }
  const std::string whole = read_bytes(folder / "a.journal");
  RandomStream random(1, 0);
  for (int flip = 0; flip < 1000; ++flip) {
    std::string bytes = whole;
    bytes[random.below(bytes.size())] ^= static_cast<char>(1u << random.below(8));
    write_bytes(folder / "b.journal", bytes);
    expect_intact_or_detected(folder / "b.journal", kTrials, "bit flip");
  }
}

TEST(Journal, ATruncatedFileOrAZeroedPageIsDetectedOrChangesNothing) {
  const ScratchFolder folder;
  constexpr int kTrials = 40;
  {
    Journal journal = Journal::open(folder / "a.journal", kStudy);
    for (int i = 0; i < kTrials; ++i) journal.append(trial(i));
  }
  const std::string whole = read_bytes(folder / "a.journal");
  for (std::size_t at = 0; at < whole.size(); at += 1024) {
    write_bytes(folder / "b.journal", whole.substr(0, at));
    expect_intact_or_detected(folder / "b.journal", kTrials, "truncated");
    std::string zeroed = whole;
    zeroed.replace(at, std::min<std::size_t>(1024, whole.size() - at), 1024, '\0');
    zeroed.resize(whole.size());
    write_bytes(folder / "b.journal", zeroed);
    expect_intact_or_detected(folder / "b.journal", kTrials, "zeroed");
  }
}

TEST(Journal, ADamagedRowIsNamed) {
  const ScratchFolder folder;
  {
    Journal journal = Journal::open(folder / "a.journal", kStudy);
    for (int i = 0; i < 5; ++i) journal.append(trial(i));
  }
  const auto spoil = [&](const char* statement) {
    std::filesystem::copy_file(folder / "a.journal",
                               folder / "b.journal",
                               std::filesystem::copy_options::overwrite_existing);
    SQLite::Database((folder / "b.journal").string(), SQLite::OPEN_READWRITE).exec(statement);
    return complaint([&] { Journal::read(folder / "b.journal").trials(); });
  };
  expect_contains(spoil("UPDATE trials SET point = zeroblob(24) WHERE number = 3"),
                  "trial 3 does not agree with its hash");
  expect_contains(spoil("DELETE FROM trials WHERE number = 2"), "trial 2 is missing");
  expect_contains(spoil("DELETE FROM trials WHERE number = 5"), "trial 5 is missing or the tally");
  expect_contains(spoil("UPDATE identity SET text = 'x' WHERE position = 1"), "\"model\"");
}

TEST(Encoding, RejectsWhatIsNotOneEncodedValue) {
  const std::string bytes = encode(trial(1).outcome);
  EXPECT_TRUE(decode_outcome(bytes));
  EXPECT_FALSE(decode_outcome(bytes + "x"));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(decode_outcome(std::string_view(bytes).substr(0, size)));
  }
  const std::string none = encode(Outcome{.result = Channels{}});
  const std::string head = none.substr(0, none.size() - 8);
  EXPECT_FALSE(decode_outcome(head + std::string(8, '\xff')));  // a count of 2^64 - 1
}

}  // namespace
}  // namespace latsch
