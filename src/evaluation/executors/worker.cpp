// SPDX-License-Identifier: Apache-2.0
#include "evaluation/executors/worker.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <optional>
#include <string>

#include "evaluation/executors/frame.h"
#include "evaluation/trial/encoding.h"
#include "evaluation/trial/trial.h"

namespace latsch {
namespace {

bool write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(fd, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(count);
  }
  return true;
}

/// Reads the next frame. Returns nullopt at the end of the stream, or if it does not consist of
/// frames.
std::optional<Frame> read_frame(int fd, FrameReader& reader) {
  std::array<char, 65536> chunk;
  while (true) {
    if (auto frame = reader.next()) return frame;
    if (reader.broken()) return std::nullopt;
    const ssize_t count = ::read(fd, chunk.data(), chunk.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return std::nullopt;
    reader.add({chunk.data(), static_cast<std::size_t>(count)});
  }
}

/// Ends this process and its process group, because the process that started it has ended: nobody
/// waits for the trial any more, nor for an outside program that runs in the same group.
void end_with_group(int) { ::kill(::getpgrp() == ::getpid() ? 0 : ::getpid(), SIGKILL); }

}  // namespace

int serve(const Evaluator& evaluator, int in_fd, int out_fd) {
  std::signal(SIGHUP, end_with_group);
  ::prctl(PR_SET_PDEATHSIG, SIGHUP);  // nobody waits for the trial if the parent process ends
  ::fcntl(in_fd, F_SETFD, FD_CLOEXEC);
  ::fcntl(out_fd, F_SETFD, FD_CLOEXEC);
  if (!write_all(out_fd, encode_frame(FrameKind::ready, {}))) return 1;
  const pid_t self = ::getpid();
  FrameReader reader;
  while (const auto frame = read_frame(in_fd, reader)) {
    const auto asked = take_number(frame->bytes);
    const auto point = asked ? decode_point(asked->rest) : std::nullopt;
    if (frame->kind != FrameKind::point || !point) return 2;
    const Outcome outcome = evaluate(evaluator, *point);
    // An evaluator that calls fork(2) returns in two processes; only the worker itself answers.
    if (::getpid() != self) ::_exit(0);
    std::fflush(nullptr);
    const std::string answer = numbered(asked->number, encode(outcome));
    if (!write_all(out_fd, encode_frame(FrameKind::outcome, answer))) return 1;
  }
  return reader.broken() ? 2 : 0;
}

}  // namespace latsch
