"""Locks by which two tools/studies.py --renew at once keep each other's results.

A study file is locked while it is run: a second process that wants to renew it refuses at once. The folder is locked
while its expected.toml and README.md are read again and written: a second process says so and waits, which takes
milliseconds. The locks are those of flock(2) on the files that are there, so no file remains and a lock ends with its
process. They hold between processes of one machine."""
import contextlib
import fcntl
import os
import sys


def holder(descriptor):
    """Returns "process 123", which holds the lock of an open file; "another process" if the system does not tell."""
    inode = os.fstat(descriptor).st_ino
    with contextlib.suppress(OSError):
        with open("/proc/locks") as locks:
            for line in locks:  # 1: FLOCK  ADVISORY  WRITE 123 00:2f:456 0 EOF
                words = line.split()
                if words[1] == "FLOCK" and words[5].split(":")[-1] == str(inode):
                    return f"process {words[4]}"
    return "another process"


@contextlib.contextmanager
def being_run(file, name, refusal):
    """Locks a study file for the time of its run. Raises `refusal` with the process that runs it already."""
    descriptor = os.open(file, os.O_RDONLY)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise refusal(f"{name} is being renewed by {holder(descriptor)}, whose numbers this run would overwrite: wait for "
                          "its end, or end it; other studies of the folder can be renewed meanwhile") from None
        yield
    finally:
        os.close(descriptor)


@contextlib.contextmanager
def being_written(folder, name):
    """Locks a folder for the time in which its results are read again and written; says for which process it waits."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            print(f"waits until {holder(descriptor)} has written the results of {name}", file=sys.stderr, flush=True)
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)
