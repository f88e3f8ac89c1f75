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

/// A message about a trial begins with the trial's number, because a program left behind by an
/// earlier evaluation may answer for a point that is no longer requested.
struct Numbered {
  std::uint64_t number;
  std::string_view rest;
};
std::string numbered(std::uint64_t number, std::string_view bytes);
/// Separates the number from the message. Returns nullopt if the bytes are too few for a number.
std::optional<Numbered> take_number(std::string_view bytes);

/// Splits a stream of bytes into frames as the bytes arrive.
class FrameReader {
 public:
  void add(std::string_view bytes) { buffer_ += bytes; }

  /// Returns the next frame; nullopt if it is not complete yet, or if the stream is broken.
  std::optional<Frame> next();

  /// True if the stream does not consist of frames: a frame has a wrong mark, an impossible size,
  /// or a hash that does not agree with its content.
  bool broken() const { return broken_; }

 private:
  std::string buffer_;
  bool broken_ = false;
};

}  // namespace latsch
