// SPDX-License-Identifier: Apache-2.0
// Numbers with their slopes: forward differentiation by operator overloading.
//
//   x = v + sum_i s_i d_i,  d_i d_j = 0        f(x) = f(v) + sum_i f'(v) s_i d_i
//   [Griewank, Walther 2008, Evaluating Derivatives, 2nd ed., ch. 3.1 and 7.1]
//
// There are up to 64 directions d_i. Only nonzero slopes are stored and computed: a number that
// depends on no direction costs only a comparison more than a plain one, and its slopes are exactly
// 0. Values have the bits of the same operations on doubles.
//
// Kinks: min and max take the slope of the argument whose value they take; |x| at 0 has the slope
// for rising x; a square root at 0 has the slope 0. Comparisons use values only. If a value is not
// a number or not finite, slopes through it follow the rules above: they are mostly NaN and never
// caught.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

namespace latsch {

class SlopeArena;

/// The slopes of one number. The values follow this header in memory, in ascending order of the
/// directions: for each direction whose bit is set, 1 double for a single number, or as many
/// doubles as there are lanes (dual_lanes.h). A block never changes once written, so numbers with
/// equal slopes can share it.
struct alignas(64) SlopeBlock {
  std::uint64_t directions;
  SlopeArena* arena;  // memory for slopes that are computed from this block

  double* values() { return reinterpret_cast<double*>(this + 1); }
  const double* values() const { return reinterpret_cast<const double*>(this + 1); }
};

/// Memory for slopes, which is freed all at once.
class SlopeArena {
 public:
  static constexpr int kDirections = 64;

  /// Makes a block with uninitialized values.
  [[gnu::always_inline]] inline SlopeBlock* make(std::uint64_t directions, int width) {
    const std::size_t doubles = static_cast<std::size_t>(__builtin_popcountll(directions)) * width;
    const std::size_t bytes = sizeof(SlopeBlock) + (doubles * sizeof(double) + 63) / 64 * 64;
    if (bytes > static_cast<std::size_t>(end_ - next_)) next_chunk();
    SlopeBlock* made = reinterpret_cast<SlopeBlock*>(next_);
    next_ += bytes;
    made->directions = directions;
    made->arena = this;
    return made;
  }

  struct Mark {
    std::size_t chunk;
    char* next;
  };
  Mark mark() const { return {chunk_, next_}; }
  /// Frees the blocks made since the mark.
  void rewind(const Mark& mark);

 private:
  void next_chunk();

  struct Free {
    void operator()(char* p) const { ::operator delete (p, std::align_val_t{alignof(SlopeBlock)}); }
  };
  std::vector<std::unique_ptr<char, Free>> chunks_;
  std::size_t chunk_ = 0;  // number of chunks in use; chunks_[chunk_ - 1] is filled now
  char* next_ = nullptr;
  char* end_ = nullptr;
};

/// A number with its slopes; nullptr means that all are 0.
struct DualNumber {
  double v = 0.0;
  const SlopeBlock* slopes = nullptr;

  DualNumber() = default;
  DualNumber(double x) : v(x) {}
  DualNumber(double x, const SlopeBlock* s) : v(x), slopes(s) {}
  /// Returns the variable `direction` itself, with slope 1.
  static DualNumber variable(double x, int direction, SlopeArena& arena);

  double slope(int direction) const;
};

/// Returns the slopes by_a a + by_b b; one of the two may be nullptr.
const SlopeBlock* combined(const SlopeBlock* a, double by_a, const SlopeBlock* b, double by_b);

/// Returns the slopes of x multiplied by `factor`, leaving out one direction; nullptr if no other
/// direction has a slope.
const SlopeBlock* without(const DualNumber& x, int direction, double factor);

/// Returns f(x) with its slope f'(x).
inline DualNumber with_slope(double f, const DualNumber& x, double slope) {
  return {f, x.slopes == nullptr ? nullptr : combined(x.slopes, slope, nullptr, 0.0)};
}
/// Returns f(x, y) with its partial derivatives.
inline DualNumber with_slopes(
    double f, const DualNumber& x, double by_x, const DualNumber& y, double by_y) {
  const bool none = x.slopes == nullptr && y.slopes == nullptr;
  return {f, none ? nullptr : combined(x.slopes, by_x, y.slopes, by_y)};
}

inline DualNumber operator+(const DualNumber& x, const DualNumber& y) {
  return with_slopes(x.v + y.v, x, 1.0, y, 1.0);
}
inline DualNumber operator-(const DualNumber& x, const DualNumber& y) {
  return with_slopes(x.v - y.v, x, 1.0, y, -1.0);
}
inline DualNumber operator*(const DualNumber& x, const DualNumber& y) {
  return with_slopes(x.v * y.v, x, y.v, y, x.v);
}
inline DualNumber operator/(const DualNumber& x, const DualNumber& y) {
  const double q = x.v / y.v;
  return with_slopes(q, x, 1.0 / y.v, y, -q / y.v);
}
inline DualNumber operator-(const DualNumber& x) { return with_slope(-x.v, x, -1.0); }

inline bool operator<(const DualNumber& x, const DualNumber& y) { return x.v < y.v; }
inline bool operator>(const DualNumber& x, const DualNumber& y) { return x.v > y.v; }
inline bool operator==(const DualNumber& x, const DualNumber& y) { return x.v == y.v; }

inline DualNumber abs(const DualNumber& x) {
  return with_slope(std::abs(x.v), x, x.v < 0.0 ? -1.0 : 1.0);
}
inline DualNumber sqrt(const DualNumber& x) {
  const double root = std::sqrt(x.v);
  return with_slope(root, x, root == 0.0 ? 0.0 : 0.5 / root);
}
inline DualNumber log10(const DualNumber& x) {
  constexpr double kLn10 = 2.302585092994046;
  return with_slope(std::log10(x.v), x, 1.0 / (kLn10 * x.v));
}
inline DualNumber tan(const DualNumber& x) {
  const double t = std::tan(x.v);
  return with_slope(t, x, 1.0 + t * t);
}
/// Requires x > 0.
inline DualNumber pow(const DualNumber& x, const DualNumber& y) {
  const double f = std::pow(x.v, y.v);
  return with_slopes(f, x, y.v * f / x.v, y, f * std::log(x.v));
}

/// True if a number or one of its slopes differs from 0. A term whose coefficient is 0 must be kept
/// if the slope of the coefficient is wanted.
inline bool matters(double x) { return x != 0.0; }
inline bool matters(const DualNumber& x) { return x.v != 0.0 || x.slopes != nullptr; }
inline double value(double x) { return x; }
inline double value(const DualNumber& x) { return x.v; }

}  // namespace latsch
