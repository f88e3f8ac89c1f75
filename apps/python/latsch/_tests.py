# SPDX-License-Identifier: Apache-2.0
"""Runs models through tests; recordings are arrays."""
import os

from latsch import _latsch, _notebook, _toml
from latsch._errors import InputError


class Recording(dict):
    """Channels of a test by their names, arrays (samples,) in SI.

    units: the SI unit of each. slopes: arrays (samples, paths) of the channels whose derivatives are known, with respect to
    the numbers at `paths`, in SI. notes: warnings about the recording, one sentence each.
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

    def _repr_html_(self):
        return _notebook.recording(self)

    def to_frame(self, names=None):
        """Returns a pandas.DataFrame with a column "NAME [UNIT]" for each channel; needs pandas.

        names: the channels; unless given, all with as many samples as most of them have. Raises InputError if the channels
        named differ in their samples.
        """
        chosen = _notebook.of_one_length(self) if names is None else list(names)
        if len({len(self[name]) for name in chosen}) > 1:
            raise InputError("the channels differ in their numbers of samples: " + ", ".join(
                f"{name} has {len(self[name])}" for name in chosen))
        return _notebook.frame({f"{name} [{self.units[name]}]": self[name] for name in chosen})


def test(model, test, *, kind=None, slopes=()):
    """Runs a model through a test, with the same results to the last bit as `latsch test`.

    model: a Model, or a model's file (kind: needed if it can be read as more than one kind of model). test: a file, or its
    keys as a dict or as TOML in braces, {"kind": "kc", "Fy": "-4 kN"}; `latsch help study` lists the keys, and tests() the
    models that support a test. slopes: paths of numbers of the model with respect to which derivatives are computed.
    Returns a Recording.

    Other threads run meanwhile, and Ctrl-C has an immediate effect. Raises InputError, and Failure if the test does not
    succeed.
    """
    if not isinstance(model, _latsch.Model):
        model = _latsch.read_model(model, kind)
    text = _toml.value(test) if isinstance(test, dict) else os.fspath(test)
    paths = [slopes] if isinstance(slopes, str) else list(slopes)
    values, units, known, notes = _latsch._test(model, text, paths)
    return Recording(values, units, known, paths, notes)
