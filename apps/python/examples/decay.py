#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fits a decay to six measurements by ask and tell, and prints the confidence intervals of its two parameters.

   python3 decay.py"""
import latsch
import numpy as np

t = np.arange(6.0)
measured = np.array([2.03, 1.21, 0.75, 0.44, 0.27, 0.18])
noise = 0.02


def residuals(point):
    """Returns (measured - computed) / noise, an array of shape (6,)."""
    A, k = point
    return (measured - A * np.exp(-k * t)) / noise


space = latsch.DesignSpace([
    latsch.Variable("A", lower=0.1, upper=10, initial=1),
    latsch.Variable("k", lower=0.01, upper=5, initial=1, scale="logarithmic")])
optimizer = latsch.optimizer(space, residuals=True)
print(f"{optimizer.method}: {optimizer.reason}")

best, least = space.initial, np.inf
while not optimizer.converged:
    point = optimizer.propose()[0]  # with eight workers: propose(8)
    score = latsch.Score(residuals=residuals(point))
    optimizer.observe(point, score)
    if score.value < least:
        best, least = point, score.value
print(f"The search ended {optimizer.ending}")

what = latsch.Identification(space, best, sigma=1.0)
while len(what.wanted):
    what.observe([residuals(point) for point in what.wanted])
for profile, value in zip(what.profiles, what.point):
    lower, upper = profile.interval
    print(f"{profile.variable} = {value:.3f}, 95 %: {lower:.3f} .. {upper:.3f}, {profile.in_words}")
