// SPDX-License-Identifier: Apache-2.0
#include "evaluation/outside_program/simulator.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <thread>

#include "base/error.h"
#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "evaluation/trial/encoding.h"
#include "evaluation/trial/trial.h"

namespace latsch {
namespace {

namespace fs = std::filesystem;

DesignSpace simulator_space() {
  return DesignSpace({{.name = "k", .lower = 1.0, .upper = 1e4, .initial = 2.0}});
}

/// A study folder with a shell script as the outside program.
class SimulatorTest : public testing::Test {
 protected:
  Simulator simulator(const std::string& script) {
    std::ofstream(folder_ / "program.sh") << script;
    Simulator simulator;
    simulator.study_folder = folder_.path();
    simulator.scratch = folder_ / "scratch";
    simulator.arguments = {"/bin/sh", "program.sh", "in.txt"};
    simulator.inputs.push_back({"in.txt", InputTemplate("k = {k}\n", "in.txt", simulator_space())});
    simulator.copied = {"program.sh"};
    simulator.outputs = {reader_};
    return simulator;
  }

  Result<Channels> run(const std::string& script) {
    return evaluate(evaluator(simulator(script), simulator_space()), {{42.0}}).result;
  }

  std::string reason(const std::string& script) {
    const auto result = run(script);
    EXPECT_FALSE(result.ok());
    if (!result) cause_ = result.failure().cause;
    return result ? "" : result.failure().reason;
  }

  void expect_contains(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  }

  ScratchFolder folder_;
  OutputReader reader_{"out", "out.txt", OutputReader::Kind::keys, {{"f", "kN"}}, {}, {"force"}};
  Cause cause_ = Cause::point;
};

TEST_F(SimulatorTest, ReadsTheInputAndItsOutputBecomesChannelsInSi) {
  const auto channels = run("sed 's/k/force/' $1 > out.txt");
  ASSERT_TRUE(channels.ok()) << channels.failure().reason;
  EXPECT_EQ((*channels)["out/f"], std::vector<double>{42'000.0});
  EXPECT_EQ(channels->all().front().unit, "N");
  EXPECT_TRUE(fs::is_empty(folder_ / "scratch"));
}

// A file-size limit makes write(2) fail as on a full disk.
TEST_F(SimulatorTest, ADiskFilledByWhatAProgramPrintsIsNamed) {
  const Simulator printing = simulator("while echo a line of output; do :; done");
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{64 * 1024, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  const auto result = evaluate(evaluator(printing, simulator_space()), {{42.0}}).result;
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(result.ok());
  expect_contains(result.failure().reason, "the disk is full, nothing more can be written to ");
  EXPECT_EQ(result.failure().cause, Cause::transient);
  // The message does not mention a full disk if the disk is not full.
  expect_contains(reason("exit 3"), "\"/bin/sh\" exited with code 3");
}

TEST_F(SimulatorTest, HowAProgramFailedIsToldWithTheLastLineItPrinted) {
  const std::string text = reason("echo starting; echo 'no license' >&2; exit 3");
  expect_contains(text, "exited with code 3; it last printed \"no license\"");
  expect_contains(reason("kill -SEGV $$"), "killed by signal 11");
  Simulator absent = simulator("");
  absent.arguments = {"/no/such/program"};
  const auto result = evaluate(evaluator(absent, simulator_space()), {{1.0}}).result;
  expect_contains(result.failure().reason, "cannot start \"/no/such/program\"");
}

TEST_F(SimulatorTest, OutputsThatAreMissingOrNonsenseAreNamed) {
  expect_contains(reason("true"), "output \"out\": the program wrote no file out.txt");
  EXPECT_EQ(cause_, Cause::bad_output);
  expect_contains(reason("echo 'force = much' > out.txt"),
                  "output \"out\" (keys): out.txt:1 has \"much\" for force, expected a number");
  expect_contains(reason("echo 'Force = 2' > out.txt"), "holds no value of f");
  expect_contains(reason("echo 'force = nan' > out.txt"), "expected a finite number");
  expect_contains(reason("head -c 100000 /dev/urandom > out.txt"), "out.txt");
}

TEST_F(SimulatorTest, AProgramThatOverrunsItsTimeoutIsKilledWithAllItStarted) {
  Simulator slow =
      simulator("(sleep 1000; true) & echo $! > ../../child; echo waiting; sleep 1000");
  slow.timeout = 0.3;
  const auto outcome = evaluate(evaluator(slow, simulator_space()), {{42.0}});
  ASSERT_FALSE(outcome.result.ok());
  EXPECT_EQ(outcome.result.failure().cause, Cause::timeout);
  expect_contains(outcome.result.failure().reason, "took more than the 0.3 s allowed to it");
  EXPECT_LT(outcome.wall_time, 1.3);
  const pid_t child = std::stoi(read_text_file(folder_ / "child"));
  // Waits until the killed child's new parent has collected its exit status; until then it is a
  // zombie.
  while (::kill(child, 0) == 0) {
    const std::string stat = read_text_file(fs::path("/proc") / std::to_string(child) / "stat");
    if (stat.find(") Z ") != std::string::npos) break;
    std::this_thread::yield();
  }
}

TEST_F(SimulatorTest, ItsCpuTimeIsToldApartFromOurs) {
  const auto busy =
      evaluate(evaluator(simulator("i=0; while [ $i -lt 100000 ]; do i=$((i+1)); done; "
                                   "sed 's/k/force/' $1 > out.txt"),
                         simulator_space()),
               {{42.0}});
  ASSERT_TRUE(busy.result.ok()) << busy.result.failure().reason;
  EXPECT_GT(busy.program_time, 0.01);
  EXPECT_LT(busy.cpu_time, busy.program_time);
  const auto again = decode_outcome(encode(busy));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->program_time, busy.program_time);
}

TEST_F(SimulatorTest, TheFolderOfAFailedTrialIsKeptWhereThatIsAskedFor) {
  Simulator keeping = simulator("exit 1");
  keeping.keep_failed = true;
  const auto result = evaluate(evaluator(keeping, simulator_space()), {{42.0}}).result;
  ASSERT_FALSE(result.ok());
  expect_contains(result.failure().reason, "its folder is ");
  const fs::path kept = fs::directory_iterator(folder_ / "scratch")->path();
  EXPECT_EQ(read_text_file(kept / "in.txt"), "k = 42\n");
}

// A file of the folder's name stands for a folder that may not be written.
TEST_F(SimulatorTest, AFolderThatCannotBeCreatedIsToldWithAWayOut) {
  std::ofstream(folder_ / "scratch") << "no folder";
  std::string said;
  try {
    said = reason("exit 0");
  } catch (const InputError& error) {
    said = error.what();
  }
  expect_contains(said, "the folder in which the outside program runs cannot be created");
  expect_contains(said, "copy the study's folder");
}

TEST_F(SimulatorTest, TheNextTrialRemovesTheFolderOfOneThatWasKilled) {
  const pid_t killed = ::fork();
  if (killed == 0) ::_exit(0);
  ASSERT_EQ(::waitpid(killed, nullptr, 0), killed);
  std::array<char, 256> host{};
  ASSERT_EQ(::gethostname(host.data(), host.size() - 1), 0);
  const auto folder_of = [&](const std::string& process) {
    const fs::path path = folder_ / "scratch" / ("0-" + process);
    fs::create_directories(path);
    return path;
  };
  const fs::path abandoned = folder_of(fmt::format("{}-{}", host.data(), killed));
  const fs::path running = folder_of(fmt::format("{}-{}", host.data(), ::getppid()));
  const fs::path elsewhere = folder_of(fmt::format("{}.not-{}", host.data(), killed));
  reason("exit 1");
  EXPECT_FALSE(fs::exists(abandoned));
  EXPECT_TRUE(fs::exists(running));
  EXPECT_TRUE(fs::exists(elsewhere));
}

TEST_F(SimulatorTest, FilesThatAScriptNamesBesideItCountAsItsOwn) {
  const auto write = [&](const char* name, const char* text) {
    std::ofstream(folder_ / name) << text;
  };
  write("main.py", "import helper  # and open(\"table.csv\")\nout.txt, in.txt\n");
  write("helper.py", "from deep import f\n");
  write("deep.py", "f = 1\n");
  for (const char* other : {"table.csv", "other.py", "helper.csv", "out.txt", "in.txt", "a.latsch"})
    write(other, "1\n");
  Simulator python = simulator("true");
  python.arguments = {"/bin/sh", (folder_ / "main.py").string(), "in.txt"};
  std::vector<std::string> names;
  for (const fs::path& file : watched_files(python)) names.push_back(file.filename().string());
  EXPECT_EQ(names, (std::vector<std::string>{"deep.py", "helper.py", "table.csv"}));
  const StudyIdentity before = identity(python, simulator_space());
  write("other.py", "2\n");
  EXPECT_FALSE(difference(before, identity(python, simulator_space())));
  write("deep.py", "f = 2\n");
  expect_contains(*difference(before, identity(python, simulator_space())), "deep.py");
}

TEST_F(SimulatorTest, ItsIdentityIsProgramInputsReadersAndUnits) {
  const Simulator one = simulator("true");
  Simulator other = one;
  EXPECT_FALSE(difference(identity(one, simulator_space()), identity(other, simulator_space())));
  other.outputs.front().quantities.front().unit = "N";
  expect_contains(*difference(identity(one, simulator_space()), identity(other, simulator_space())),
                  "outputs");
  std::ofstream(folder_ / "program.sh") << "false";
  expect_contains(*difference(identity(simulator("true"), simulator_space()),
                              identity(simulator("false"), simulator_space())),
                  "inputs");
}

}  // namespace
}  // namespace latsch
