// SPDX-License-Identifier: Apache-2.0
#include "scipy_peer.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "base/error.h"

namespace latsch::benchmarks {
namespace {

// The script reads a line "n bounds difference" and the start point. It then writes "? x ..." to
// request the residuals at x, and reads them, or "failed", or "stop"; it prints "." at the end. If
// the difference is negative, it reads the rows of the Jacobian after the residuals. If bounds is
// 2, n lower and n upper bounds follow the start.
constexpr const char* kScript = R"(
import sys, numpy as np
from scipy.optimize import least_squares
class Stop(Exception): pass
def say(words): sys.stdout.write(words + "\n"); sys.stdout.flush()
while True:
    head = sys.stdin.readline().split()
    if not head: break
    n, bounded, difference = int(head[0]), int(head[1]), float(head[2])
    numbers = np.array([float(v) for v in head[3:]])
    start = numbers[:n]
    bounds = (np.zeros(n), np.ones(n)) if bounded == 1 else (-np.inf, np.inf)
    if bounded == 2: bounds = (numbers[n:2*n], numbers[2*n:])
    size = [1]
    slopes = {}
    def r(x):
        say("? " + " ".join(repr(float(v)) for v in x))
        line = sys.stdin.readline().split()
        if not line or line[0] == "stop": raise Stop
        if line[0] == "failed": return np.full(size[0], np.nan)
        told = np.array([float(v) for v in line])
        if difference < 0:
            m = len(told) // (n + 1)
            slopes[x.tobytes()] = told[m:].reshape(m, n)
            told = told[:m]
        size[0] = len(told)
        return told
    try:
        if difference < 0:
            least_squares(r, start, jac=lambda x: slopes[x.tobytes()], bounds=bounds, method="trf",
                          x_scale="jac")
        else:
            least_squares(r, start, bounds=bounds, diff_step=difference if difference > 0 else None)
    except (Stop, ValueError, np.linalg.LinAlgError):
        pass
    say(".")
)";

std::string in_words(const std::vector<double>& values) {
  std::string words;
  for (const double value : values) words += fmt::format(" {}", value);
  return words;
}

}  // namespace

SciPy::SciPy() {
  int down[2], up[2];
  if (pipe(down) != 0 || pipe(up) != 0) throw InputError("no pipes to SciPy can be had");
  child_ = fork();
  if (child_ == 0) {
    dup2(down[0], STDIN_FILENO);
    dup2(up[1], STDOUT_FILENO);
    for (const int end : {down[0], down[1], up[0], up[1]}) close(end);
    // Python is started by its full path: started by the bare name, it would look for its library
    // beside the python3 that the search path finds first.
    execl("/usr/bin/python3", "/usr/bin/python3", "-c", kScript, nullptr);
    _exit(127);
  }
  close(down[0]);
  close(up[1]);
  to_ = fdopen(down[1], "w");
  from_ = fdopen(up[0], "r");
}

SciPy::~SciPy() {
  std::fclose(to_);
  std::fclose(from_);
  waitpid(child_, nullptr, 0);
}

void SciPy::solve(const std::vector<double>& start,
                  bool in_cube,
                  double difference,
                  const Ask& ask) {
  run(fmt::format("{} {} {}{}", start.size(), in_cube ? 1 : 0, difference, in_words(start)),
      start.size(),
      ask);
}

void SciPy::solve_by_slopes(const std::vector<double>& start,
                            const std::vector<double>& lower,
                            const std::vector<double>& upper,
                            const Ask& ask) {
  const int bounds = lower.empty() ? 0 : 2;
  run(fmt::format("{} {} -1{}{}{}",
                  start.size(),
                  bounds,
                  in_words(start),
                  in_words(lower),
                  in_words(upper)),
      start.size(),
      ask);
}

void SciPy::run(const std::string& task, std::size_t n, const Ask& ask) {
  const auto say = [&](const std::string& words) {
    std::fputs((words + "\n").c_str(), to_);
    std::fflush(to_);
  };
  say(task);
  std::vector<char> line(1 << 16);
  while (std::fgets(line.data(), static_cast<int>(line.size()), from_)) {
    if (line[0] == '.') return;
    std::vector<double> x;
    char* at = line.data() + 1;
    for (std::size_t i = 0; i < n; ++i) x.push_back(std::strtod(at, &at));
    const Answer answer = ask(x);
    say(answer.is_spent    ? "stop"
        : answer.residuals ? in_words(*answer.residuals) + in_words(answer.jacobian)
                           : "failed");
  }
  throw InputError("SciPy ended early; python3-scipy is what it needs");
}

}  // namespace latsch::benchmarks
