// SPDX-License-Identifier: Apache-2.0
// SIMD lanes with their slopes, that is, derivatives (dual_number.h). A kernel that is written for
// lanes also computes slopes if it is called with these types. V is Lanes, Lanes4 or Lane.
//
// Values equal those of V to the last bit, with the same fused products. Elementary functions have
// the values of V and their exact derivatives.
#if defined(LATSCH_DUAL_LANES) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_DUAL_LANES
#undef LATSCH_DUAL_LANES
#else
#define LATSCH_DUAL_LANES
#endif

#include "numerics/kernels/dual_number.h"
#include "numerics/kernels/kernel_math.h"

namespace latsch::LATSCH_KERNELS {

// Slope functions are not inlined, because a kernel has hundreds of operations and few of them
// involve slopes.

/// Returns the slopes x multiplied by `by`.
template <class V>
[[gnu::noinline]] const SlopeBlock* scaled(const SlopeBlock* x, V by) {
  SlopeBlock* made = x->arena->make(x->directions, V::kWidth);
  const double* from = x->values();
  double* to = made->values();
  for (std::uint64_t left = x->directions; left != 0; left &= left - 1) {
    V(by * V::load(from)).save(to);
    from += V::kWidth;
    to += V::kWidth;
  }
  return made;
}

/// Reads, direction by direction, the slopes that a block stores.
template <class V>
struct SlopeReader {
  std::uint64_t directions;
  const double* at;

  LATSCH_INLINE explicit SlopeReader(const SlopeBlock* x)
      : directions(x == nullptr ? 0 : x->directions), at(x == nullptr ? nullptr : x->values()) {}
  LATSCH_INLINE bool has(std::uint64_t bit) const { return (directions & bit) != 0; }
  LATSCH_INLINE V next() {
    const V slope = V::load(at);
    at += V::kWidth;
    return slope;
  }
};

/// Returns the slopes of by_a a + by_b b, given the slopes of a and b; one of the two may be
/// nullptr.
template <class V>
[[gnu::noinline]] const SlopeBlock* combined(const SlopeBlock* a,
                                             V by_a,
                                             const SlopeBlock* b,
                                             V by_b) {
  if (b == nullptr) return scaled<V>(a, by_a);
  if (a == nullptr) return scaled<V>(b, by_b);
  SlopeReader<V> of_a(a), of_b(b);
  SlopeBlock* made = a->arena->make(of_a.directions | of_b.directions, V::kWidth);
  double* to = made->values();
  for (std::uint64_t left = made->directions; left != 0; left &= left - 1, to += V::kWidth) {
    const std::uint64_t bit = left & -left;
    if (!of_b.has(bit))
      V(by_a * of_a.next()).save(to);
    else if (!of_a.has(bit))
      V(by_b * of_b.next()).save(to);
    else
      (by_b * of_b.next() + V(by_a * of_a.next())).save(to);
  }
  return made;
}

/// Returns the slopes of a + b or of a - b; one of the two may be nullptr.
template <class V, bool minus>
[[gnu::noinline]] const SlopeBlock* summed(const SlopeBlock* a, const SlopeBlock* b) {
  if (b == nullptr) return a;
  if (a == nullptr) return minus ? scaled<V>(b, V(-1.0)) : b;
  SlopeReader<V> of_a(a), of_b(b);
  SlopeBlock* made = a->arena->make(of_a.directions | of_b.directions, V::kWidth);
  double* to = made->values();
  for (std::uint64_t left = made->directions; left != 0; left &= left - 1, to += V::kWidth) {
    const std::uint64_t bit = left & -left;
    const V x = of_a.has(bit) ? of_a.next() : V(0.0);
    if (!of_b.has(bit))
      x.save(to);
    else
      (minus ? x - of_b.next() : x + of_b.next()).save(to);
  }
  return made;
}

/// Returns the slopes of by_a a + by_b b + c, or of the same with - c; any of the three may be
/// nullptr, but not all. The operations have the order of combined(), so that the bits of a slope
/// do not depend on which other slopes exist.
template <class V, bool minus>
[[gnu::noinline]] const SlopeBlock* of_fused(
    const SlopeBlock* a, V by_a, const SlopeBlock* b, V by_b, const SlopeBlock* c) {
  if (c == nullptr) return combined<V>(a, by_a, b, by_b);
  if (a == nullptr && b == nullptr) return minus ? scaled<V>(c, V(-1.0)) : c;
  SlopeReader<V> of_a(a), of_b(b), of_c(c);
  SlopeBlock* made = c->arena->make(of_a.directions | of_b.directions | of_c.directions, V::kWidth);
  double* to = made->values();
  for (std::uint64_t left = made->directions; left != 0; left &= left - 1, to += V::kWidth) {
    const std::uint64_t bit = left & -left;
    V sum = V(0.0);
    if (of_c.has(bit)) sum = minus ? -of_c.next() : of_c.next();
    if (of_a.has(bit)) sum = by_a * of_a.next() + sum;
    if (of_b.has(bit)) sum = by_b * of_b.next() + sum;
    sum.save(to);
  }
  return made;
}

/// Returns the slopes of a where `weight` is above 0, and those of b elsewhere; one of the two may
/// be nullptr. (The argument is not a mask because GCC 12 fails on one that is passed at -O1.)
template <class V>
[[gnu::noinline]] const SlopeBlock* chosen(V weight, const SlopeBlock* a, const SlopeBlock* b) {
  const auto where = weight > V(0.0);
  SlopeReader<V> of_a(a), of_b(b);
  SlopeBlock* made =
      (a != nullptr ? a : b)->arena->make(of_a.directions | of_b.directions, V::kWidth);
  double* to = made->values();
  for (std::uint64_t left = made->directions; left != 0; left &= left - 1, to += V::kWidth) {
    const std::uint64_t bit = left & -left;
    const V x = of_a.has(bit) ? of_a.next() : V(0.0);
    const V y = of_b.has(bit) ? of_b.next() : V(0.0);
    V::choose(where, x, y).save(to);
  }
  return made;
}

/// Copies the slopes of a single number to all lanes.
template <class V>
[[gnu::noinline]] const SlopeBlock* widened(const SlopeBlock* x) {
  SlopeBlock* made = x->arena->make(x->directions, V::kWidth);
  const int count = __builtin_popcountll(x->directions);
  for (int i = 0; i < count; ++i) V(x->values()[i]).save(made->values() + i * V::kWidth);
  return made;
}

template <class V>
struct DualLanes : Arithmetic<DualLanes<V>> {
  using Self = DualLanes;
  using Mask = typename V::Mask;
  using Constant = DualNumber;
  static constexpr int kWidth = V::kWidth;
  V v = 0.0;
  const SlopeBlock* slopes = nullptr;

  DualLanes() = default;
  LATSCH_INLINE DualLanes(double x) : v(x) {}
  LATSCH_INLINE DualLanes(const DualNumber& x)
      : v(x.v),
        slopes(__builtin_expect(x.slopes == nullptr, true) ? nullptr : widened<V>(x.slopes)) {}
  LATSCH_INLINE DualLanes(const V& x, const SlopeBlock* s) : v(x), slopes(s) {}
  LATSCH_INLINE DualLanes(const Product<Self>& p) { *this = mul(p.a, p.b); }

  /// True if no argument has slopes, which is the usual case.
  template <class... More>
  LATSCH_INLINE static bool plain(const Self& x, const More&... more) {
    return __builtin_expect(x.slopes == nullptr && ((more.slopes == nullptr) && ...), true);
  }
  /// Return the slopes of x multiplied by `by`, or the sum of those of x and y, each multiplied by
  /// its factor.
  LATSCH_INLINE static const SlopeBlock* of_one(const Self& x, const V& by) {
    return plain(x) ? nullptr : scaled<V>(x.slopes, by);
  }
  LATSCH_INLINE static const SlopeBlock* of_two(const Self& x,
                                                const V& by_x,
                                                const Self& y,
                                                const V& by_y) {
    return plain(x, y) ? nullptr : combined<V>(x.slopes, by_x, y.slopes, by_y);
  }

  LATSCH_INLINE static Self add(const Self& x, const Self& y) {
    return {V::add(x.v, y.v), plain(x, y) ? nullptr : summed<V, false>(x.slopes, y.slopes)};
  }
  LATSCH_INLINE static Self sub(const Self& x, const Self& y) {
    return {V::sub(x.v, y.v), plain(x, y) ? nullptr : summed<V, true>(x.slopes, y.slopes)};
  }
  LATSCH_INLINE static Self mul(const Self& x, const Self& y) {
    return {V::mul(x.v, y.v), of_two(x, y.v, y, x.v)};
  }
  LATSCH_INLINE static Self div(const Self& x, const Self& y) {
    const V q = V::div(x.v, y.v);
    if (plain(x, y)) return {q, nullptr};
    const V per_y = V(1.0) / y.v;
    return {q, combined<V>(x.slopes, per_y, y.slopes, V(-q * per_y))};
  }
  LATSCH_INLINE static Self mul_add(const Self& x, const Self& y, const Self& z) {
    const V v = V::mul_add(x.v, y.v, z.v);
    if (plain(x, y, z)) return {v, nullptr};
    return {v, of_fused<V, false>(x.slopes, y.v, y.slopes, x.v, z.slopes)};
  }
  LATSCH_INLINE static Self mul_sub(const Self& x, const Self& y, const Self& z) {
    const V v = V::mul_sub(x.v, y.v, z.v);
    if (plain(x, y, z)) return {v, nullptr};
    return {v, of_fused<V, true>(x.slopes, y.v, y.slopes, x.v, z.slopes)};
  }
  LATSCH_INLINE static Self sub_mul(const Self& z, const Self& x, const Self& y) {
    const V v = V::sub_mul(z.v, x.v, y.v);
    if (plain(x, y, z)) return {v, nullptr};
    return {v, of_fused<V, false>(x.slopes, -y.v, y.slopes, -x.v, z.slopes)};
  }
  LATSCH_INLINE static Self negated(const Self& x) { return {-x.v, of_one(x, V(-1.0))}; }
  LATSCH_INLINE static Self root(const Self& x) {
    const V r = V::root(x.v);
    if (plain(x)) return {r, nullptr};
    return {r, scaled<V>(x.slopes, select(r == V(0.0), V(0.0), 0.5 / r))};
  }
  LATSCH_INLINE static Self absolute(const Self& x) {
    const V v = V::absolute(x.v);
    if (plain(x)) return {v, nullptr};
    return {v, scaled<V>(x.slopes, sign_or_one(x.v))};
  }
  LATSCH_INLINE static Self with_sign_of(const Self& x, const Self& sign) {
    const V v = V::with_sign_of(x.v, sign.v);
    if (plain(x)) return {v, nullptr};
    return {v, scaled<V>(x.slopes, V::with_sign_of(V(1.0), sign.v))};
  }

  LATSCH_INLINE static Mask less(const Self& x, const Self& y) { return V::less(x.v, y.v); }
  LATSCH_INLINE static Mask less_equal(const Self& x, const Self& y) {
    return V::less_equal(x.v, y.v);
  }
  LATSCH_INLINE static Mask equal(const Self& x, const Self& y) { return V::equal(x.v, y.v); }
  LATSCH_INLINE static Self choose(const Mask& where, const Self& yes, const Self& no) {
    const V v = V::choose(where, yes.v, no.v);
    if (__builtin_expect(yes.slopes == no.slopes, true)) return {v, yes.slopes};
    return {v, chosen<V>(V::choose(where, V(1.0), V(0.0)), yes.slopes, no.slopes)};
  }
  LATSCH_INLINE static Self least(const Self& x, const Self& y) {
    return {V::least(x.v, y.v), choose(less(x, y), x, y).slopes};
  }
  LATSCH_INLINE static Self most(const Self& x, const Self& y) {
    return {V::most(x.v, y.v), choose(less(y, x), x, y).slopes};
  }
};

/// Returns the angle of y/x for x >= 0, not both 0.
template <class V>
LATSCH_INLINE DualLanes<V> atan_of_quotient(const DualLanes<V>& y, const DualLanes<V>& x) {
  const V arc = atan_of_quotient(y.v, x.v);
  if (DualLanes<V>::plain(x, y)) return {arc, nullptr};
  const V per_square = 1.0 / (x.v * x.v + y.v * y.v);
  return {arc, combined<V>(y.slopes, x.v * per_square, x.slopes, -y.v * per_square)};
}
template <class V>
LATSCH_INLINE DualLanes<V> atan(const DualLanes<V>& x) {
  const V arc = atan(x.v);
  if (DualLanes<V>::plain(x)) return {arc, nullptr};
  return {arc, scaled<V>(x.slopes, 1.0 / (1.0 + x.v * x.v))};
}
template <class V>
LATSCH_INLINE SinCos<DualLanes<V>> sin_cos(const DualLanes<V>& x) {
  const SinCos<V> r = sin_cos(x.v);
  using Dual = DualLanes<V>;
  return {{r.sin, Dual::of_one(x, r.cos)}, {r.cos, Dual::of_one(x, -r.sin)}};
}
template <class V>
LATSCH_INLINE DualLanes<V> sin(const DualLanes<V>& x) {
  const SinCos<V> r = sin_cos(x.v);
  return {r.sin, DualLanes<V>::of_one(x, r.cos)};
}
template <class V>
LATSCH_INLINE DualLanes<V> cos(const DualLanes<V>& x) {
  const SinCos<V> r = sin_cos(x.v);
  return {r.cos, DualLanes<V>::of_one(x, -r.sin)};
}
/// Beyond +-708, where exp saturates, the slope is 0.
template <class V>
LATSCH_INLINE DualLanes<V> exp(const DualLanes<V>& x) {
  const V e = exp(x.v);
  if (DualLanes<V>::plain(x)) return {e, nullptr};
  return {e, scaled<V>(x.slopes, select(abs(x.v) > 708.0, V(0.0), e))};
}
template <class V>
LATSCH_INLINE DualLanes<V> log(const DualLanes<V>& x) {
  const V l = log(x.v);
  if (DualLanes<V>::plain(x)) return {l, nullptr};
  return {l, scaled<V>(x.slopes, 1.0 / x.v)};
}

}  // namespace latsch::LATSCH_KERNELS
#endif
