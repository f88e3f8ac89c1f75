// SPDX-License-Identifier: Apache-2.0
// Encodes points and channels as bytes, for the journal and for messages between processes:
// little-endian, counts before contents, numbers by their exact bits. Decoding checks every count
// before it is used.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "evaluation/trial/trial.h"

namespace latsch {

std::string encode(const DesignPoint& point);
std::string encode(const Channels& channels);
std::string encode(const Outcome& outcome);

/// Decode a point or an outcome. Return nullopt if the bytes are not exactly one encoded value.
std::optional<DesignPoint> decode_point(std::string_view bytes);
std::optional<Outcome> decode_outcome(std::string_view bytes);

/// FNV-1a hash, 64 bits. Every step maps the state one-to-one, so a change of a single byte is
/// always detected. [Fowler, Noll, Vo, draft-eastlake-fnv]
inline constexpr std::uint64_t kHashStart = 0xcbf29ce484222325u;
std::uint64_t hash(std::string_view bytes, std::uint64_t before = kHashStart);

}  // namespace latsch
