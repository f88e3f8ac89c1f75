#!/usr/bin/env python3
"""A quarter car that rolls off a step of the road: response.csv holds the travel of body and wheel.

    body:   m z" = -k (z - w) - c (z' - w')
    wheel:  u w" =  k (z - w) + c (z' - w') - t (w - road)       road = -step from the first moment on

Runge-Kutta of fourth order, steps of a millisecond.

    quarter_car.py car.txt
"""
import sys

STEP, END, WRITTEN_EVERY = 1e-3, 1.5, 5


def read(file):
    values = {}
    for line in open(file):
        if "=" in line and not line.startswith("#"):
            key, value = line.split("=")
            values[key.strip()] = float(value)
    return values


def derivative(car, state):
    z, w, dz, dw = state
    suspension = car["spring_N_per_mm"] * 1e3 * (z - w) + car["damper"] * (dz - dw)
    ground = car["tire_stiffness"] * (w + car["step"])
    return (dz, dw, -suspension / car["body_mass"], (suspension - ground) / car["wheel_mass"])


def advanced(car, state):
    def moved(slope, h):
        return tuple(s + h * d for s, d in zip(state, slope))

    a = derivative(car, state)
    b = derivative(car, moved(a, STEP / 2))
    c = derivative(car, moved(b, STEP / 2))
    d = derivative(car, moved(c, STEP))
    return tuple(s + STEP / 6 * (p + 2 * q + 2 * r + t) for s, p, q, r, t in zip(state, a, b, c, d))


def main():
    car = read(sys.argv[1])
    state = (0.0, 0.0, 0.0, 0.0)
    with open("response.csv", "w") as out:
        out.write("time [s],body [mm],wheel [mm]\n")
        for i in range(round(END / STEP) + 1):
            if i % WRITTEN_EVERY == 0:
                out.write(f"{i * STEP:.3f},{state[0] * 1e3!r},{state[1] * 1e3!r}\n")
            state = advanced(car, state)


if __name__ == "__main__":
    main()
