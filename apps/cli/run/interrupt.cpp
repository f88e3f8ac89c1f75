// SPDX-License-Identifier: Apache-2.0
#include "cli/run/interrupt.h"

#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <csignal>

#include "cli/console/console.h"
#include "cli/verbs/verbs.h"

namespace latsch::cli {
namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // required in a signal handler

constexpr itimerval kPatience{.it_interval = {}, .it_value = {.tv_sec = 1, .tv_usec = 800'000}};

void on_alarm(int) {
  constexpr char kSaid[] = "latsch: interrupted; what is in the journal is safe\n";
  if (::write(STDERR_FILENO, kSaid, sizeof kSaid - 1) < 0) ::_exit(kStopped);
  answer_stopped();
  ::_exit(kStopped);
}

void on_signal(int signal) {
  if (stop_requested.exchange(true)) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  ::setitimer(ITIMER_REAL, &kPatience, nullptr);
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGALRM, on_alarm);
}

bool interrupted() { return stop_requested; }

}  // namespace latsch::cli
