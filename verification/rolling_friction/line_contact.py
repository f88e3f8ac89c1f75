#!/usr/bin/env python3
"""Rolling line contact of an elastic layer that is bonded to a rigid core, in plane strain.

An independent program: no finite elements, nothing in common with Latsch. The layer's compliance follows for every wave
number k from the equations of elasticity as a linear system in the depth z,
    d/dz (u_x, u_z, s_xz, s_zz) = A(k) (u_x, u_z, s_xz, s_zz),     u = 0 at the depth h,
and is summed over the circumference, which is unrolled to a straight line. The pressure follows from the load on a
rigid plane without friction. The tractions obey Coulomb's law with sticking points that do not creep:
    (u_k - u_{k-1})/dx = -xi where |t| <= mu p, else t = mu p.
Points that exceed mu p slide, and sliding points whose traction points against their motion stick, until no state
changes. Under a pressure a surface that is not quite incompressible contracts along the ground, by
    -u_x,x = (1 - 2 nu)(1 + nu)/E p
as that of a half-plane does; slip counts from that of a cylinder without force. `python3 line_contact.py` prints
Carter's case for a half-plane and for the layer of the thick ring, then for the ring's own Poisson's ratio, with and
without that contraction."""
import numpy
import scipy.linalg
import scipy.optimize


def compliance(k, E, nu, h):
    """Returns the displacements u_x (of s_xz = 1), u_z (of s_zz = 1) of the surface for the wave number k, and of an
    antiplane traction. The layer lies below z = 0, which is its surface."""
    G, lam = E / (2 * (1 + nu)), E * nu / ((1 + nu) * (1 - 2 * nu))
    M = lam + 2 * G
    # u = (i U, W) e^{ikx}, s = (i S, Z): real equations.
    A = numpy.array([[0, -k, 1 / G, 0],
                     [lam * k / M, 0, 0, 1 / M],
                     [k * k * (M - lam * lam / M), 0, 0, -k * lam / M],
                     [0, 0, k, 0]])
    depth = min(h, 18.0 / k)
    T = scipy.linalg.expm(-A * depth)  # transfers the surface to the core
    # 0 = T_uu u + T_us s
    C = -numpy.linalg.solve(T[:2, :2], T[:2, 2:])
    return C[0, 0], C[1, 1], numpy.tanh(k * h) / (G * k)


class Layer:
    """Compliance of points `dx` apart: `along`, `down`, `across`[d] is the displacement of a point that is d points
    away from a unit traction on one point."""

    def __init__(self, E, nu, h, circumference, dx, points):
        waves = int(circumference / dx)
        k = 2 * numpy.pi * numpy.arange(1, waves // 2) / circumference
        grid = numpy.concatenate([k[:2000], numpy.geomspace(k[2000], k[-1], 400)[1:]])
        known = numpy.array([compliance(kk, E, nu, h) for kk in grid])
        spread = dx * numpy.sinc(k * dx / (2 * numpy.pi)) ** 2  # traction and displacement are means over a point
        x = numpy.arange(points) * dx
        zero = numpy.array([h * 2 * (1 + nu) / E, h * (1 + nu) * (1 - 2 * nu) / (E * (1 - nu)), h * 2 * (1 + nu) / E])
        for c, name in enumerate(("along", "down", "across")):
            C = numpy.interp(numpy.log(k), numpy.log(grid), known[:, c] * grid) / k
            sums = [2 * numpy.sum(C * spread * numpy.cos(k * at)) for at in x]
            setattr(self, name, (numpy.array(sums) + zero[c] * dx) / circumference)


def toeplitz(column):
    return scipy.linalg.toeplitz(column)


def pressure(layer, R, P, dx, points):
    """Returns the pressures of points below a rigid plane that carry P per unit of width."""
    x = (numpy.arange(points) - 0.5 * (points - 1)) * dx
    C = toeplitz(layer.down)
    touching = numpy.ones(points, bool)
    while True:
        n = numpy.flatnonzero(touching)
        # C p + x^2/2R = depth on touching points, sum p dx = P
        S = numpy.block([[C[numpy.ix_(n, n)], -numpy.ones((len(n), 1))], [dx * numpy.ones((1, len(n))), numpy.zeros((1, 1))]])
        p = numpy.linalg.solve(S, numpy.append(-x[n] ** 2 / (2 * R), P))[:-1]
        if p.min() >= 0:
            full = numpy.zeros(points)
            full[n] = p
            return x, full
        touching[n[p < 0]] = False


def roll(compliance_of, x, p, mu, xi, dx, contraction=0.0):
    """Returns the tractions along the flow, which enters at the largest x, and which points stick. `contraction`:
    strain along the ground of a unit of pressure."""
    n = numpy.flatnonzero(p > 0)[::-1]  # in the order of flow
    C = toeplitz(compliance_of)[numpy.ix_(n, n)]
    first = toeplitz(compliance_of)[n[0] + 1, n]  # the point before the leading edge
    limit = mu * p[n]
    slides = numpy.zeros(len(n))  # 1, -1: forward, backward
    creep = xi - contraction * p[n]
    rows = numpy.vstack([C[0] - first, C[1:] - C[:-1]]) / dx
    for _ in range(10 * len(n)):
        S, r = rows.copy(), creep.copy()
        S[slides != 0] = numpy.eye(len(n))[slides != 0]
        r[slides != 0] = (slides * limit)[slides != 0]
        t = numpy.linalg.solve(S, r)
        over = (slides == 0) & (abs(t) > limit * (1 + 1e-12))
        if over.any():
            slides[over] = numpy.sign(t[over])
            continue
        back = slides * (rows @ t - creep) > 1e-15  # slides against its traction
        if not back.any():
            break
        slides[back] = 0
    return x[n], t, slides == 0


def case(E, nu, h, R, mu, P, shares, dx, points):
    layer = Layer(E, nu, h, 2 * numpy.pi * R, dx, points + 2)
    x, p = pressure(layer, R, P, dx, points)
    stiff = E / (1 - nu * nu)
    a = numpy.sqrt(4 * P * R / (numpy.pi * stiff))
    fit = numpy.polyfit(x[p > 0] ** 2, p[p > 0] ** 2, 1)
    a_p = numpy.sqrt(-fit[1] / fit[0])
    print(f"h {h}: Hertz' a {1e3 * a:.4f} mm, of this layer {1e3 * a_p:.4f} mm, p_0 {numpy.sqrt(fit[1]):.1f} Pa")
    for name, C, factor in (("along", layer.along, 1.0), ("across", layer.across, 1 / (1 - nu))):
        for share in shares:
            xi = mu * a_p / R * (1 - numpy.sqrt(1 - share)) * factor
            at, t, sticks = roll(C, x, p, mu, xi, dx)
            Q = t.sum() * dx / (mu * P)
            print(f"  {name:6s} xi {xi:.6f}: Q/mu P {Q:.5f}, Carter with this a {share} ({Q / share:.4f}); "
                  f"sticks from x/a {at[sticks].min() / a_p - 0.5 * dx / a_p:+.3f}, "
                  f"Carter {1 - 2 * numpy.sqrt(1 - share):+.3f}")


def contracted(E, nu, h, R, mu, P, shares, dx, points):
    """Prints forces at Carter's slip from that without force, with and without the contraction by pressure."""
    layer = Layer(E, nu, h, 2 * numpy.pi * R, dx, points + 2)
    x, p = pressure(layer, R, P, dx, points)
    fit = numpy.polyfit(x[p > 0] ** 2, p[p > 0] ** 2, 1)
    a_p = numpy.sqrt(-fit[1] / fit[0])
    for share in shares:
        forces = []
        for contraction in (0.0, (1 - 2 * nu) * (1 + nu) / E):
            def force(xi):
                return roll(layer.along, x, p, mu, xi, dx, contraction)[1].sum() * dx / (mu * P)
            free = scipy.optimize.brentq(force, -0.01, 0.01, xtol=1e-10)
            forces.append(force(free + mu * a_p / R * (1 - numpy.sqrt(1 - share))))
        print(f"  along  Q/mu P {share}: {forces[0]:.5f}, with contraction {forces[1]:.5f} "
              f"({forces[1] / forces[0]:.4f} x)")


if __name__ == "__main__":
    for depth in (3.0, 0.1):
        case(2.5e5, 0.499, depth, 0.3, 0.5, 83.5, (0.05, 0.25, 0.5, 0.75), 9.77205e-3 / 100, 260)
    print("nu 0.48, half width 6 mm:")
    load = numpy.pi * 1e6 / (1 - 0.48**2) * 6e-3**2 / (4 * 0.3)
    for places in (40, 80):
        contracted(1e6, 0.48, 0.1, 0.3, 0.5, load, (0.25, 0.5, 0.75), 6e-3 / places, int(2.6 * places))
