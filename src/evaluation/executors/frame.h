// SPDX-License-Identifier: Apache-2.0
// Messages between a ProcessExecutor and its workers: a header with kind, size and hash, then
// bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace latsch {

enum class FrameKind : std::uint32_t { ready = 1, point = 2, outcome = 3 };

struct Frame {
  FrameKind kind;
  std::string bytes;
};

std::string encode_frame(FrameKind kind, std::string_view bytes);

/// What is said about a trial begins with its number: a program an evaluator left behind may answer
/// to a point that is not asked about any more.
struct Numbered {
  std::uint64_t number;
  std::string_view rest;
};
std::string numbered(std::uint64_t number, std::string_view bytes);
/// nullopt where there is not even a number.
std::optional<Numbered> take_number(std::string_view bytes);

/// Cuts frames from a stream of bytes as they arrive.
class FrameReader {
 public:
  void add(std::string_view bytes) { buffer_ += bytes; }

  /// The next frame; nullopt where it is not complete yet, or never will be (broken).
  std::optional<Frame> next();

  /// The stream is not one of frames: a wrong mark, an impossible size, a hash that does not agree.
  bool broken() const { return broken_; }

 private:
  std::string buffer_;
  bool broken_ = false;
};

}  // namespace latsch
