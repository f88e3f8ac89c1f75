// SPDX-License-Identifier: Apache-2.0
#include "one_node_slurm.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <stdexcept>
#include <thread>

#include "base/file.h"

extern char** environ;

namespace latsch::benchmarks {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr auto kStart = std::chrono::seconds(30);  // limit for the start of Slurm
constexpr auto kEnd = std::chrono::seconds(5);     // limit for the end of a daemon

/// Returns ports that are free now. Another program could take one before Slurm does, but this is
/// unlikely.
std::array<int, 2> free_ports() {
  std::array<int, 2> sockets{}, ports{};
  for (int i = 0; i < 2; ++i) {
    sockets[i] = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const bound = reinterpret_cast<sockaddr*>(&address);
    if (::bind(sockets[i], bound, size) != 0 || ::getsockname(sockets[i], bound, &size) != 0) {
      throw std::runtime_error("no port is free");
    }
    ports[i] = ntohs(address.sin_port);
  }
  for (const int socket : sockets) ::close(socket);
  return ports;
}

std::string host_name() {
  std::array<char, 256> name{};
  ::gethostname(name.data(), name.size() - 1);
  const std::string all = name.data();
  return all.substr(0, all.find('.'));
}

void make_folder(const fs::path& folder, mode_t mode) {
  fs::create_directories(folder);
  ::chmod(folder.c_str(), mode);
}

/// Removes the environment variables of an MPI or Slurm job in which this program itself may run.
void forget_other_launchers() {
  std::vector<std::string> names;
  for (char** entry = environ; *entry; ++entry) {
    const std::string name(*entry, std::strcspn(*entry, "="));
    for (const char* start : {"SLURM", "PMI", "OMPI_"}) {
      if (name.starts_with(start)) names.push_back(name);
    }
  }
  for (const std::string& name : names) ::unsetenv(name.c_str());
}

void end_daemon(pid_t daemon) {
  ::kill(daemon, SIGTERM);
  const auto until = Clock::now() + kEnd;
  while (::waitpid(daemon, nullptr, WNOHANG) == 0) {
    if (Clock::now() > until) ::kill(daemon, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

}  // namespace

Said said_by(const std::string& command) {
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (!pipe) throw std::runtime_error("cannot start " + command);
  Said said;
  std::array<char, 4096> block;
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), pipe)) {
    said.text.append(block.data(), count);
  }
  const int status = ::pclose(pipe);
  said.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return said;
}

std::optional<std::string> OneNodeSlurm::missing() {
  if (::geteuid() != 0) return "not root";
  for (const char* program : {"munged", "slurmctld", "slurmd", "srun", "sbatch", "mpirun"}) {
    if (said_by(fmt::format("command -v {}", program)).exit_code != 0) {
      return fmt::format("no {} here", program);
    }
  }
  return std::nullopt;
}

OneNodeSlurm::OneNodeSlurm(const fs::path& folder, int cores) : folder_(folder) {
  try {
    forget_other_launchers();
    write_settings(cores);
    ::setenv("SLURM_CONF", (folder_ / "slurm.conf").c_str(), 1);
    const auto at = [&](const char* name) { return (folder_ / "munge" / name).string(); };
    start_daemon({"munged",
                  "--foreground",
                  "--force",
                  "--origin=127.0.0.1",
                  "--socket=" + at("socket"),
                  "--key-file=" + at("key"),
                  "--pid-file=" + at("pid"),
                  "--log-file=" + at("log"),
                  "--seed-file=" + at("seed")},
                 "munged.log");
    const auto until = Clock::now() + kStart;
    while (!fs::exists(folder_ / "munge" / "socket") && Clock::now() < until) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    start_daemon({"slurmctld", "-D", "-c"}, "slurmctld.log");
    start_daemon({"slurmd", "-D", "-c"}, "slurmd.log");
    wait_until_idle();
  } catch (...) {
    end();
    throw;
  }
}

OneNodeSlurm::~OneNodeSlurm() { end(); }

void OneNodeSlurm::write_settings(int cores) const {
  make_folder(folder_, 0755);
  make_folder(folder_ / "munge", 0711);  // users of a job request a credential in this folder
  make_folder(folder_ / "state", 0700);
  make_folder(folder_ / "spool", 0755);
  std::random_device chance;
  std::string key(128, '\0');
  for (char& byte : key) byte = static_cast<char>(chance());
  write_text_file(folder_ / "munge" / "key", key);
  ::chmod((folder_ / "munge" / "key").c_str(), 0400);
  const auto ports = free_ports();
  write_text_file(folder_ / "slurm.conf",
                  fmt::format(R"(ClusterName=latsch
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={control}
SlurmdPort={node}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=pmix
ReturnToService=2
KillWait=1
SlurmdParameters=config_overrides
SchedulerParameters=batch_sched_delay=0,sched_interval=1
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES State=UP MaxTime=INFINITE
)",
                              fmt::arg("host", host_name()),
                              fmt::arg("control", ports[0]),
                              fmt::arg("node", ports[1]),
                              fmt::arg("folder", folder_.string()),
                              fmt::arg("cores", cores)));
}

void OneNodeSlurm::start_daemon(const std::vector<std::string>& arguments, const std::string& log) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const std::string file = (folder_ / log).string();
  const pid_t master = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // ends the daemon if this process ends in any way
    if (::getppid() != master) ::_exit(1);
    const int out = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(out, STDERR_FILENO);
    ::execvp(argv[0], argv.data());
    ::_exit(127);
  }
  daemons_.push_back(child);
}

void OneNodeSlurm::wait_until_idle() const {
  const auto until = Clock::now() + kStart;
  while (said_by("timeout 5 sinfo --noheader --format=%T").text != "idle\n") {
    if (Clock::now() > until) {
      throw std::runtime_error("Slurm does not start: " +
                               said_by("tail -n 3 " + (folder_ / "*.log").string()).text);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

void OneNodeSlurm::end() noexcept {
  if (daemons_.size() == 3) {
    (void)std::system("timeout 5 scancel --user=root --signal=KILL --full > /dev/null 2>&1");
    (void)std::system("timeout 5 scancel --user=root > /dev/null 2>&1");
    std::this_thread::sleep_for(std::chrono::milliseconds(500));  // gives the steps time to end
  }
  while (!daemons_.empty()) {  // daemons end in reverse order, because all others need munged
    end_daemon(daemons_.back());
    daemons_.pop_back();
  }
  ::unsetenv("SLURM_CONF");
}

}  // namespace latsch::benchmarks
