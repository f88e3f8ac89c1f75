// SPDX-License-Identifier: Apache-2.0
// Evaluates four bushings at once. The equations and their letters are those of bushing.h and
// bushing.cpp.
#include "numerics/kernels/kernel_math.h"

namespace latsch::multibody::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;
using T = Lanes4;

struct Vector {
  T x, y, z;
};
/// Four 3 x 3 matrices, stored by columns.
struct Matrix {
  Vector col[3];
};

LATSCH_INLINE Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
LATSCH_INLINE Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
LATSCH_INLINE Vector operator-(const Vector& a) { return {-a.x, -a.y, -a.z}; }
LATSCH_INLINE Vector times(const T& k, const Vector& a) { return {k * a.x, k * a.y, k * a.z}; }
LATSCH_INLINE T dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
LATSCH_INLINE Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
LATSCH_INLINE Vector product(const Matrix& A, const Vector& b) {
  return {A.col[0].x * b.x + A.col[1].x * b.y + A.col[2].x * b.z,
          A.col[0].y * b.x + A.col[1].y * b.y + A.col[2].y * b.z,
          A.col[0].z * b.x + A.col[1].z * b.y + A.col[2].z * b.z};
}
LATSCH_INLINE Vector transposed_product(const Matrix& A, const Vector& b) {
  return {dot(A.col[0], b), dot(A.col[1], b), dot(A.col[2], b)};
}
LATSCH_INLINE Matrix product(const Matrix& A, const Matrix& B) {
  return {{product(A, B.col[0]), product(A, B.col[1]), product(A, B.col[2])}};
}
LATSCH_INLINE Matrix transposed(const Matrix& A) {
  return {{{A.col[0].x, A.col[1].x, A.col[2].x},
           {A.col[0].y, A.col[1].y, A.col[2].y},
           {A.col[0].z, A.col[1].z, A.col[2].z}}};
}
LATSCH_INLINE Matrix operator+(const Matrix& A, const Matrix& B) {
  return {{A.col[0] + B.col[0], A.col[1] + B.col[1], A.col[2] + B.col[2]}};
}
LATSCH_INLINE Matrix operator-(const Matrix& A, const Matrix& B) {
  return {{A.col[0] - B.col[0], A.col[1] - B.col[1], A.col[2] - B.col[2]}};
}
LATSCH_INLINE Matrix operator-(const Matrix& A) { return {{-A.col[0], -A.col[1], -A.col[2]}}; }
/// Returns a × B, column by column.
LATSCH_INLINE Matrix cross(const Vector& a, const Matrix& B) {
  return {{cross(a, B.col[0]), cross(a, B.col[1]), cross(a, B.col[2])}};
}
LATSCH_INLINE Matrix cross(const Vector& a) {
  const T zero = 0.0;
  return {{{zero, a.z, -a.y}, {-a.z, zero, a.x}, {a.y, -a.x, zero}}};
}

/// Returns cross(a) cross(b) = b a' - (a b) 1.
LATSCH_INLINE Matrix crosses(const Vector& a, const Vector& b) {
  return {{{-(a.y * b.y + a.z * b.z), a.x * b.y, a.x * b.z},
           {a.y * b.x, -(a.x * b.x + a.z * b.z), a.y * b.z},
           {a.z * b.x, a.z * b.y, -(a.x * b.x + a.y * b.y)}}};
}

/// Reads 4 n successive numbers of each of four bushings and transposes them: of[i] has the i-th
/// number of all four.
template <int n>
struct Numbers {
  T of[4 * n];

  LATSCH_INLINE explicit Numbers(const double* const (&from)[4]) {
    for (int i = 0; i < n; ++i) {
      T four[4];
      for (int lane = 0; lane < 4; ++lane) four[lane] = lanes4(from[lane] + 4 * i);
      transpose(four);
      for (int k = 0; k < 4; ++k) of[4 * i + k] = four[k];
    }
  }
  LATSCH_INLINE Vector vector(int i) const { return {of[i], of[i + 1], of[i + 2]}; }
  LATSCH_INLINE Matrix matrix(int i) const { return {{vector(i), vector(i + 3), vector(i + 6)}}; }
};

/// Reads six numbers: a velocity and an angular velocity.
struct Rates {
  Vector v, w;

  LATSCH_INLINE explicit Rates(const double* const (&from)[4]) {
    T front[4], back[4];
    for (int lane = 0; lane < 4; ++lane) {
      front[lane] = lanes4(from[lane]);
      back[lane] = lanes4(from[lane] + 2);
    }
    transpose(front);
    transpose(back);
    v = {front[0], front[1], front[2]};
    w = {front[3], back[2], back[3]};
  }
};

/// Adds the forces F and moments M to the wrenches `to` of four bodies. Each number is added
/// separately, because several bushings add to the same body in turn, and the processor stalls if a
/// value is read in other pieces than it was stored.
LATSCH_INLINE void add(const Vector& F, const Vector& M, double* const (&to)[4]) {
  const T six[6] = {F.x, F.y, F.z, M.x, M.y, M.z};
  for (int i = 0; i < 6; ++i)
    for (int lane = 0; lane < 4; ++lane) to[lane][i] += six[i].at(lane);
}
/// Adds the 6 x 6 block matrix (A, B; C, D) of 3 x 3 blocks to the blocks `to` of four bushings.
LATSCH_INLINE void add(
    const Matrix& A, const Matrix& B, const Matrix& C, const Matrix& D, double* const (&to)[4]) {
  T all[36];
  for (int column = 0; column < 6; ++column) {
    const Vector& upper = (column < 3 ? A : B).col[column % 3];
    const Vector& lower = (column < 3 ? C : D).col[column % 3];
    T* const own = all + 6 * column;
    own[0] = upper.x;
    own[1] = upper.y;
    own[2] = upper.z;
    own[3] = lower.x;
    own[4] = lower.y;
    own[5] = lower.z;
  }
#pragma GCC unroll 9
  for (int i = 0; i < 36; i += 4) {
    T four[4] = {all[i], all[i + 1], all[i + 2], all[i + 3]};
    transpose(four);
    for (int lane = 0; lane < 4; ++lane) store(lanes4(to[lane] + i) + four[lane], to[lane] + i);
  }
}

/// Returns atan2(y, x).
LATSCH_INLINE T angle_of(const T& y, const T& x) {
  constexpr double kPi = 3.14159265358979311600;
  const T front = atan_of_quotient(y, abs(x));
  return select(x < T(0.0), with_sign(T(kPi), y) - front, front);
}

/// Rotation of a bushing: the angles q, the matrix N, and quantities from which both are computed.
struct Turning {
  Vector q;
  T s1, c1, c2, t2, per_c2, u, v;  // N = (1, u, v; 0, c1, s1; 0, -s1/c2, c1/c2)

  LATSCH_INLINE explicit Turning(const Matrix& axes, const Matrix& axes_b) {
    const T R00 = dot(axes.col[0], axes_b.col[0]), R01 = dot(axes.col[0], axes_b.col[1]),
            s2 = dot(axes.col[0], axes_b.col[2]), R12 = dot(axes.col[1], axes_b.col[2]),
            R22 = dot(axes.col[2], axes_b.col[2]);
    c2 = sqrt(R00 * R00 + R01 * R01);
    q = {angle_of(-R12, R22), atan_of_quotient(s2, c2), angle_of(-R01, R00)};
    per_c2 = 1.0 / c2;
    t2 = s2 * per_c2;
    s1 = -R12 * per_c2;
    c1 = R22 * per_c2;
    u = s1 * t2;
    v = -c1 * t2;
  }
  /// Returns N a.
  LATSCH_INLINE Vector rates(const Vector& a) const {
    return {a.x + (u * a.y + v * a.z), c1 * a.y + s1 * a.z, per_c2 * (c1 * a.z - s1 * a.y)};
  }
  /// Returns N' t.
  LATSCH_INLINE Vector moment(const Vector& t) const {
    const T third = t.z * per_c2;
    return {t.x, u * t.x + (c1 * t.y - s1 * third), v * t.x + (s1 * t.y + c1 * third)};
  }
  /// Returns N' c N + d(N' t)/dω.
  LATSCH_INLINE Matrix stiffness(const Vector& c, const Vector& t) const {
    const T g = -s1 * per_c2, h = c1 * per_c2;
    const T cu = c.x * u, cv = c.x * v, cyc = c.y * c1, czg = c.z * g;
    const T B11 = cu * u + (cyc * c1 + czg * g), B12 = cu * v + (cyc * s1 + czg * h),
            B22 = cv * v + (T(c.y * s1) * s1 + T(c.z * h) * h);
    const T w = t.x * t2 - t.z * per_c2, by_q2 = (t.x * per_c2 - t.z * t2) * per_c2;
    const T a10 = c1 * w - s1 * t.y, a20 = s1 * w + c1 * t.y, a11 = s1 * by_q2, a21 = -c1 * by_q2;
    return {{{c.x, cu + a10, cv + a20},
             {cu, B11 + (a10 * u + a11 * c1), B12 + (a20 * u + a21 * c1)},
             {cv, B12 + (a10 * v + a11 * s1), B22 + (a20 * v + a21 * s1)}}};
  }
};

/// Evaluates four bushings and adds their wrenches and tangents to the results. Returns the largest
/// angle |q|.
LATSCH_INLINE T add_four(const BushingTask* tasks, bool moving, double rate_share) {
  const auto each = [&](auto member) {
    using P = std::remove_cvref_t<decltype(tasks->*member)>;
    struct Four {
      P of[4];
    };
    return Four{{tasks[0].*member, tasks[1].*member, tasks[2].*member, tasks[3].*member}};
  };
  const Numbers<6> place(each(&BushingTask::place).of);
  const Numbers<3> law(each(&BushingTask::parameters).of), a(each(&BushingTask::pose_a).of),
      b(each(&BushingTask::pose_b).of);
  const Matrix turn_a = a.matrix(3), turn_b = b.matrix(3);
  const Matrix axes = product(turn_a, place.matrix(6));
  const Vector arm_b = product(turn_b, place.vector(3));
  const Vector arm_a = (b.vector(0) - a.vector(0)) + arm_b;
  const Vector d = transposed_product(axes, arm_a - product(turn_a, place.vector(0)));
  const Turning turning(axes, product(turn_b, place.matrix(15)));

  Vector k = law.vector(0), c = law.vector(3);
  Vector f = {k.x * d.x, k.y * d.y, k.z * d.z},
         t = {c.x * turning.q.x, c.y * turning.q.y, c.z * turning.q.z};
  if (moving) {
    const Rates of_a(each(&BushingTask::rates_a).of), of_b(each(&BushingTask::rates_b).of);
    const Vector travel = (of_b.v - cross(arm_b, of_b.w)) - (of_a.v - cross(arm_a, of_a.w));
    const Vector d_rate = transposed_product(axes, travel);
    const Vector q_rate = turning.rates(transposed_product(axes, of_b.w - of_a.w));
    const Vector damping = law.vector(6), rotational = law.vector(9);
    const T share = rate_share;
    f = {f.x + damping.x * d_rate.x, f.y + damping.y * d_rate.y, f.z + damping.z * d_rate.z};
    t = {t.x + rotational.x * q_rate.x,
         t.y + rotational.y * q_rate.y,
         t.z + rotational.z * q_rate.z};
    k = {k.x + share * damping.x, k.y + share * damping.y, k.z + share * damping.z};
    c = {c.x + share * rotational.x, c.y + share * rotational.y, c.z + share * rotational.z};
  }
  const Vector F = -product(axes, f), M = -product(axes, turning.moment(t));
  add(F, cross(arm_b, F) + M, each(&BushingTask::on_b).of);
  add(-F, -(cross(arm_a, F) + M), each(&BushingTask::on_a).of);

  const Matrix to_bushing = transposed(axes);
  const Matrix scaled = {
      {times(k.x, axes.col[0]), times(k.y, axes.col[1]), times(k.z, axes.col[2])}};
  const Matrix K = product(scaled, to_bushing);
  const Matrix C = product(axes, product(turning.stiffness(c, t), to_bushing));
  // K is symmetric, so K × arm is the transpose of -(arm × K). P belongs to body b; Q = K σ + F ×
  // belongs to body a, on which F acts.
  const Matrix rows_b = cross(arm_b, K), rows_a = cross(arm_a, K);
  const Matrix P = -transposed(rows_b), P_rows = -rows_b;
  const Matrix Q = cross(F) - transposed(rows_a), Q_rows = transposed(Q);
  const Matrix C_and_F = C - crosses(F, arm_b), C_and_M = C - cross(M);
  add(-K, P, P_rows, cross(arm_b, P) - C_and_F, each(&BushingTask::bb).of);
  add(K, -P, -Q_rows, C_and_F - cross(arm_a, P), each(&BushingTask::ab).of);
  add(K, -Q, -P_rows, C_and_M - cross(arm_b, Q), each(&BushingTask::ba).of);
  add(-K, Q, Q_rows, cross(arm_a, Q) - C_and_M, each(&BushingTask::aa).of);
  return larger(abs(turning.q.x), larger(abs(turning.q.y), abs(turning.q.z)));
}

double add_bushings(const BushingTask* tasks, int count, bool moving, double rate_share) {
  T turned = 0.0;
  for (int i = 0; i < count; i += 4)
    turned = larger(add_four(tasks + i, moving, rate_share), turned);
  double most = 0.0;
  for (int lane = 0; lane < 4; ++lane) most = turned.at(lane) > most ? turned.at(lane) : most;
  return most;
}

}  // namespace latsch::multibody::LATSCH_KERNELS
