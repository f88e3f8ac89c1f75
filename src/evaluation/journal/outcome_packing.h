// SPDX-License-Identifier: Apache-2.0
// Compresses outcomes for the journal without loss of a bit.
//
// A run evaluates a model at many points close to each other, so a channel of a trial is nearly a
// combination of the channels of earlier trials:
//
//   x  ~  x_1 + sum_j a_j (x_j - x_1),    x_j the same channel of the row j rows back
//
// The coefficients a_j minimize the squared error at some of the samples. If a channel equals an
// earlier one to the bit, only a reference to it is stored. If the combination saves less, samples
// are predicted from the samples before, by differences of order 0 to 2. The remainder, counted in
// units of the last place, is small: its leading bytes are zeros. Bytes of equal significance are
// grouped and deflated (zlib). A part that cannot be predicted, such as the rounding errors of a
// simulation, is not compressed.
//
// Slopes are stored for each variable, as channels of their own.
//
// A row refers to at most kLongestBlock - 1 rows before it, back to the last one that is packed
// alone; a damaged row can cost this many trials. Outcomes of less than a thousand numbers are
// packed alone.
//
// Predictions are plain sums in a fixed order, and this file is compiled without fused
// multiply-add, so every machine computes equal bits. A checksum of the outcome is stored to prove
// this.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "evaluation/trial/trial.h"

namespace latsch {

inline constexpr int kLongestBlock = 64;

/// The channels of the latest row that is packed alone and of all rows after it.
struct OutcomeBlock {
  struct Row {
    std::int64_t number;
    Channels channels;
  };
  std::deque<Row> rows;
  std::size_t values = 0;  // number of values in all rows of the block
};

class OutcomePacker {
 public:
  /// Packs the outcome of the row with this number. Rows must be packed in the order of their
  /// numbers, each once.
  std::string pack(std::int64_t number, const Outcome& outcome);
  /// Makes the next row be packed alone, because the rows before it were not stored or are not
  /// known.
  void begin_anew() { block_ = {}; }

 private:
  OutcomeBlock block_;
};

class OutcomeUnpacker {
 public:
  /// Unpacks the row with this number. Rows must come in the order of their numbers. Returns
  /// nullopt if the bytes are no packed outcome or refer to a row that was not given.
  std::optional<Outcome> unpack(std::int64_t number, std::string_view bytes);

 private:
  OutcomeBlock block_;
};

}  // namespace latsch
