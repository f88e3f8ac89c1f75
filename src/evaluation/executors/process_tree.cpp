// SPDX-License-Identifier: Apache-2.0
#include "evaluation/executors/process_tree.h"

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

/// Returns the parent of every process. [proc(5): /proc/PID/stat is "PID (NAME) STATE PARENT ...",
/// and NAME may hold anything]
std::map<pid_t, pid_t> parents() {
  std::map<pid_t, pid_t> parents;
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
    std::string state;
    pid_t parent = 0;
    if (rest >> state >> parent) parents[pid] = parent;
  }
  return parents;
}

/// Adds the descendants of the members. Returns true if there were any.
bool add_descendants(std::set<pid_t>& tree) {
  const std::map<pid_t, pid_t> all = parents();
  const std::size_t before = tree.size();
  for (std::size_t size = 0; size != tree.size();) {
    size = tree.size();
    for (const auto& [pid, parent] : all) {
      if (tree.contains(parent)) tree.insert(pid);
    }
  }
  return tree.size() > before;
}

}  // namespace

void kill_descendants(pid_t root) {
  std::set<pid_t> tree{root};
  // A stopped process starts nothing, so once no further descendant is found, all are known.
  while (add_descendants(tree)) {
    for (const pid_t pid : tree) {
      if (pid != root) ::kill(pid, SIGSTOP);
    }
  }
  tree.erase(root);
  for (const pid_t pid : tree) ::kill(pid, SIGKILL);
}

}  // namespace latsch
