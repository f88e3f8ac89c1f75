// SPDX-License-Identifier: Apache-2.0
#include "numerics/kernels/dual_number.h"

#include <cassert>

namespace latsch {
namespace {

/// Size of a chunk, bytes. The largest block has 64 directions of eight lanes.
constexpr std::size_t kChunk = 1 << 18;
static_assert(kChunk >= sizeof(SlopeBlock) + SlopeArena::kDirections * 8 * sizeof(double));

}  // namespace

void SlopeArena::next_chunk() {
  if (chunk_ == chunks_.size()) {
    chunks_.emplace_back(
        static_cast<char*>(::operator new (kChunk, std::align_val_t{alignof(SlopeBlock)})));
  }
  next_ = chunks_[chunk_++].get();
  end_ = next_ + kChunk;
}

void SlopeArena::rewind(const Mark& mark) {
  chunk_ = mark.chunk;
  next_ = mark.next;
  end_ = chunk_ == 0 ? nullptr : chunks_[chunk_ - 1].get() + kChunk;
}

DualNumber DualNumber::variable(double x, int direction, SlopeArena& arena) {
  assert(direction >= 0 && direction < SlopeArena::kDirections);
  SlopeBlock* s = arena.make(std::uint64_t{1} << direction, 1);
  s->values()[0] = 1.0;
  return {x, s};
}

double DualNumber::slope(int direction) const {
  const std::uint64_t bit = std::uint64_t{1} << direction;
  if (slopes == nullptr || (slopes->directions & bit) == 0) return 0.0;
  return slopes->values()[__builtin_popcountll(slopes->directions & (bit - 1))];
}

const SlopeBlock* combined(const SlopeBlock* a, double by_a, const SlopeBlock* b, double by_b) {
  const std::uint64_t of_a = a == nullptr ? 0 : a->directions,
                      of_b = b == nullptr ? 0 : b->directions;
  SlopeBlock* made = (a != nullptr ? a : b)->arena->make(of_a | of_b, 1);
  const double *from_a = a == nullptr ? nullptr : a->values(),
               *from_b = b == nullptr ? nullptr : b->values();
  double* to = made->values();
  for (std::uint64_t left = of_a | of_b; left != 0; left &= left - 1) {
    const std::uint64_t bit = left & -left;
    double s = 0.0;
    if (of_a & bit) s = by_a * *from_a++;
    if (of_b & bit) s += by_b * *from_b++;
    *to++ = s;
  }
  return made;
}

const SlopeBlock* without(const DualNumber& x, int direction, double factor) {
  const std::uint64_t bit = std::uint64_t{1} << direction;
  if (x.slopes == nullptr || (x.slopes->directions & ~bit) == 0) return nullptr;
  SlopeBlock* made = x.slopes->arena->make(x.slopes->directions & ~bit, 1);
  double* to = made->values();
  const double* from = x.slopes->values();
  for (std::uint64_t left = x.slopes->directions; left != 0; left &= left - 1, ++from)
    if ((left & -left) != bit) *to++ = factor * *from;
  return made;
}

}  // namespace latsch
