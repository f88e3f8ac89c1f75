#!/usr/bin/env python3
"""The smoke runs of the benchmarks, as tests.

    smoke.py run RECORDS PROGRAM [--no-limit]   runs PROGRAM --smoke and writes its processor time to RECORDS
    smoke.py sum RECORDS NAME...                the processor time of all of them together

A run fails if a judged row falls short, if the program does not report that it is a smoke run (it then does not
know --smoke), or if it uses more processor time than a smoke run may. The sum ends with 77, as a skipped test,
if one of the names was not run yet.
"""
import pathlib
import resource
import subprocess
import sys

MOST = 15.0  # s of processor time for one run
MOST_OF_ALL = 180.0
SKIPPED = 77


def run(records, program, limited):
    name = pathlib.Path(program).name.removeprefix("bench_")
    done = subprocess.run([program, "--smoke"], stdout=subprocess.PIPE, text=True)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = used.ru_utime + used.ru_stime
    print(done.stdout, end="")
    print(f"{name}: {seconds:.2f} s of processor time")
    if done.returncode == SKIPPED:
        seconds = 0.0
    elif done.returncode != 0:
        return done.returncode
    elif ", smoke run on " not in done.stdout:
        sys.exit(f"{name} --smoke did not say that it is a smoke run: its tables have to be made with its options")
    if limited and seconds > MOST:
        sys.exit(f"{name} --smoke took {seconds:.1f} s of processor time, expected at most {MOST:g}")
    records.mkdir(parents=True, exist_ok=True)
    (records / name).write_text(f"{seconds}\n")
    return done.returncode


def add_up(records, names):
    missing = [name for name in names if not (records / name).exists()]
    if missing:
        print("not run yet: " + ", ".join(missing))
        return SKIPPED
    seconds = {name: float((records / name).read_text()) for name in names}
    for name in sorted(names, key=seconds.get, reverse=True):
        print(f"{seconds[name]:7.2f} s  {name}")
    total = sum(seconds.values())
    print(f"{total:7.2f} s of processor time together, expected at most {MOST_OF_ALL:g}")
    return 0 if total <= MOST_OF_ALL else 1


def main():
    words = [word for word in sys.argv[1:] if word != "--no-limit"]
    if len(words) < 3 or words[0] not in ("run", "sum"):
        sys.exit(__doc__)
    records = pathlib.Path(words[1])
    if words[0] == "run":
        sys.exit(run(records, words[2], "--no-limit" not in sys.argv))
    sys.exit(add_up(records, words[2:]))


main()
