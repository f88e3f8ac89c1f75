#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Shows a suspension on the K&C rig: changes a parameter, reads channels as arrays, and finds the bushing with the
largest effect on toe under a side force.

   python3 bushings.py [corner.toml]"""
import pathlib
import sys

import latsch
import numpy as np

folder = pathlib.Path(__file__).resolve().parents[3] / "studies/compliance"
model = latsch.read_model(sys.argv[1] if len(sys.argv) > 1 else folder / "corner.toml")
side_force = {"kind": "kc", "Fy": ["-4 kN", "-2 kN", "0 N", "2 kN", "4 kN"]}

bushings = [path for path in model.paths() if path.startswith("bushing.") and model.knows_slopes(path)]
recording = latsch.test(model, side_force, slopes=bushings)
print(f"{model.describe()}\ntoe at {recording['Fy'][0]:.0f} N: {np.degrees(recording['toe'][0]):+.4f} deg")

# The derivative of toe by ln k, for a stiffness k, is the effect of a relative change of k, so stiffnesses of any
# size can be compared.
felt = {path: slope * model[path] for path, slope in zip(bushings, recording.slopes["toe"][0])}
for path in sorted(felt, key=lambda path: -abs(felt[path]))[:5]:
    print(f"{path:28} {np.degrees(felt[path]) / 100:+.2e} deg a percent")

most = max(felt, key=lambda path: abs(felt[path]))
stiffer = model.copy()
stiffer[most] *= 1.1
change = latsch.test(stiffer, side_force)["toe"][0] - recording["toe"][0]
print(f"{most} stiffer by a tenth: toe {np.degrees(change):+.2e} deg, by its slope {np.degrees(0.1 * felt[most]):+.2e}")
