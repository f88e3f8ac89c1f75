// SPDX-License-Identifier: Apache-2.0
#include "evaluation/executors/frame.h"

#include <cstring>

#include "evaluation/trial/encoding.h"

namespace latsch {
namespace {

constexpr std::uint32_t kMark = 0x4652414C;  // "LARF"
// Largest size of a frame, bytes. No trial has a gigabyte of channels.
constexpr std::uint64_t kLargest = std::uint64_t{1} << 30;

struct Header {
  std::uint32_t mark;
  std::uint32_t kind;
  std::uint64_t size;
  std::uint64_t hash;
};

bool is_kind(std::uint32_t kind) { return kind >= 1 && kind <= 3; }

}  // namespace

std::string encode_frame(FrameKind kind, std::string_view bytes) {
  const Header header{kMark, static_cast<std::uint32_t>(kind), bytes.size(), hash(bytes)};
  std::string frame(reinterpret_cast<const char*>(&header), sizeof header);
  frame += bytes;
  return frame;
}

std::string numbered(std::uint64_t number, std::string_view bytes) {
  std::string text(reinterpret_cast<const char*>(&number), sizeof number);
  text += bytes;
  return text;
}

std::optional<Numbered> take_number(std::string_view bytes) {
  std::uint64_t number = 0;
  if (bytes.size() < sizeof number) return std::nullopt;
  std::memcpy(&number, bytes.data(), sizeof number);
  return Numbered{number, bytes.substr(sizeof number)};
}

std::optional<Frame> FrameReader::next() {
  Header header;
  if (broken_ || buffer_.size() < sizeof header) return std::nullopt;
  std::memcpy(&header, buffer_.data(), sizeof header);
  if (header.mark != kMark || !is_kind(header.kind) || header.size > kLargest) {
    broken_ = true;
    return std::nullopt;
  }
  if (buffer_.size() - sizeof header < header.size) return std::nullopt;
  Frame frame{static_cast<FrameKind>(header.kind), buffer_.substr(sizeof header, header.size)};
  buffer_.erase(0, sizeof header + header.size);
  broken_ = hash(frame.bytes) != header.hash;
  if (broken_) return std::nullopt;
  return frame;
}

}  // namespace latsch
