// SPDX-License-Identifier: Apache-2.0
// The loops of block_forces.h.
#include "models/ring_tire/tread/block_lanes.h"
#include "models/ring_tire/tread/friction_lanes.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

/// Evaluates (11). The damper carries no more than the spring, so there is no jump at first touch
/// and no pull.
LATSCH_INLINE Lanes push(const BlockLaw& law, const Touch& touch, const Lanes& rate) {
  const Lanes fast = smaller(law.damping_time * touch.slope * rate, touch.depth);
  return law.normal * (touch.depth + larger(fast, -touch.depth));
}

/// A motion within a step, over its share u: the cubic with these places, and these velocities
/// times the step, at both ends. Tips come down where the belt bends within some steps, so a
/// velocity at one end does not determine the way.
struct StepCubic {
  Lanes begin, end, leaving, arriving;

  LATSCH_INLINE Lanes at(const Lanes& u) const {
    const Lanes left = 1.0 - u, u2 = u * u, left2 = left * left;
    return begin * (left2 * (1.0 + 2.0 * u)) + end * (u2 * (3.0 - 2.0 * u)) +
           leaving * (u * left2) - arriving * (u2 * left);
  }
  LATSCH_INLINE Lanes slope(const Lanes& u) const {
    const Lanes left = 1.0 - u;
    return (6.0 * (u * left)) * (end - begin) + leaving * (left * (left - 2.0 * u)) +
           arriving * (u * (u - 2.0 * left));
  }
};

/// Returns the share of the step after which the part of a cell that did not touch at its beginning
/// came down. `depth` is that of the cell's middle, from which follows the mean depth of this part.
LATSCH_INLINE Lanes share_at_touch(const Touch& touch, const Lanes& before, StepCubic depth) {
  constexpr int kCorrections = 4;  // Newton's method, starting from the straight line
  // Least slope of a correction over that of the straight line: a flatter cubic would throw it off.
  constexpr double kLeastSlope = 0.2;
  const Lanes behind = 0.5 * (smaller(touch.share, before) + touch.share);
  const Lanes sunk = depth.end - depth.begin, straight = larger(sunk, all(1e-12));
  depth.end = larger(touch.deepest - behind * touch.range, all(0.0));
  depth.begin = depth.end - sunk;
  const auto in_step = [](const Lanes& u) { return larger(smaller(u, all(1.0)), all(0.0)); };
  Lanes u = in_step(-depth.begin / straight);
  for (int i = 0; i < kCorrections; ++i)
    u = in_step(u - depth.at(u) / larger(depth.slope(u), kLeastSlope * straight));
  return select(depth.begin < 0.0, u, all(0.0));
}

/// Returns the share of the touching part that already touched at the beginning of the step.
LATSCH_INLINE Lanes kept(const Touch& touch, const Lanes& before) {
  return smaller(touch.share, before) / larger(touch.share, all(1e-300));
}

/// Force over that of a sticking tip, and the slip of the tip per force T.
struct Grip {
  Lanes share, slip;
};

/// Applies (13), (14): the part of the force T of sticking tips that friction holds. Returns false
/// if it holds all.
LATSCH_INLINE bool slides(const BlockLaw& law,
                          const Lanes& T2,
                          const Lanes& Fn,
                          const Lanes& share,
                          const Lanes& factor,
                          Grip& grip) {
  const Lanes p = Fn * law.by_force / larger(share, all(1e-300));
  const Lanes limit = factor * adhesion(law.friction->table(), p) * Fn;
  const Lanes over = T2 - limit * limit;
  if (!any(over > 0.0)) return false;
  const Lanes T = sqrt(select(over > 0.0, T2, all(0.0)));
  const Lanes slope = share * (law.tangential * (law.step + law.damping_time));
  const Lanes v = sliding_speed(law.friction->table(), T, slope, Fn, p, factor);
  const Lanes by_force = v / larger(T, all(1e-300));
  grip = {1.0 - slope * by_force, law.step * by_force};
  return true;
}

/// Handles eight blocks of which none touches; `axes` is the number of axes of the plane.
template <int axes>
LATSCH_INLINE Lanes3 leave_off(const BlockResults& results, const BlockMemory& before, int block) {
  const Lanes none = all(0.0);
  for (int i = 0; i < axes; ++i) {
    store(none, results.F[i] + block);
    store(lanes(before.tip[i] + block), results.tip[i] + block);
  }
  store(none, results.Fn + block);
  store(none, results.share + block);
  store(all(1.0), results.gripped + block);
  return {none, none, none};
}

/// Blocks on level ground, where only x and y of the plane are needed. A tip that sticks is where
/// it was, minus the motion of the road, so only T + t_d V is needed along x and y.
template <class Rubber>
struct LevelBlocks {
  Rubber rubber;
  LevelGround ground;
  BlockMemory before;
  BlockLaw law;
  BlockResults results;

  struct Belt {
    BeltStation place, rate, lagging;  // T, V relative to the road, T + t_d V
  };

  LATSCH_INLINE Belt at(const SegmentStations& at,
                        int j,
                        BeltStation place,
                        BeltStation rate) const {
    place.p.z += lanes(at.lift + j);
    rate.p = {rate.p.x - ground.velocity[0],
              rate.p.y - ground.velocity[1],
              rate.p.z - ground.velocity[2]};
    const double td = law.damping_time;
    const auto lag = [&](const Lanes3& a, const Lanes3& b) {
      return Lanes3{a.x + td * b.x, a.y + td * b.y, a.z};
    };
    return {place, rate, {lag(place.p, rate.p), lag(place.G, rate.G), lag(place.A, rate.A)}};
  }

  template <class Height>
  LATSCH_INLINE Lanes3 force(const Belt& s,
                             const Lanes3& half,
                             const Height& H,
                             double y,
                             const BeltBefore& was,
                             int block,
                             Lanes3& moment) const {
    const Lanes depth = ground.height - at_line(s.place.p.z, s.place.G.z, s.place.A.z, H, y);
    const Touch touch = rubber.touch(depth, -half.z);
    if (!any(touch.share > 0.0)) return leave_off<2>(results, before, block);
    const Lanes rate = -at_line(s.rate.p.z, s.rate.G.z, s.rate.A.z, H, y);
    Lanes tip_x = lanes(before.tip[0] + block) + law.step * ground.velocity[0];
    Lanes tip_y = lanes(before.tip[1] + block) + law.step * ground.velocity[1];
    if (was.entering) {
      const double h = law.step, *v = ground.velocity;
      const Lanes3 T = at_line(s.place, H, y), V = at_line(s.rate, H, y),
                   T0 = at_line(was.place, H, y), V0 = at_line(was.rate, H, y);
      const Lanes touched = lanes(before.touches + block), old = kept(touch, touched);
      const Lanes u = share_at_touch(
          touch, touched, {ground.height - h * v[2] - T0.z, depth, h * (v[2] - V0.z), h * rate});
      const Lanes new_x = StepCubic{T0.x + h * v[0], T.x, h * (V0.x - v[0]), h * V.x}.at(u);
      const Lanes new_y = StepCubic{T0.y + h * v[1], T.y, h * (V0.y - v[1]), h * V.y}.at(u);
      tip_x = new_x + old * (tip_x - new_x);
      tip_y = new_y + old * (tip_y - new_y);
    }
    const Lanes stick = law.tangential * touch.share;
    Lanes3 F = {stick * (tip_x - at_line(s.lagging.p.x, s.lagging.G.x, s.lagging.A.x, H, y)),
                stick * (tip_y - at_line(s.lagging.p.y, s.lagging.G.y, s.lagging.A.y, H, y)),
                push(law, touch, rate)};  // (12)
    Grip grip;
    Lanes gripped = all(1.0);
    if (slides(law, F.x * F.x + F.y * F.y, F.z, touch.share, all(ground.friction), grip)) {
      tip_x -= grip.slip * F.x;
      tip_y -= grip.slip * F.y;
      F.x *= grip.share;
      F.y *= grip.share;
      gripped = grip.share;
    }
    store(F.x, results.F[0] + block);
    store(F.y, results.F[1] + block);
    store(F.z, results.Fn + block);
    store(gripped, results.gripped + block);
    store(tip_x, results.tip[0] + block);
    store(tip_y, results.tip[1] + block);
    store(touch.share, results.share + block);
    rubber.keep(touch, results, block);
    moment.z += law.normal * touch.moment;
    return F;
  }
};

/// The plane below each of eight blocks: N and the velocity of its material.
struct AnyPlane {
  Lanes3 N, velocity;

  LATSCH_INLINE AnyPlane(const BlockGround& ground, int block)
      : N(lanes3(ground.N, block)), velocity(lanes3(ground.velocity, block)) {}

  LATSCH_INLINE Lanes height(const Lanes3& v) const { return dot(N, v); }
  /// Returns v + s N.
  LATSCH_INLINE Lanes3 raised(const Lanes3& v, const Lanes& s) const {
    return {v.x + s * N.x, v.y + s * N.y, v.z + s * N.z};
  }
  /// Returns v + s times the velocity.
  LATSCH_INLINE Lanes3 carried(const Lanes3& v, double s) const {
    return {v.x + s * velocity.x, v.y + s * velocity.y, v.z + s * velocity.z};
  }
};

/// The plane on a drum, where normal and velocity have no y.
struct DrumPlane {
  Lanes N_x, N_z, velocity_x, velocity_z;

  LATSCH_INLINE DrumPlane(const BlockGround& ground, int block)
      : N_x(lanes(ground.N[0] + block)),
        N_z(lanes(ground.N[2] + block)),
        velocity_x(lanes(ground.velocity[0] + block)),
        velocity_z(lanes(ground.velocity[2] + block)) {}

  LATSCH_INLINE Lanes height(const Lanes3& v) const { return N_x * v.x + N_z * v.z; }
  LATSCH_INLINE Lanes3 raised(const Lanes3& v, const Lanes& s) const {
    return {v.x + s * N_x, v.y, v.z + s * N_z};
  }
  LATSCH_INLINE Lanes3 carried(const Lanes3& v, double s) const {
    return {v.x + s * velocity_x, v.y, v.z + s * velocity_z};
  }
};

/// Blocks on separate planes. With x the sticking tip, e + t_d e' is the part in the plane of x - T
/// - t_d V; neither x nor V needs to be in the plane.
template <class Rubber, class Plane>
struct UnevenBlocks {
  Rubber rubber;
  BlockGround ground;
  BlockMemory before;
  BlockLaw law;
  BlockResults results;

  struct Belt {
    BeltStation place, rate;
  };

  LATSCH_INLINE Belt at(const SegmentStations&, int, BeltStation place, BeltStation rate) const {
    return {place, rate};
  }

  template <class Height>
  LATSCH_INLINE Lanes3 force(const Belt& s,
                             const Lanes3& half,
                             const Height& H,
                             double y,
                             const BeltBefore& was,
                             int block,
                             Lanes3& moment) const {
    const Plane plane(ground, block);
    const Lanes level = lanes(ground.level + block);
    const Lanes3 T = at_line(s.place, H, y);
    const Lanes depth = level - plane.height(T);
    const Touch touch = rubber.touch(depth, -plane.height(half));
    if (!any(touch.share > 0.0)) return leave_off<3>(results, before, block);
    const Lanes3 V = plane.carried(at_line(s.rate, H, y), -1.0);
    const Lanes rate = -plane.height(V), Fn = push(law, touch, rate);
    Lanes3 tip = plane.carried(lanes3(before.tip, block), law.step);
    if (was.entering) {
      const double h = law.step;
      // Relative to the road, with T at the beginning carried by the road to the end.
      const Lanes3 T0 = plane.carried(at_line(was.place, H, y), h),
                   V0 = plane.carried(at_line(was.rate, H, y), -1.0);
      const Lanes touched = lanes(before.touches + block), old = kept(touch, touched);
      const Lanes u = share_at_touch(
          touch, touched, {level - plane.height(T0), depth, -h * plane.height(V0), h * rate});
      const Lanes3 fresh = {StepCubic{T0.x, T.x, h * V0.x, h * V.x}.at(u),
                            StepCubic{T0.y, T.y, h * V0.y, h * V.y}.at(u),
                            StepCubic{T0.z, T.z, h * V0.z, h * V.z}.at(u)};
      tip = {fresh.x + old * (tip.x - fresh.x),
             fresh.y + old * (tip.y - fresh.y),
             fresh.z + old * (tip.z - fresh.z)};
    }
    const double td = law.damping_time;
    Lanes3 F = {tip.x - T.x - td * V.x, tip.y - T.y - td * V.y, tip.z - T.z - td * V.z};
    F = plane.raised(F, -plane.height(F));
    const Lanes stick = law.tangential * touch.share;
    F = {stick * F.x, stick * F.y, stick * F.z};  // (12)
    tip = plane.raised(tip, level - plane.height(tip));
    Grip grip;
    Lanes gripped = all(1.0);
    if (slides(law, dot(F, F), Fn, touch.share, lanes(ground.friction + block), grip)) {
      tip = {tip.x - grip.slip * F.x, tip.y - grip.slip * F.y, tip.z - grip.slip * F.z};
      F = {F.x * grip.share, F.y * grip.share, F.z * grip.share};
      gripped = grip.share;
    }
    store3(F, results.F, block);
    store(Fn, results.Fn + block);
    store(gripped, results.gripped + block);
    store3(tip, results.tip, block);
    store(touch.share, results.share + block);
    rubber.keep(touch, results, block);
    moment = plane.raised(moment, law.normal * touch.moment);
    return plane.raised(F, Fn);
  }
};

template <class Rubber>
using BlocksOnPlanes = UnevenBlocks<Rubber, AnyPlane>;
template <class Rubber>
using BlocksOnDrum = UnevenBlocks<Rubber, DrumPlane>;

/// Reduction of a sliding block's in-plane stiffness along its force, per force squared.
LATSCH_INLINE Lanes along_slip(const Lanes& plane, const Lanes& gripped, const Lanes& F2) {
  return select(gripped < 1.0, plane / larger(F2, all(1e-300)), all(0.0));
}

/// Sums of six entries of a symmetric matrix over eight stations, and of y and y^2 times them.
struct StiffnessSums {
  Lanes K[3][6];

  LATSCH_INLINE void add(int entry, const Lanes& k, double y) {
    K[0][entry] += k;
    K[1][entry] += y * k;
    K[2][entry] += y * y * k;
  }
  LATSCH_INLINE void store_at(double* sums, int stride, int j) const {
    for (int power = 0; power < 3; ++power)
      for (int entry = 0; entry < 6; ++entry)
        store(K[power][entry], sums + (6 * power + entry) * stride + j);
  }
};

void station_frames(const double* const nodes[4],
                    const double* weights,
                    const double* a,
                    int stride,
                    double* columns) {
  for (int j = 0; j < stride; j += kWide) {
    Lanes d[4];
    for (int m = 0; m < 4; ++m) d[m] = lanes(weights + (4 + m) * stride + j);
    Lanes3 t = {mixed(d, nodes, 0), mixed(d, nodes, 1), mixed(d, nodes, 2)};
    const Lanes across = a[0] * t.x + a[1] * t.y + a[2] * t.z;
    t = {t.x - across * a[0], t.y - across * a[1], t.z - across * a[2]};
    const Lanes length = sqrt(dot(t, t)), over = 1.0 / length;
    t = {t.x * over, t.y * over, t.z * over};
    const Lanes3 n = {a[1] * t.z - a[2] * t.y, a[2] * t.x - a[0] * t.z, a[0] * t.y - a[1] * t.x};
    double* const to_t[3] = {columns, columns + stride, columns + 2 * stride};
    double* const to_n[3] = {columns + 3 * stride, columns + 4 * stride, columns + 5 * stride};
    store3(t, to_t, j);
    store3(n, to_n, j);
    store(length, columns + 6 * stride + j);
  }
}

void station_columns(const SegmentStations& at, double* columns) {
  double* to[9];
  for (int c = 0; c < 9; ++c) to[c] = columns + c * at.stride;
  for (int j = at.begin; j < at.end; j += kWide) {
    const BeltStation s = section(at, at.nodes, j, 1.0);
    store3(s.p, to, j);
    store3(s.G, to + 3, j);
    store3(s.A, to + 6, j);
  }
}

void station_rates(const SegmentStations& at, double* columns) {
  double* to[9];
  for (int c = 0; c < 9; ++c) to[c] = columns + c * at.stride;
  for (int j = at.begin; j < at.end; j += kWide) {
    const BeltStation rates = section(at, at.rates, j, 0.0);
    store3(rates.p, to, j);
    store3(rates.G, to + 3, j);
    store3(rates.A, to + 6, j);
  }
}

void level_forces(const BlockStep& step, const LevelGround& ground) {
  add_block_forces<LevelBlocks>(step, ground);
}

void uneven_forces(const BlockStep& step, const BlockGround& ground) {
  add_block_forces<BlocksOnPlanes>(step, ground);
}

void drum_forces(const BlockStep& step, const BlockGround& ground) {
  add_block_forces<BlocksOnDrum>(step, ground);
}

void lowest_tips(const double* columns, const BlockLines& of, int stride, double* z) {
  for (int j = 0; j < stride; j += kWide) {
    const Lanes p = lanes(columns + 2 * stride + j), G = lanes(columns + 5 * stride + j),
                A = lanes(columns + 8 * stride + j);
    Lanes lowest = p + of.height[0] * G + of.y[0] * A;
    for (int line = 1; line < of.count; ++line)
      lowest = smaller(lowest, p + of.height[line] * G + of.y[line] * A);
    store(lowest, z + j);
  }
}

template <class Shape>
LATSCH_INLINE void find_gaps_to_drum(const double* columns,
                                     const BlockLines& of,
                                     int stride,
                                     const road::Cylinder& drum,
                                     double* gap,
                                     const Shape& shape) {
  const double R = drum.radius;
  for (int j = 0; j < stride; j += kWide) {
    const auto at = [&](int c) { return lanes(columns + c * stride + j); };
    Lanes least = all(1e6);
    for (int line = 0; line < of.count; ++line) {
      const auto H = shape.height(of, line, j);
      const Lanes x = at_line(at(0), at(3), at(6), H, of.y[line]) - drum.x;
      const Lanes z = at_line(at(2), at(5), at(8), H, of.y[line]) - drum.z;
      least = smaller(least, drum.up * (R * R - x * x - z * z));
    }
    store(least * (0.5 / R), gap + j);
  }
}

void gaps_to_drum(const double* columns,
                  const BlockLines& lines,
                  int stride,
                  const road::Cylinder& drum,
                  double* gap) {
  if (lines.rise)
    find_gaps_to_drum(columns, lines, stride, drum, gap, BentLines{});
  else
    find_gaps_to_drum(columns, lines, stride, drum, gap, StraightLines{});
}

/// Returns the length of a cell along x, m; the effect of the section's bending on it is far below
/// a percent.
inline double cell_along_x(
    const double* columns, int stride, const BlockLines& of, int line, int blocks) {
  const auto x = [&](int j) {
    const double* at = columns + j;
    return at[0] + of.height[line] * at[3 * stride] + of.y[line] * at[6 * stride];
  };
  return blocks > 1 ? (x(blocks - 1) - x(0)) / (blocks - 1) : 0.0;
}

template <class Shape>
LATSCH_INLINE void place_on_drum(const BlockSpan& at,
                                 const double* columns,
                                 const double* lift,
                                 const BlockLines& of,
                                 int blocks,
                                 const road::Cylinder& drum,
                                 const BlockGround& ground,
                                 const Shape& shape) {
  const double R2 = drum.radius * drum.radius;
  for (int line = 0; line < of.count; ++line) {
    const double cell = cell_along_x(columns, at.stride, of, line, blocks);
    for (int j = at.begin; j < at.end; j += kWide) {
      const int block = line * at.stride + j;
      const auto along_x = [&](int c) { return lanes(columns + 3 * c * at.stride + j); };
      const Lanes x =
          at_line(along_x(0), along_x(1), along_x(2), shape.height(of, line, j), of.y[line]);
      const Lanes from_axis = x - drum.x;
      const Lanes depth = sqrt(R2 - from_axis * from_axis), over = 1.0 / depth;
      const Lanes slope = drum.up * from_axis * over, cosine = depth * (1.0 / drum.radius);
      // The second derivative of the surface is up R²/depth³, so its mean over the cell differs
      // from the value in the middle by 1/24 of the length squared.
      const Lanes bow = (drum.up * R2 * cell * cell * (1.0 / 24.0)) * over * over * over;
      const Lanes z = drum.z - drum.up * depth + bow;
      store(-slope * cosine, ground.N[0] + block);
      store(all(0.0), ground.N[1] + block);
      store(cosine, ground.N[2] + block);
      store(cosine * (z - slope * x) - lanes(lift + j), ground.level + block);
      store(drum.rate * (z - drum.z), ground.velocity[0] + block);
      store(all(0.0), ground.velocity[1] + block);
      store(-drum.rate * from_axis, ground.velocity[2] + block);
      store(all(drum.friction), ground.friction + block);
    }
  }
}

void drum_planes(const BlockSpan& at,
                 const double* columns,
                 const double* lift,
                 const BlockLines& lines,
                 int blocks,
                 const road::Cylinder& drum,
                 const BlockGround& ground) {
  if (lines.rise)
    place_on_drum(at, columns, lift, lines, blocks, drum, ground, BentLines{});
  else
    place_on_drum(at, columns, lift, lines, blocks, drum, ground, StraightLines{});
}

void keep_tips(const BlockSpan& at,
               int count,
               const BlockResults& results,
               const double* level,
               double* const tip[3],
               double* touches) {
  for (int line = 0; line < count; ++line)
    for (int j = at.begin; j < at.end; j += kWide) {
      const int block = line * at.stride + j;
      store(select(lanes(results.Fn + block) > 0.0, lanes(results.share + block), all(0.0)),
            touches + block);
      store(lanes(results.tip[0] + block), tip[0] + block);
      store(lanes(results.tip[1] + block), tip[1] + block);
      store(level ? all(*level) : lanes(results.tip[2] + block), tip[2] + block);
    }
}

void find_entering(const BlockSpan& at, int count, const double* touches, std::uint8_t* entering) {
  for (int j = at.begin; j < at.end; j += kWide) {
    Lanes off = all(0.0);
    for (int line = 0; line < count; ++line) off += 1.0 - lanes(touches + line * at.stride + j);
    entering[j / kWide] = any(off > 0.0);
  }
}

template <class Rubber>
LATSCH_INLINE void add_level_stiffness(const BlockSpan& at,
                                       const BlockLines& of,
                                       const BlockResults& results,
                                       double normal,
                                       double tangential,
                                       double* sums) {
  for (int j = at.begin; j < at.end; j += kWide) {
    StiffnessSums of_lines = {};
    for (int line = 0; line < of.count; ++line) {
      const double y = of.y[line];
      const int block = line * at.stride + j;
      const Lanes on =
          select(lanes(results.Fn + block) > 0.0, lanes(results.share + block), all(0.0));
      const Lanes gripped = lanes(results.gripped + block);
      const Lanes plane = on * tangential * gripped;
      Lanes xx = plane, yy = plane;
      if (any((on > 0.0) & (gripped < 1.0))) {
        const Lanes Fx = lanes(results.F[0] + block), Fy = lanes(results.F[1] + block);
        const Lanes along = along_slip(plane, gripped, Fx * Fx + Fy * Fy);
        xx -= along * Fx * Fx;
        yy -= along * Fy * Fy;
        of_lines.add(1, -along * Fx * Fy, y);
      }
      of_lines.add(0, xx, y);
      of_lines.add(3, yy, y);
      of_lines.add(5, Rubber::slope(results, block, on) * normal, y);
    }
    of_lines.store_at(sums, at.stride, j);
  }
}

template <class Rubber>
LATSCH_INLINE void add_uneven_stiffness(const BlockSpan& at,
                                        const BlockLines& of,
                                        const BlockGround& ground,
                                        const BlockResults& results,
                                        double normal,
                                        double tangential,
                                        double* sums) {
  for (int j = at.begin; j < at.end; j += kWide) {
    StiffnessSums of_lines = {};
    for (int line = 0; line < of.count; ++line) {
      const double y = of.y[line];
      const int block = line * at.stride + j;
      const Lanes on =
          select(lanes(results.Fn + block) > 0.0, lanes(results.share + block), all(0.0));
      const Lanes gripped = lanes(results.gripped + block);
      const Lanes plane = on * tangential * gripped;
      const Lanes3 F = lanes3(results.F, block), N = lanes3(ground.N, block);
      const Lanes along = along_slip(plane, gripped, dot(F, F));
      const Lanes more = Rubber::slope(results, block, on) * normal - plane;
      of_lines.add(0, more * N.x * N.x + plane - along * F.x * F.x, y);
      of_lines.add(1, more * N.x * N.y - along * F.x * F.y, y);
      of_lines.add(2, more * N.x * N.z - along * F.x * F.z, y);
      of_lines.add(3, more * N.y * N.y + plane - along * F.y * F.y, y);
      of_lines.add(4, more * N.y * N.z - along * F.y * F.z, y);
      of_lines.add(5, more * N.z * N.z + plane - along * F.z * F.z, y);
    }
    of_lines.store_at(sums, at.stride, j);
  }
}

void level_stiffness(const BlockSpan& at,
                     const BlockLines& of,
                     const BlockResults& results,
                     double normal,
                     double tangential,
                     double* sums) {
  if (results.slope)
    add_level_stiffness<BottomingRubber>(at, of, results, normal, tangential, sums);
  else
    add_level_stiffness<LinearRubber>(at, of, results, normal, tangential, sums);
}

void uneven_stiffness(const BlockSpan& at,
                      const BlockLines& of,
                      const BlockGround& ground,
                      const BlockResults& results,
                      double normal,
                      double tangential,
                      double* sums) {
  if (results.slope)
    add_uneven_stiffness<BottomingRubber>(at, of, ground, results, normal, tangential, sums);
  else
    add_uneven_stiffness<LinearRubber>(at, of, ground, results, normal, tangential, sums);
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
