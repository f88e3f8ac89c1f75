// SPDX-License-Identifier: Apache-2.0
// Tests that a follower visits exactly the trials that a complete read returns, each once.
#include "evaluation/journal/journal_follower.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "base/scratch_folder_testing.h"
#include "evaluation/journal/journal.h"

namespace latsch {
namespace {

const StudyIdentity kFollowed{{"model", "a = 1\n"}, {"variables", "E: layer.E\n"}};

Trial trial_with(int number) {
  Channels channels;
  channels.add({"Fz", "N", std::vector<double>(30, 1000.0 + 0.25 * number)});
  return {{{1.0 * number}}, {channels, 0.5, 0.25, 0}};
}

class Followed : public testing::Test {
 protected:
  std::filesystem::path file() const { return folder_ / "study.latsch"; }
  /// Returns the values of the points that read() visits.
  std::vector<double> news(long most = 1000) {
    std::vector<double> points;
    last_ = follower_.read(most, [&](const Trial& trial) {
      EXPECT_EQ(trial.outcome.result->all().front().values.front(),
                1000.0 + 0.25 * trial.point.values.front());
      points.push_back(trial.point.values.front());
    });
    return points;
  }

  ScratchFolder folder_;
  JournalFollower follower_{folder_ / "study.latsch"};
  JournalFollower::News last_;
};

TEST_F(Followed, AJournalThatIsNotThereYetHasNoTrials) {
  EXPECT_TRUE(news().empty());
  Journal::open(file(), kFollowed).append(trial_with(7));
  EXPECT_EQ(news(), std::vector<double>{7.0});
  EXPECT_FALSE(last_.begins_anew);
}

TEST_F(Followed, EveryTrialIsHandedOnOnceWhileAnotherWrites) {
  Journal journal = Journal::open(file(), kFollowed);
  std::vector<double> seen;
  for (int i = 0; i < 40; ++i) {
    journal.append(trial_with(i));
    // A read may visit no trial at all, or fewer than there are.
    for (const double one : news(i % 3)) seen.push_back(one);
  }
  while (true) {
    const auto more = news(7);
    seen.insert(seen.end(), more.begin(), more.end());
    if (!last_.has_more) break;
  }
  ASSERT_EQ(seen.size(), 40u);
  for (int i = 0; i < 40; ++i) EXPECT_EQ(seen[i], i);
  EXPECT_EQ(follower_.total(), 40);
  EXPECT_TRUE(news().empty());
}

TEST_F(Followed, MarksAreToldWhenTheyChange) {
  Journal journal = Journal::open(file(), kFollowed);
  journal.append(trial_with(1));
  news();
  EXPECT_FALSE(last_.has_marks);
  journal.mark("asked", "1f");
  news();
  EXPECT_TRUE(last_.has_marks);
  ASSERT_EQ(follower_.marks().size(), 1u);
  EXPECT_EQ(follower_.marks()[0].text, "1f");
  news();
  EXPECT_FALSE(last_.has_marks);
}

TEST_F(Followed, AJournalInTheOthersPlaceIsReadFromItsBeginning) {
  {
    Journal journal = Journal::open(file(), kFollowed);
    for (int i = 0; i < 3; ++i) journal.append(trial_with(i));
  }
  EXPECT_EQ(news().size(), 3u);
  std::filesystem::rename(file(), folder_ / "study.1.latsch");
  Journal::open(file(), kFollowed).append(trial_with(9));
  EXPECT_TRUE(news().empty());
  EXPECT_TRUE(last_.begins_anew);
  EXPECT_EQ(news(), std::vector<double>{9.0});
  EXPECT_FALSE(last_.begins_anew);
}

// After the command cp other.latsch study.latsch, study.latsch still has the same inode.
TEST_F(Followed, AJournalCopiedOverTheOtherIsReadFromItsBeginning) {
  const auto other = folder_ / "other.latsch";
  const auto write = [](const std::filesystem::path& path, int first, int count) {
    Journal journal = Journal::open(path, kFollowed);
    for (int i = 0; i < count; ++i) journal.append(trial_with(first + i));
  };
  write(file(), 0, 3);
  write(other, 10, 5);
  EXPECT_EQ(news().size(), 3u);
  EXPECT_TRUE(news().empty());
  std::filesystem::copy_file(other, file(), std::filesystem::copy_options::overwrite_existing);
  EXPECT_TRUE(news().empty());
  EXPECT_TRUE(last_.begins_anew);
  EXPECT_EQ(news(), (std::vector{10.0, 11.0, 12.0, 13.0, 14.0}));
  EXPECT_FALSE(last_.begins_anew);
  EXPECT_TRUE(news().empty());
  EXPECT_EQ(follower_.total(), 5);
  // A journal to which trials were only added counts as the same journal.
  write(file(), 15, 1);
  EXPECT_EQ(news(), std::vector{15.0});
  EXPECT_FALSE(last_.begins_anew);
}

TEST_F(Followed, ADamagedRowIsNamedAndThoseBeforeItAreGood) {
  {
    Journal journal = Journal::open(file(), kFollowed);
    for (int i = 0; i < 3; ++i) journal.append(trial_with(i));
  }
  SQLite::Database(file().string(), SQLite::OPEN_READWRITE)
      .exec("UPDATE trials SET point = x'0000000000000000' WHERE number = 3");
  std::vector<double> points;
  try {
    follower_.read(10, [&](const Trial& trial) { points.push_back(trial.point.values.front()); });
    ADD_FAILURE() << "the damage was not seen";
  } catch (const JournalError& error) {
    EXPECT_NE(std::string(error.what()).find("trial 3"), std::string::npos) << error.what();
  }
  EXPECT_EQ(points, (std::vector{0.0, 1.0}));
}

TEST_F(Followed, AFileThatIsNoJournalIsRefusedInWords) {
  std::ofstream(file()) << "deflection,force\n";
  EXPECT_THROW(news(), InputError);
}

}  // namespace
}  // namespace latsch
