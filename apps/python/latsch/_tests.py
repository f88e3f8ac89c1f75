# SPDX-License-Identifier: Apache-2.0
"""Models through tests, recordings as arrays."""
import os

from latsch import _latsch, _toml


class Recording(dict):
    """Channels of a test by their names, arrays (samples,) in SI.

    units: the SI unit of each. slopes: arrays (samples, paths) of those channels whose derivatives are known, by the
    numbers at `paths`, in SI. notes: what is to be minded, a sentence each.
    """

    def __init__(self, values, units, slopes=None, paths=(), notes=()):
        super().__init__(values)
        self.units = units
        self.slopes = slopes or {}
        self.paths = list(paths)
        self.notes = list(notes)

    def __repr__(self):
        return "<latsch.Recording " + ", ".join(
            f"{name} [{self.units[name]}] ({len(values)},)" for name, values in self.items()) + ">"


def test(model, test, *, kind=None, slopes=()):
    """A model driven through a test, as `latsch test` does it: the same numbers to the last bit.

    model: a Model, or a model's file (kind: of one that can be read as several). test: a file, or its keys as a dict or as
    TOML in braces, {"kind": "kc", "Fy": "-4 kN"}; `latsch help study` has them, tests() which model can do which.
    slopes: paths of numbers of the model in which derivatives are wanted. Returns a Recording.

    Other threads run meanwhile, and Ctrl-C is answered at once. Raises InputError, and Failure where the test does not
    succeed.
    """
    if not isinstance(model, _latsch.Model):
        model = _latsch.read_model(model, kind)
    text = _toml.value(test) if isinstance(test, dict) else os.fspath(test)
    paths = [slopes] if isinstance(slopes, str) else list(slopes)
    values, units, known, notes = _latsch._test(model, text, paths)
    return Recording(values, units, known, paths, notes)
