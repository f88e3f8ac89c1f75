// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <ostream>
#include <thread>

#include "base/error.h"
#include "base/mapped_file.h"
#include "base/scratch_folder_testing.h"

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

// A limit on the size of files ends a write as a full disk does: a part is written, then an error
// occurs.
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

/// Makes a device file in the folder of the test. Only root can do this, and some systems forbid
/// the use of such a device.
bool make_device(const std::filesystem::path& file, mode_t kind, unsigned major, unsigned minor) {
  return ::mknod(file.c_str(), kind | 0666, makedev(major, minor)) == 0 &&
         (kind == S_IFBLK || std::ifstream(file).good());
}

struct stat status_of(const std::filesystem::path& file) {
  struct stat status {};
  EXPECT_EQ(::lstat(file.c_str(), &status), 0) << file;
  return status;
}

/// Runs `action` in a child process. Returns true if `action` returned true there.
bool elsewhere(const std::function<bool()>& action) {
  const pid_t child = ::fork();
  if (child == 0) {
    const bool done = action();
    std::fflush(nullptr);
    ::_exit(done ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status == 0;
}

// Numbers of the devices: Linux' Documentation/admin-guide/devices.txt, 1:3 null and 1:7 full.
TEST_F(File, ADeviceIsWrittenToAndStays) {
  const auto null = folder_ / "null", full = folder_ / "full", link = folder_ / "link";
  if (!make_device(null, S_IFCHR, 1, 3) || !make_device(full, S_IFCHR, 1, 7)) {
    GTEST_SKIP() << "devices cannot be made here";
  }
  std::filesystem::create_symlink("full", link);
  EXPECT_EQ(complaint_of_writing(null, std::string(200000, 'x')), "");
  for (const auto& file : {full, link}) {
    EXPECT_EQ(complaint_of_writing(file, "x"),
              file.string() + ": cannot be written: No space left on device");
  }
  EXPECT_TRUE(S_ISCHR(status_of(null).st_mode));
  EXPECT_TRUE(S_ISCHR(status_of(full).st_mode));
  EXPECT_TRUE(S_ISLNK(status_of(link).st_mode));
  EXPECT_EQ(entries(), 3);
}

TEST_F(File, ADatabaseIsNoOutputWhateverItsName) {
  const auto journal = folder_ / "study.html";
  std::ofstream(journal, std::ios::binary) << "SQLite format 3" << '\0' << "trials";
  EXPECT_THROW(write_text_file(journal, "new"), InputError);
  EXPECT_NE(read_text_file(journal).find("trials"), std::string::npos);
  std::ofstream(journal, std::ios::binary) << "SQLite";
  write_text_file(journal, "new");
  EXPECT_EQ(read_text_file(journal), "new");
}

TEST_F(File, ADiskIsRefused) {
  // The major number 42 is reserved for demonstration, so no driver has it.
  const auto disk = folder_ / "disk";
  if (!make_device(disk, S_IFBLK, 42, 0)) GTEST_SKIP() << "devices cannot be made here";
  EXPECT_NE(complaint_of_writing(disk, "x").find("is a disk"), std::string::npos);
  EXPECT_TRUE(S_ISBLK(status_of(disk).st_mode));
  EXPECT_NE(complaint_of_writing(folder_, "x").find("is a folder"), std::string::npos);
}

TEST_F(File, APipeIsWrittenToAndStays) {
  const auto pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::string text(300000, 'x');  // more bytes than a pipe holds
  std::string read;
  std::thread reader([&] {
    std::ifstream written(pipe);
    read.assign(std::istreambuf_iterator<char>(written), {});
  });
  EXPECT_EQ(complaint_of_writing(pipe, text), "");
  reader.join();
  EXPECT_EQ(read, text);
  EXPECT_TRUE(S_ISFIFO(status_of(pipe).st_mode));
}

// No process writes into these pipes, so a reader that opened one would wait forever.
TEST_F(File, APipeIsRefusedAsAFileToRead) {
  const auto pipe = folder_ / "pipe", link = folder_ / "link";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::filesystem::create_symlink("pipe", link);
  for (const auto& name : {pipe, link}) {
    const auto complaint = [&](auto&& read) {
      try {
        read();
      } catch (const InputError& error) {
        return std::string(error.what());
      }
      return std::string();
    };
    EXPECT_NE(complaint([&] { read_text_file(name); }).find("is a pipe"), std::string::npos);
    EXPECT_NE(complaint([&] { read_settled_file(name, 10); }).find("is a pipe"), std::string::npos);
    EXPECT_NE(complaint([&] { MappedFile(name, 10); }).find("is a pipe"), std::string::npos);
  }
}

TEST_F(File, APipeWhoseReaderGoesIsAnErrorAndNotTheEnd) {
  const auto pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::thread reader([&] { ::close(::open(pipe.c_str(), O_RDONLY)); });
  EXPECT_EQ(complaint_of_writing(pipe, std::string(300000, 'x')),
            pipe.string() + ": cannot be written: Broken pipe");
  reader.join();
}

TEST_F(File, LinksStayAndTheFileTheyLeadToIsReplaced) {
  std::filesystem::create_directory(folder_ / "deep");
  const auto file = folder_ / "deep" / "file";
  write_text_file(file, "old");
  ASSERT_EQ(::chmod(file.c_str(), 0640), 0);
  std::filesystem::create_symlink("deep/second", folder_ / "first");
  std::filesystem::create_symlink("../third", folder_ / "deep" / "second");
  std::filesystem::create_symlink(std::filesystem::absolute(file), folder_ / "third");
  EXPECT_EQ(complaint_of_writing(folder_ / "first", "new"), "");
  EXPECT_EQ(read_text_file(file), "new");
  EXPECT_EQ(status_of(file).st_mode & 07777, 0640u);
  for (const char* link : {"first", "deep/second", "third"}) {
    EXPECT_TRUE(S_ISLNK(status_of(folder_ / link).st_mode)) << link;
  }
  EXPECT_EQ(entries(), 3);
}

TEST_F(File, ALinkToNothingMakesTheFileItNames) {
  std::filesystem::create_directory(folder_ / "deep");
  std::filesystem::create_symlink("deep/file", folder_ / "link");
  EXPECT_EQ(complaint_of_writing(folder_ / "link", "new"), "");
  EXPECT_EQ(read_text_file(folder_ / "deep" / "file"), "new");
  EXPECT_TRUE(S_ISLNK(status_of(folder_ / "link").st_mode));
}

TEST_F(File, LinksInACircleAreNamed) {
  std::filesystem::create_symlink("b", folder_ / "a");
  std::filesystem::create_symlink("a", folder_ / "b");
  EXPECT_EQ(complaint_of_writing(folder_ / "a", "x"),
            (folder_ / "a").string() + ": cannot be written: Too many levels of symbolic links");
  EXPECT_EQ(entries(), 2);
}

// The names that a temporary file may use are taken here by symbolic links to another user's file.
TEST_F(File, NoTemporaryFileFollowsALink) {
  write_text_file(folder_ / "theirs", "theirs");
  const auto file = folder_ / "a";
  for (int i = 0; i < 3; ++i) {
    const std::string number = i == 0 ? "" : "." + std::to_string(i - 1);
    std::filesystem::create_symlink(
        "theirs", file.string() + "." + std::to_string(::getpid()) + number + ".tmp");
  }
  EXPECT_EQ(complaint_of_writing(file, "x"), "");
  EXPECT_EQ(read_text_file(folder_ / "theirs"), "theirs");
  EXPECT_TRUE(S_ISREG(status_of(file).st_mode));
}

TEST_F(File, PermissionsHoldForWhoeverIsNotRoot) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs root to become somebody else";
  constexpr uid_t kNobody = 65534;
  const auto guarded = folder_ / "guarded";  // a write-protected file in a folder that is not
  write_text_file(guarded, "old");
  ASSERT_EQ(::chmod(guarded.c_str(), 0444), 0);
  ASSERT_EQ(::chmod(folder_.c_str(), 0777), 0);
  EXPECT_TRUE(elsewhere([&] {
    return ::setuid(kNobody) == 0 && complaint_of_writing(guarded, "x").ends_with("denied");
  }));
  EXPECT_EQ(read_text_file(guarded), "old");

  const auto given = folder_ / "given";  // a file in a write-protected folder
  write_text_file(given, "old and longer");
  ASSERT_EQ(::chmod(given.c_str(), 0666), 0);
  ASSERT_EQ(::chmod(folder_.c_str(), 0755), 0);
  EXPECT_TRUE(elsewhere(
      [&] { return ::setuid(kNobody) == 0 && complaint_of_writing(given, "new").empty(); }));
  EXPECT_EQ(read_text_file(given), "new");

  ASSERT_EQ(::chown(given.c_str(), kNobody, kNobody), 0);
  EXPECT_EQ(complaint_of_writing(given, "by root"), "");
  EXPECT_EQ(status_of(given).st_uid, kNobody);
}

TEST_F(File, WhatIsPrintedToIsWrittenToInItsTurn) {
  // `ours` is a link to the standard output of this process, as /dev/stdout is.
  const auto file = folder_ / "printed", ours = folder_ / "stdout";
  std::filesystem::create_symlink("/proc/self/fd/1", ours);
  for (const auto& name : {ours, file}) {
    EXPECT_TRUE(elsewhere([&] {
      const int open = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
      if (::dup2(open, STDOUT_FILENO) < 0) return false;
      std::printf("before\n");
      const bool done = complaint_of_writing(name, "text\n").empty();
      std::printf("after\n");
      return done;
    }));
    EXPECT_EQ(read_text_file(file), "before\ntext\nafter\n") << name;
  }
  EXPECT_TRUE(S_ISLNK(status_of(ours).st_mode));
}

TEST_F(File, AWriterThatThrowsLeavesTheOldFile) {
  write_text_file(folder_ / "a", "old");
  const auto throwing = [](std::ostream& out) {
    out << std::string(200000, 'x');
    throw InputError("no");
  };
  EXPECT_THROW(write_file(folder_ / "a", throwing), InputError);
  EXPECT_EQ(read_text_file(folder_ / "a"), "old");
  EXPECT_EQ(entries(), 1);
}

TEST(MappedFile, HoldsTheTextOfSmallAndLargeFiles) {
  const ScratchFolder folder;
  const std::string small = "a\nb\n", large(65u << 20, 'x');
  for (const std::string& text : {small, large, std::string()}) {
    write_text_file(folder / "file", text);
    EXPECT_TRUE(MappedFile(folder / "file", 1u << 30).text() == text) << text.size();
    EXPECT_TRUE(read_settled_file(folder / "file", 1u << 30) == text) << text.size();
  }
  EXPECT_THROW(MappedFile(folder / "none", 10), InputError);
  write_text_file(folder / "file", small);
  EXPECT_THROW(MappedFile(folder / "file", 2), InputError);
}

// The file grows while it is read, as a file does while a rig records into it.
TEST(MappedFile, AFileThatChangesWhileItIsReadIsRefused) {
  const ScratchFolder folder;
  write_text_file(folder / "file", std::string(32u << 20, 'x'));
  std::atomic<bool> stop = false, wrote = false;
  std::thread writer([&] {
    std::ofstream out(folder / "file", std::ios::app);
    while (!stop) {
      out << "more\n" << std::flush;
      wrote = true;
    }
  });
  while (!wrote) std::this_thread::yield();
  std::string found;
  try {
    MappedFile(folder / "file", 1u << 30);
  } catch (const InputError& error) {
    found = error.what();
  }
  stop = true;
  writer.join();
  EXPECT_NE(found.find("file: changed while it was read"), std::string::npos) << found;
}

// The system kills a program that reads a mapped page beyond the end of its file.
TEST(MappedFile, AFileThatIsCutAfterItWasOpenedKeepsItsText) {
  const ScratchFolder folder;
  const std::string text(65u << 20, 'x');
  write_text_file(folder / "file", text);
  const MappedFile mapped(folder / "file", 1u << 30);
  std::filesystem::resize_file(folder / "file", 100);
  EXPECT_TRUE(mapped.text() == text);
  mapped.let_go(text.size());
  EXPECT_TRUE(mapped.text() == text);
}

TEST(MappedFile, ALargeFileIsReadIntoMemoryIfThereIsNoTemporaryFolder) {
  const ScratchFolder folder;
  const std::string text(65u << 20, 'x');
  write_text_file(folder / "file", text);
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  ::setenv("TMPDIR", (folder / "none").c_str(), 1);
  const MappedFile mapped(folder / "file", 1u << 30);
  before ? ::setenv("TMPDIR", kept.c_str(), 1) : ::unsetenv("TMPDIR");
  std::filesystem::resize_file(folder / "file", 100);
  EXPECT_TRUE(mapped.text() == text);
}

TEST(MappedFile, ALargeFileThatChangesWhileItIsReadIsRefused) {
  const ScratchFolder folder;
  write_text_file(folder / "file", std::string(128u << 20, 'x'));
  std::atomic<bool> stop = false, wrote = false;
  std::thread writer([&] {
    std::ofstream out(folder / "file", std::ios::app);
    while (!stop) {
      out << "more\n" << std::flush;
      wrote = true;
    }
  });
  while (!wrote) std::this_thread::yield();
  std::string found;
  try {
    MappedFile(folder / "file", 1u << 30);
  } catch (const InputError& error) {
    found = error.what();
  }
  stop = true;
  writer.join();
  EXPECT_NE(found.find("file: changed while it was read"), std::string::npos) << found;
}

}  // namespace
}  // namespace latsch
