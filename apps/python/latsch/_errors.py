# SPDX-License-Identifier: Apache-2.0
"""Errors that are no fault of the program: in the user's data, of a simulation, of a damaged journal."""


class InputError(ValueError):
    """An error in data or arguments. The message states file and line, the value found, and the expected one.

    `file`: "" if no file is concerned; `line`: 0 for the file as a whole.
    """

    def __init__(self, message, file="", line=0):
        super().__init__(message)
        self.file = file
        self.line = line

    def __reduce__(self):  # for passing it between processes
        return type(self), (str(self), self.file, self.line)


class Failure(Exception):
    """The reason for which a simulation gave no result. It is raised by a function with one result; a function with
    several results returns it as one of them.
    `reason`: a sentence; `cause`: "point" (the same if repeated), "timeout", "bad_output", "transient" or "not_begun".
    """

    def __init__(self, reason, cause="point"):
        super().__init__(reason)
        self.reason = reason
        self.cause = cause

    def __reduce__(self):
        return type(self), (self.reason, self.cause)

    def __repr__(self):
        return f"Failure({self.reason!r}, cause={self.cause!r})"


class JournalError(RuntimeError):
    """The journal of a study is damaged; `latsch doctor` reports the trials that can be recovered."""
