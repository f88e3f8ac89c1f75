# SPDX-License-Identifier: Apache-2.0
"""Support for the tests of the Python package: the program that belongs to it, and a counter in
another thread."""
import pathlib
import sys
import threading
import time

LATSCH = sys.argv.pop(1) if len(sys.argv) > 1 else "latsch"
ROOT = pathlib.Path(__file__).resolve().parents[3]


class Meanwhile:
    """Counts, in another thread, how often this other thread could run during a computation."""

    def __enter__(self):
        self.turns, self._goes_on = 0, True
        self._thread = threading.Thread(target=self._count)
        self._thread.start()
        return self

    def _count(self):
        while self._goes_on:
            self.turns += 1
            time.sleep(0.001)

    def __exit__(self, *error):
        self._goes_on = False
        self._thread.join()
