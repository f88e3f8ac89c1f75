// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>

#include "base/error.h"

namespace latsch {
namespace {

class File : public testing::Test {
 protected:
  File() : folder_(testing::TempDir() + "latsch_file_test_" + std::to_string(getpid())) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~File() override { std::filesystem::remove_all(folder_); }

  long entries() const { return std::distance(std::filesystem::directory_iterator(folder_), {}); }

  std::filesystem::path folder_;
};

std::string complaint_of_writing(const std::filesystem::path& file, std::string_view text) {
  try {
    write_text_file(file, text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(File, TextComesBackAndNoTemporaryFileStays) {
  const std::string text = std::string(200000, 'x') + '\0' + "\r\nä";
  write_text_file(folder_ / "a", "old");
  write_text_file(folder_ / "a", text);
  EXPECT_EQ(read_text_file(folder_ / "a"), text);
  EXPECT_EQ(entries(), 1);
}

TEST_F(File, ReadingNamesPathAndReason) {
  EXPECT_THROW(read_text_file(folder_), InputError);
  write_text_file(folder_ / "a", "12345");
  EXPECT_EQ(read_text_file(folder_ / "a", 5), "12345");
  EXPECT_THROW(read_text_file(folder_ / "a", 4), InputError);
}

TEST_F(File, AMissingFolderIsNamed) {
  const auto file = folder_ / "none" / "a";
  EXPECT_EQ(complaint_of_writing(file, "x"),
            file.string() + ": cannot be written: No such file or directory");
}

// A limit on the size of files ends a write as a full disk does: part is written, then an error.
TEST_F(File, AWriteThatEndsEarlyLeavesTheOldFile) {
  write_text_file(folder_ / "a", "old");
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4096, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string complaint = complaint_of_writing(folder_ / "a", std::string(100000, 'x'));
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(complaint, (folder_ / "a").string() + ": cannot be written: File too large");
  EXPECT_EQ(read_text_file(folder_ / "a"), "old");
  EXPECT_EQ(entries(), 1);
}

TEST_F(File, AFullDiskIsNamed) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  // A temporary file that leads to the full device.
  const auto file = folder_ / "a";
  std::filesystem::create_symlink("/dev/full",
                                  file.string() + "." + std::to_string(::getpid()) + ".tmp");
  EXPECT_EQ(complaint_of_writing(file, "x"),
            file.string() + ": cannot be written: No space left on device");
  EXPECT_EQ(entries(), 0);
}

}  // namespace
}  // namespace latsch
