# SPDX-License-Identifier: Apache-2.0
"""The two kinds of wrong that are not a bug: the user's data, and a simulation that does not succeed."""


class InputError(ValueError):
    """What is wrong with data or arguments: where it stands, what was found, what was expected.

    `file`: "" where no file is concerned; `line`: 0 for the file as a whole.
    """

    def __init__(self, message, file="", line=0):
        super().__init__(message)
        self.file = file
        self.line = line

    def __reduce__(self):  # for passing it between processes
        return type(self), (str(self), self.file, self.line)


class Failure(Exception):
    """Why a simulation gave no result. Raised where there is one result, a value in a list of them.

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
    """What is kept of a study is damaged; `latsch doctor` says what can be saved."""
