// SPDX-License-Identifier: Apache-2.0
// Outcomes as the journal keeps them: every bit, in less room.
//
// A run asks a model again and again at points not far apart, so a channel of a trial is nearly a
// combination of what the trials before it gave:
//
//   x  ~  x_1 + sum_j a_j (x_j - x_1),    x_j the same channel of the row j places back
//
// with a by least squares over some of its samples; a channel that does not depend on what varies
// is one of them to the bit, and only that is kept. Where this is worth less, the samples before it
// predict a sample: differences of order 0 to 2. What is left, counted in units of the last place,
// is small: its leading bytes are zeros. Bytes of one significance lie together and are deflated
// (zlib). What a prediction cannot tell, the rounding of a simulation say, takes its full room.
//
// Slopes are told variable by variable, each as a channel of its own.
//
// A row refers to at most kLongestBlock - 1 rows before it, back to the last one that stands alone:
// as many trials can a damaged row cost. Outcomes of less than a thousand numbers stand alone.
//
// Predictions are plain sums in a fixed order; this file is compiled without contraction, so every
// machine computes the same. A checksum of the outcome itself is kept for proof.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "evaluation/trial/trial.h"

namespace latsch {

inline constexpr int kLongestBlock = 64;

/// The channels of the rows since the last one that stands alone.
struct OutcomeBlock {
  struct Row {
    std::int64_t number;
    Channels channels;
  };
  std::deque<Row> rows;
  std::size_t values = 0;  // in all of them
};

class OutcomePacker {
 public:
  /// Rows are given in the order of their numbers, each once.
  std::string pack(std::int64_t number, const Outcome& outcome);
  /// The next one stands alone: rows before it were not kept, or are not known.
  void begin_anew() { block_ = {}; }

 private:
  OutcomeBlock block_;
};

class OutcomeUnpacker {
 public:
  /// Rows in the order of their numbers. nullopt where the bytes are no packed outcome or refer to
  /// one that was not given.
  std::optional<Outcome> unpack(std::int64_t number, std::string_view bytes);

 private:
  OutcomeBlock block_;
};

}  // namespace latsch
