// SPDX-License-Identifier: Apache-2.0
// Computes eight stations of a segment at once: takes the motion of the belt's four nodes to the
// tips of a line's blocks, and the forces of the tips back to the nodes (10). `Blocks` defines the
// forces of the blocks.
#if defined(LATSCH_RING_BLOCK_LANES) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_RING_BLOCK_LANES
#undef LATSCH_RING_BLOCK_LANES
#else
#define LATSCH_RING_BLOCK_LANES
#endif

#include "models/ring_tire/tread/block_forces.h"
#include "models/ring_tire/tread/rubber_lanes.h"
#include "numerics/kernels/kernel_lanes.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

constexpr int kWide = 8;

struct Lanes3 {
  Lanes x, y, z;
};

LATSCH_INLINE Lanes3 lanes3(const double* columns, int stride, int j) {
  return {lanes(columns + j), lanes(columns + stride + j), lanes(columns + 2 * stride + j)};
}
LATSCH_INLINE Lanes3 lanes3(const double* const columns[3], int at) {
  return {lanes(columns[0] + at), lanes(columns[1] + at), lanes(columns[2] + at)};
}
LATSCH_INLINE void store3(const Lanes3& v, double* const columns[3], int at) {
  store(v.x, columns[0] + at);
  store(v.y, columns[1] + at);
  store(v.z, columns[2] + at);
}
LATSCH_INLINE Lanes dot(const Lanes3& a, const Lanes3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// The belt at eight stations: T = p + H G + y A, or the rate of T.
struct BeltStation {
  Lanes3 p, G, A;
};

LATSCH_INLINE Lanes mixed(const Lanes w[4], const double* const nodes[4], int i) {
  return w[0] * nodes[0][i] + w[1] * nodes[1][i] + w[2] * nodes[2][i] + w[3] * nodes[3][i];
}

/// Evaluates (10); `own` is 1, or 0 for rates, because n and a themselves have no rate.
LATSCH_INLINE BeltStation section(const SegmentStations& at,
                                  const double* const nodes[4],
                                  int j,
                                  double own) {
  Lanes w[4], d[4];
  for (int m = 0; m < 4; ++m) {
    w[m] = lanes(at.weights + m * at.stride + j);
    d[m] = lanes(at.weights + (4 + m) * at.stride + j);
  }
  const Lanes3 t = lanes3(at.t, at.stride, j), n = lanes3(at.n, at.stride, j);
  const double ax = at.a[0], ay = at.a[1], az = at.a[2];
  const Lanes psi = mixed(w, nodes, 3);
  const Lanes3 slope = {mixed(d, nodes, 0), mixed(d, nodes, 1), mixed(d, nodes, 2)};
  const Lanes over = 1.0 / lanes(at.length + j);
  const Lanes nu_n = dot(n, slope) * over;
  const Lanes nu_a = (ax * slope.x + ay * slope.y + az * slope.z) * over;
  return {.p = {mixed(w, nodes, 0), mixed(w, nodes, 1), mixed(w, nodes, 2)},
          .G = {own * n.x - nu_n * t.x + psi * ax,
                own * n.y - nu_n * t.y + psi * ay,
                own * n.z - nu_n * t.z + psi * az},
          .A = {own * ax - nu_a * t.x - psi * n.x,
                own * ay - nu_a * t.y - psi * n.y,
                own * az - nu_a * t.z - psi * n.z}};
}

// Returns T = p + H G + y A, one coordinate of eight tips. The height H of the line is one number,
// or eight numbers for the eight stations if the section is bent.
template <class Height>
LATSCH_INLINE Lanes
at_line(const Lanes& p, const Lanes& G, const Lanes& A, const Height& H, double y) {
  return p + H * G + y * A;
}
template <class Height>
LATSCH_INLINE Lanes3 at_line(const BeltStation& s, const Height& H, double y) {
  return {at_line(s.p.x, s.G.x, s.A.x, H, y),
          at_line(s.p.y, s.G.y, s.A.y, H, y),
          at_line(s.p.z, s.G.z, s.A.z, H, y)};
}

/// The belt at eight stations at the beginning of the step. It is only stored where not all of
/// their blocks touched the road at that time.
struct BeltBefore {
  bool entering;
  BeltStation place, rate;

  LATSCH_INLINE BeltBefore(const BlockMemory& before, int stride, int j)
      : entering(before.entering[j / kWide] != 0), place(), rate() {
    if (!entering) return;
    const auto belt = [&](int first) {
      const double* const at = before.start + first * stride;
      return BeltStation{lanes3(at, stride, j),
                         lanes3(at + 3 * stride, stride, j),
                         lanes3(at + 6 * stride, stride, j)};
    };
    place = belt(0);
    rate = belt(9);
  }
};

/// Forces of the lines at eight stations, F, H F and y F, and their moments on half a cell.
struct StationSums {
  Lanes3 F, FH, Fy, moment;

  template <class Height>
  LATSCH_INLINE void add(const Lanes3& f, const Height& H, double y) {
    F = {F.x + f.x, F.y + f.y, F.z + f.z};
    FH = {FH.x + H * f.x, FH.y + H * f.y, FH.z + H * f.z};
    Fy = {Fy.x + y * f.x, Fy.y + y * f.y, Fy.z + y * f.z};
  }
};

LATSCH_INLINE Lanes3 cross(const Lanes3& a, const Lanes3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Adds the stations' forces to four nodes by (10), and the part of their moment that the nodes do
/// not carry to that of the rim (18). A node's x, y, z and torsion, and the moment, are still
/// spread over the lanes.
LATSCH_INLINE void spread(const SegmentStations& at,
                          int j,
                          const BeltStation& belt,
                          const StationSums& sums,
                          Lanes to_node[4][4],
                          Lanes3& to_rim) {
  const Lanes3 t = lanes3(at.t, at.stride, j), n = lanes3(at.n, at.stride, j);
  const Lanes over = -1.0 / lanes(at.length + j);
  const Lanes by_n = dot(sums.FH, t) * over, by_a = dot(sums.Fy, t) * over;
  const Lanes3 turning = {
      by_n * n.x + by_a * at.a[0], by_n * n.y + by_a * at.a[1], by_n * n.z + by_a * at.a[2]};
  const Lanes torsion =
      sums.FH.x * at.a[0] + sums.FH.y * at.a[1] + sums.FH.z * at.a[2] - dot(sums.Fy, n);
  Lanes3 slope = {};
  for (int m = 0; m < 4; ++m) {
    const Lanes w = lanes(at.weights + m * at.stride + j);
    const Lanes d = lanes(at.weights + (4 + m) * at.stride + j);
    slope = {
        slope.x + d * at.nodes[m][0], slope.y + d * at.nodes[m][1], slope.z + d * at.nodes[m][2]};
    const Lanes half = lanes(at.halves + m * at.stride + j);
    to_node[m][0] += w * sums.F.x + d * turning.x + half * sums.moment.x;
    to_node[m][1] += w * sums.F.y + d * turning.y + half * sums.moment.y;
    to_node[m][2] += w * sums.F.z + d * turning.z + half * sums.moment.z;
    to_node[m][3] += w * torsion;
  }
  const Lanes3 by_height = cross(belt.G, sums.FH), across = cross(belt.A, sums.Fy),
               carried = cross(slope, turning);
  to_rim = {to_rim.x + by_height.x + across.x - carried.x,
            to_rim.y + by_height.y + across.y - carried.y,
            to_rim.z + by_height.z + across.z - carried.z};
}

LATSCH_INLINE void add_to_nodes(const Lanes to_node[4][4], double* const force[4]) {
  for (int m = 0; m < 4; ++m)
    for (int i = 0; i < 4; ++i) force[m][i] += sum(to_node[m][i]);
}

/// Heights of the lines for straight sections, and for bent ones.
struct StraightLines {
  LATSCH_INLINE double height(const BlockLines& lines, int line, int) const {
    return lines.height[line];
  }
};
struct BentLines {
  LATSCH_INLINE Lanes height(const BlockLines& lines, int line, int j) const {
    const double first = lines.rise[2 * line], rest = lines.rise[2 * line + 1] - first;
    return lines.height[line] + first + rest * lanes(lines.share + j);
  }
};

/// Returns half of the belt's increment along the cells of eight stations.
LATSCH_INLINE Lanes3 half_cell(const SegmentStations& at, int j) {
  Lanes half[4];
  for (int m = 0; m < 4; ++m) half[m] = lanes(at.halves + m * at.stride + j);
  return {mixed(half, at.nodes, 0), mixed(half, at.nodes, 1), mixed(half, at.nodes, 2)};
}

/// Processes all blocks of a segment. `Blocks` has at(stations, j, place, rate), the belt in the
/// form its ground needs, and force(belt, half, H, y, before, block, moment), which returns the
/// force of eight blocks of a line on the tire and adds to the moment on their half cells.
template <class Blocks, class Shape>
LATSCH_INLINE void add_block_forces(const BlockStep& step,
                                    const Blocks& blocks,
                                    const Shape& shape) {
  const SegmentStations& at = step.at;
  const BlockLines& lines = step.lines;
  Lanes to_node[4][4] = {};
  Lanes3 to_rim = {};
  for (int j = at.begin; j < at.end; j += kWide) {
    const BeltStation place = section(at, at.nodes, j, 1.0);
    const auto belt = blocks.at(at, j, place, section(at, at.rates, j, 0.0));
    const Lanes3 half = half_cell(at, j);
    const BeltBefore before(step.before, at.stride, j);
    StationSums sums = {};
    for (int line = 0; line < lines.count; ++line) {
      const auto H = shape.height(lines, line, j);
      const double y = lines.y[line];
      const int block = line * at.stride + j;
      sums.add(blocks.force(belt, half, H, y, before, block, sums.moment), H, y);
    }
    spread(at, j, place, sums, to_node, to_rim);
  }
  add_to_nodes(to_node, step.force);
  step.moment[0] += sum(to_rim.x);
  step.moment[1] += sum(to_rim.y);
  step.moment[2] += sum(to_rim.z);
}

template <class Blocks>
LATSCH_INLINE void add_block_forces(const BlockStep& step, const Blocks& blocks) {
  if (step.lines.rise)
    add_block_forces(step, blocks, BentLines{});
  else
    add_block_forces(step, blocks, StraightLines{});
}

/// Processes the blocks on their ground with their kind of rubber.
template <template <class> class Blocks, class Ground>
LATSCH_INLINE void add_block_forces(const BlockStep& step, const Ground& ground) {
  const auto add = [&](auto rubber) {
    using Own = Blocks<decltype(rubber)>;
    add_block_forces(step, Own{rubber, ground, step.before, step.law, step.results});
  };
  if (step.law.bottom > 0.0)
    add(BottomingRubber(step.law.bottom));
  else
    add(LinearRubber(0.0));
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
#endif
