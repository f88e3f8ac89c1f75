# SPDX-License-Identifier: Apache-2.0
"""Studies: their variables and experiments, their runs, their journals.

A run is a process of the installed program, `latsch run`, not of this interpreter. The search is the same to the last
bit as one started from a terminal. Its journal is locked and survives crashes; the run can be watched (`latsch serve`)
and resumed from a terminal. A simulation that crashes or uses all memory ends only a worker of that process. The
program handles Ctrl-C itself and leaves every finished trial on the disk.
"""
import collections
import datetime
import importlib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import threading
import warnings

from latsch import _latsch, _notebook
from latsch._errors import Failure, InputError
from latsch._tests import Recording

Best = collections.namedtuple("Best", "point target violation")
Best.__doc__ = "The best trial: its point (n,), its target, by how much it violates constraints (0 where it does not)."

_STOPPED = 130  # exit code of a run that was stopped on request
_PATIENCE = 10  # s that a run is given to end after Ctrl-C; it asks for three


def program():
    """Returns the program `latsch`: $LATSCH_PROGRAM, the one installed or built with this package, or one on the PATH."""
    named = os.environ.get("LATSCH_PROGRAM")
    beside = pathlib.Path(__file__).resolve().parents[4] / "bin" / "latsch"
    found = named or (str(beside) if beside.is_file() else shutil.which("latsch"))
    if not found:
        raise InputError("the program latsch is not installed: expected it on the PATH or in LATSCH_PROGRAM")
    return found


def read_study(file):
    """Reads a study's file. Raises InputError with file and line if the study, its model or a measurement has an error."""
    return Study(file)


class Trials:
    """The trials in the journal of a study, in the order in which they finished; every array has one row for each
    trial.

       points (N, n); targets (N,), NaN for failed trials; violations (N,) of constraints; failures: a Failure each, None for
       successful trials; seconds (N,); asked (N,): False for trials that ran ahead of a search and are no result of it;
       own (N,): False for trials that were run for other measurements, weights or bounds than those of the present study;
       channels: arrays (N, samples) by "TEST/CHANNEL", with rows of NaN for failed trials, or lists of arrays if the numbers
       of samples differ; units: the units of the channels; names: the names of the n variables."""

    def __init__(self, columns):
        self.__dict__.update(columns)

    def __len__(self):
        return len(self.points)

    def __repr__(self):
        return f"<latsch.Trials {len(self)}, {sum(1 for one in self.failures if one)} failed>"

    def _repr_html_(self):
        return _notebook.trials(self)

    def to_frame(self):
        """Returns a pandas.DataFrame with a row for each trial: the variables in SI, target, violation, failure (its reason),
        seconds, asked, own, and channels that have one value; needs pandas."""
        columns = {name: self.points[:, k] for k, name in enumerate(self.names)}
        columns |= {"target": self.targets, "violation": self.violations,
                    "failure": [one.reason if one else None for one in self.failures],
                    "seconds": self.seconds, "asked": self.asked, "own": self.own}
        for name, values in self.channels.items():
            if not isinstance(values, list) and values.ndim == 2 and values.shape[1] == 1:
                columns[f"{name} [{self.units[name]}]"] = values[:, 0]
        return _notebook.frame(columns)


class Posterior:
    """Samples of the posterior density of a study's variables around its fit; N samples, n variables of the study, k sampled
    ones. Values are in SI.

       points (N, n): the samples; variables that are not sampled keep their value; log_densities (N,), whose zero is
       arbitrary; chains (N,): the walker of each sample; center (n,): the fit;
       names: the k sampled variables; medians (k,); intervals (k, 2): the 2.5 and 97.5 % points; linear (k, 2): the linear
       95 % interval, NaN for an open end; shapes: words such as "skewed, banana with B", None if the chains do not mix;
       rhat (k,) and effective (k,): the diagnostics of the chains; mixed: True if all of them are good;
       method: "surrogate", "delayed" or "model", of [posterior]: whose density the samples have;
       verdict: "stands", "doubtful", "refused" or "unchecked", the check of the surrogate by trials that it had not seen;
       deviation: the error of the logarithm of the density there, NaN if unchecked; verdict_text: the verdict in one sentence;
       remarks: sentences about the density; trials and failed: numbers of trials beyond the fit."""

    def __init__(self, fields):
        self.__dict__.update(fields)

    def __len__(self):
        return len(self.points)

    def __getitem__(self, name):
        """Returns the samples (N,) of one variable."""
        if name not in self.names:
            raise KeyError(f"{name} is none of the sampled variables {', '.join(self.names)}")
        return self.points[:, self._columns[name]]

    def _repr_html_(self):
        return _notebook.posterior(self)

    def to_frame(self):
        """Returns a pandas.DataFrame with a row for each sample: the sampled variables in SI, log_density and chain; needs
        pandas."""
        return _notebook.frame({**{name: self[name] for name in self.names},
                                "log_density": self.log_densities, "chain": self.chains})

    def __repr__(self):
        return f"<latsch.Posterior {len(self)} samples of {len(self.names)} variables, {'of the model' if self.method != 'surrogate' else 'surrogate ' + self.verdict}{'' if self.mixed else ', not mixed'}>"


class Study(_latsch._Study):
    """A study as read: `file`, `title`, `journal`; `space` and `variables`; `experiments`; `method` of its search.

    score(point, slopes=None): runs a trial in this process, without the journal, and returns a Score with residuals and,
    if the model knows them, their jacobian. A point outside of the bounds is a Python warning. target(point, channels): the Score of given channels, a dict like a Recording.
    model(point=None): the Model as written, or at a point. fitted_text(): the text of the file of the fitted model.
    """

    def _repr_html_(self):
        return _notebook.study(self)

    @property
    def ledger(self):
        """The interpretation of each column of each file: a list of dicts, one for each file, with `file`, `summary`, `rows`
        (written, taken_as, unit_written, unit, factor, offset, axes, used_by, state ...) and `doubts` (name, sentence, line,
        is_error).
        """
        return json.loads(self._ledger_json)

    def simulate(self, point):
        """Simulates all experiments at a point (n,), also the predicted ones, and returns a Recording with channels
        "TEST/CHANNEL". Its notes name the limits that the model meets, each with its tests: ranges of a tire's file that it
        leaves, a tire off the road."""
        values, units, _ = self._simulate(point)
        return Recording(values, units, notes=self._limits(point))

    def run(self, workers=None, *, anew=False, progress=True):
        """Fits the model in a process `latsch run`; trials in the journal are not computed again.

        workers: number of processes; that of the study unless given. anew: begins with an empty journal. progress: True
        shows the progress on standard error, False does not; or a function that receives its lines. Returns the results of
        `latsch run --json` as a dict; its `limits` name the limits that the model meets at the best point, which are also
        Python warnings. Ctrl-C ends the run, saves all trials and raises KeyboardInterrupt; run() or resume()
        continues the run.
        """
        return self._program("run", workers, ["--anew"] if anew else [], progress)

    def resume(self, workers=None, *, retry_failed=False, progress=True):
        """Continues an interrupted run; the result is the same to the last bit as without the interruption. retry_failed:
        repeats failed trials, after their cause was removed."""
        return self._program("resume", workers, ["--retry-failed"] if retry_failed else [], progress)

    def doe(self, workers=None, *, progress=True):
        """Runs the design of experiments that [doe] of the study states."""
        return self._program("doe", workers, [], progress)

    def identify(self, workers=None, *, progress=True):
        """Computes confidence intervals and profiles around the best trial."""
        return self._program("identify", workers, [], progress)

    def sample(self, workers=None, *, progress=True):
        """Draws samples of the variables' posterior density around the best trial, in a process `latsch sample`, by the settings
        of [posterior]. Needs a finished run. Returns a Posterior.

        Raises InputError if the study has no density that can be sampled, and Failure if the chains do not mix or nothing
        tells the noise, with the sentence of the command. A doubtful or refused surrogate is a Python warning; see `verdict`.
        """
        self._program("sample", workers, [], progress)
        return self.samples()

    def samples(self):
        """Returns the Posterior that the journal determines, without a trial; None if trials are missing: sample() runs
        them. The samples have the same bits as those of the command; `mixed` tells whether their chains mix."""
        fields = self._samples()
        if fields is None:
            return None
        columns = {variable.name: k for k, variable in enumerate(self.variables)}
        return Posterior({**fields, "_columns": columns})

    def trials(self, channels=()):
        """Returns the trials so far, also during a run. channels: names of channels to read; True: all (large)."""
        names = [channels] if isinstance(channels, str) else [] if isinstance(channels, bool) else list(channels)
        return Trials({**self._trials(names, channels is True), "names": self.space.names})

    def best(self):
        """The best trial of the journal: (point, target, violation); None where none has succeeded.

        Raises InputError where no search has run on the study as it stands: a measurement, a weight or a bound was edited.
        """
        found = self._best()
        return Best(*found) if found else None

    def fitted_text(self, date=None):
        """Returns the text of a file of the model at the best trial, as `latsch export --model` writes it: with the origin
        of every number, data, target and errors in comments. date: a datetime.date or text; today in UTC unless given.
        """
        when = datetime.datetime.now(datetime.timezone.utc).date() if date is None else date
        return self._fitted_text(importlib.import_module(__package__).__version__, str(when))

    def _program(self, verb, workers, options, progress):
        command = [program(), verb, str(self.file), "--json", *options]
        if workers is not None:
            command += ["--workers", str(workers)]
        if progress is False:
            command.append("--quiet")
        said = []
        output = _followed(command, _listener(progress, said))
        return _result(output, said)


def _listener(progress, said):
    def listen(line):
        said.append(line)
        del said[:-20]
        if line.startswith("latsch: "):
            return  # a warning or an error, which is also in the answer
        if callable(progress):
            progress(line)
        elif progress:
            print(line, file=sys.stderr, flush=True)
    return listen


def _followed(command, listen):
    """Returns the standard output of the process after its end; passes lines of its standard error to the listener as
    they come."""
    # The process has a session of its own: the terminal's Ctrl-C reaches only this process, which
    # passes it on once.
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               text=True, encoding="utf-8", errors="replace", start_new_session=True)
    output = []
    reader = threading.Thread(target=lambda: output.append(process.stdout.read()), daemon=True)
    reader.start()
    try:
        for line in process.stderr:
            listen(line.rstrip("\n"))
        process.wait()
    except BaseException:  # Ctrl-C, or an exception of a listener
        _end(process)
        raise
    finally:
        process.stderr.close()
        reader.join()
        process.stdout.close()
    return output[0]


def _end(process):
    process.send_signal(signal.SIGINT)
    try:
        threading.Thread(target=process.stderr.read, daemon=True).start()  # further output is read and dropped
        process.wait(_PATIENCE)
    except BaseException:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        raise


def _result(output, said):
    try:
        answer = json.loads(output)
    except ValueError:
        raise Failure("latsch ended without an answer: " + "; ".join(said), "transient") from None
    for warning in answer.get("warnings", []):
        warnings.warn(warning["message"], stacklevel=4)
    if answer["exit_code"] == 0:
        return answer.get("result", {})
    if answer["exit_code"] == _STOPPED:  # stopped from outside: by the page or a signal
        raise Failure("the run was stopped on request; run() or resume() goes on", "transient")
    error = answer.get("error", {"message": "latsch says no reason"})
    if answer["exit_code"] == 2:
        raise InputError(error["message"], error.get("file", ""), error.get("line", 0))
    raise Failure(error["message"])
