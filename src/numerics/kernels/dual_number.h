// SPDX-License-Identifier: Apache-2.0
// Numbers with their slopes: forward differentiation by operator overloading.
//
//   x = v + sum_i s_i d_i,  d_i d_j = 0        f(x) = f(v) + sum_i f'(v) s_i d_i
//   [Griewank, Walther 2008, Evaluating Derivatives, 2nd ed., ch. 3.1 and 7.1]
//
// Up to 64 directions d_i. Only slopes that are there are kept and computed: a number no direction
// leads to costs a comparison more than a plain one, and its slopes are 0, not small. Values are
// the bits of the same operations on doubles.
//
// Kinks: min and max take the slope of the argument whose value they take, |x| at 0 that for rising
// x, a square root at 0 the slope 0. Comparisons see values. Where a value is not a number or not
// finite, slopes through it are what the rules above make of it: mostly NaN, never caught.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

namespace latsch {

class SlopeArena;

/// The slopes of one number: behind it lie, ascending, for each direction whose bit is set `width`
/// doubles: of one number 1, of lanes (dual_lanes.h) as many as they are. Never changed once
/// written, so equal slopes share one.
struct alignas(64) SlopeBlock {
  std::uint64_t directions;
  SlopeArena* arena;  // where slopes that are made of these go

  double* values() { return reinterpret_cast<double*>(this + 1); }
  const double* values() const { return reinterpret_cast<const double*>(this + 1); }
};

/// Memory of slopes, given back all at once.
class SlopeArena {
 public:
  static constexpr int kDirections = 64;

  /// Values are left as they are.
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
  /// Gives back what was made since.
  void rewind(const Mark& mark);

 private:
  void next_chunk();

  struct Free {
    void operator()(char* p) const { std::free(p); }
  };
  std::vector<std::unique_ptr<char, Free>> chunks_;
  std::size_t chunk_ = 0;  // in use: chunks_[chunk_ - 1]
  char* next_ = nullptr;
  char* end_ = nullptr;
};

/// One number with its slopes; none: nullptr.
struct DualNumber {
  double v = 0.0;
  const SlopeBlock* slopes = nullptr;

  DualNumber() = default;
  DualNumber(double x) : v(x) {}
  DualNumber(double x, const SlopeBlock* s) : v(x), slopes(s) {}
  /// The variable `direction` itself: slope 1.
  static DualNumber variable(double x, int direction, SlopeArena& arena);

  double slope(int direction) const;
};

/// by_a a + by_b b; one of the two may be nullptr.
const SlopeBlock* combined(const SlopeBlock* a, double by_a, const SlopeBlock* b, double by_b);

/// Slopes of x times a factor, but in one direction; nullptr where no other is there.
const SlopeBlock* without(const DualNumber& x, int direction, double factor);

/// f(x) with its f'(x)
inline DualNumber with_slope(double f, const DualNumber& x, double slope) {
  return {f, x.slopes == nullptr ? nullptr : combined(x.slopes, slope, nullptr, 0.0)};
}
/// f(x, y) with its partial derivatives
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
/// x > 0
inline DualNumber pow(const DualNumber& x, const DualNumber& y) {
  const double f = std::pow(x.v, y.v);
  return with_slopes(f, x, y.v * f / x.v, y, f * std::log(x.v));
}

/// Whether a number may be other than 0: what is left out where a coefficient is 0 must not be
/// where its slope is asked.
inline bool matters(double x) { return x != 0.0; }
inline bool matters(const DualNumber& x) { return x.v != 0.0 || x.slopes != nullptr; }
inline double value(double x) { return x; }
inline double value(const DualNumber& x) { return x.v; }

}  // namespace latsch
