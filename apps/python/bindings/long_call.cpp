// SPDX-License-Identifier: Apache-2.0
#include "bindings/long_call.h"

#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>

namespace latsch::python {
namespace {

namespace py = pybind11;

constexpr std::chrono::milliseconds kBetweenLooks{50};

std::atomic<int> leftovers{0};  // abandoned calls that are still computing

void end_beside_leftovers(int status, void*) {
  if (leftovers == 0) return;
  std::fflush(nullptr);
  ::_exit(status);
}

struct Job {
  std::mutex mutex;
  std::condition_variable ended;
  bool is_done = false, is_leftover = false;
  Abandonment abandonment;
};

void finish(Job& job) {
  const std::lock_guard lock(job.mutex);
  job.is_done = true;
  if (job.is_leftover) --leftovers;
  job.ended.notify_all();
}

bool wait_a_while(Job& job) {
  const py::gil_scoped_release others;
  std::unique_lock lock(job.mutex);
  return job.ended.wait_for(lock, kBetweenLooks, [&] { return job.is_done; });
}

void abandon(Job& job) {
  static const int registered = ::on_exit(end_beside_leftovers, nullptr);
  static_cast<void>(registered);
  const std::lock_guard lock(job.mutex);
  if (job.is_done) return;
  job.is_leftover = true;
  ++leftovers;
  job.abandonment.give_up();
}

}  // namespace

namespace detail {

void run_long(std::function<void(const Abandonment&)> work) {
  const auto job = std::make_shared<Job>();
  std::thread thread([job, work = std::move(work)]() mutable {
    work(job->abandonment);
    work = nullptr;  // the captured data are destroyed here, not in the waiting thread
    finish(*job);
  });
  thread.detach();
  while (!wait_a_while(*job)) {
    if (PyErr_CheckSignals() == 0) continue;
    abandon(*job);
    throw py::error_already_set();
  }
}

}  // namespace detail
}  // namespace latsch::python
