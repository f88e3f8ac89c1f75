// SPDX-License-Identifier: Apache-2.0
#include "evaluation/executors/process_tree.h"

#include <unistd.h>

#include <charconv>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

namespace latsch {
namespace {

namespace fs = std::filesystem;

struct Process {
  pid_t parent = 0;
  // R: computes or waits for a processor; D: waits for a disk; Z: has ended.
  char state = 'Z';
  double processor_time = 0.0;  // s
};

/// Returns all processes of the machine. [proc(5): /proc/PID/stat is "PID (NAME) STATE PARENT ...",
/// and NAME may contain any character; fields 14 to 17 are the times of the process and of its
/// ended children]
std::map<pid_t, Process> processes() {
  constexpr int kBetween = 9;  // number of fields between the parent and the times
  const double tick = 1.0 / static_cast<double>(::sysconf(_SC_CLK_TCK));  // s
  std::map<pid_t, Process> all;
  std::error_code ended;
  for (const auto& entry : fs::directory_iterator("/proc", ended)) {
    const std::string name = entry.path().filename();
    pid_t pid = 0;
    const char* end = name.data() + name.size();
    if (std::from_chars(name.data(), end, pid).ptr != end) continue;
    std::ifstream file(entry.path() / "stat");
    std::string stat;
    std::getline(file, stat, '\0');  // stream iterators would throw if the process ends meanwhile
    const std::size_t after_name = stat.rfind(')');
    if (after_name == std::string::npos) continue;  // the process has just ended
    std::istringstream rest(stat.substr(after_name + 1));
    Process process;
    if (!(rest >> process.state >> process.parent)) continue;
    std::string skipped;
    for (int i = 0; i < kBetween; ++i) rest >> skipped;
    for (double ticks = 0.0, i = 0; i < 4 && rest >> ticks; ++i)
      process.processor_time += ticks * tick;
    all[pid] = process;
  }
  return all;
}

/// Adds the children of all members of `tree` to it. Returns true if there were any.
bool add_descendants(const std::map<pid_t, Process>& all, std::set<pid_t>& tree) {
  const std::size_t before = tree.size();
  for (std::size_t size = 0; size != tree.size();) {
    size = tree.size();
    for (const auto& [pid, process] : all) {
      if (tree.contains(process.parent)) tree.insert(pid);
    }
  }
  return tree.size() > before;
}

}  // namespace

void kill_descendants(pid_t root) {
  std::set<pid_t> tree{root};
  // A stopped process starts no other process, so all descendants are known once no further one is
  // found.
  while (add_descendants(processes(), tree)) {
    for (const pid_t pid : tree) {
      if (pid != root) ::kill(pid, SIGSTOP);
    }
  }
  tree.erase(root);
  for (const pid_t pid : tree) ::kill(pid, SIGKILL);
}

ProcessUse use_of_tree(pid_t root) {
  const std::map<pid_t, Process> all = processes();
  std::set<pid_t> tree{root};
  add_descendants(all, tree);
  ProcessUse use;
  for (const pid_t pid : tree) {
    const auto found = all.find(pid);
    if (found == all.end()) continue;
    const Process& process = found->second;
    use.processor_time += process.processor_time;
    use.is_held_up = use.is_held_up || process.state == 'R' || process.state == 'D';
  }
  return use;
}

}  // namespace latsch
