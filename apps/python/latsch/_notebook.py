# SPDX-License-Identifier: Apache-2.0
"""What studies, recordings, trials and posteriors show in a notebook: HTML with drawings as SVG, which need no other
package and no network. Colors follow the text of the notebook, so that they fit a dark one, too."""
import html
import math

from latsch._errors import InputError

_WIDTH, _HEIGHT = 260, 90  # size of a small drawing, px
_MOST = 12  # rows and drawings shown; a line says how many more there are
_POINTS = 400  # most points of a line
_CELL = "text-align:left;padding:1px 8px"


def frame(columns):
    """Returns a pandas.DataFrame of the columns. Raises InputError if pandas is not installed."""
    try:
        import pandas
    except ImportError:
        raise InputError("to_frame needs pandas, which is not installed: apt-get install python3-pandas") from None
    return pandas.DataFrame(columns)


def of_one_length(recording):
    """Returns the names of the channels that have as many samples as most of them."""
    counts = [len(values) for values in recording.values()]
    usual = max(set(counts), key=lambda count: (counts.count(count), count), default=0)
    return [name for name, values in recording.items() if len(values) == usual]


def recording(self):
    """Draws each channel over time, if there is a channel `time` with as many samples, else over its samples."""
    time = self.get("time")
    shown, more = _first([name for name in self if name != "time"])
    cells = []
    for name in shown:
        values = self[name]
        over_time = time is not None and len(time) == len(values)
        x = list(time) if over_time else list(range(len(values)))
        what = f"{_text(name)} [{_text(self.units[name])}]" + (" over time [s]" if over_time else "")
        if len(values) == 1:
            cells.append(_figure(what, f"<b>{_number(values[0])}</b>"))
        else:
            cells.append(_figure(what, _curve(x, list(values))))
    notes = "".join(f"<div>{_text(note)}</div>" for note in self.notes)
    return _box(f"Recording, {len(self)} channels", "".join(cells) + more + notes)


def study(self):
    """Shows the variables with the best trial so far, if there is one, the experiments and the search."""
    try:
        best, problem = self.best(), ""
    except InputError as error:
        best, problem = None, str(error)
    rows = []
    for k, variable in enumerate(self.variables):
        found = variable.text(best.point[k]) if best else ""
        rows.append((variable.name, *map(variable.text, (variable.lower, variable.upper, variable.initial)), found))
    said = f"<div>{_text(problem)}</div>" if problem else ""
    if best:
        said += f"<div>best target {_number(best.target)}</div>"
        try:
            said += _progress(self.trials())
        except InputError:
            pass
    else:
        said += "<div>no trial of a run has succeeded yet: run()</div>"
    experiments = [(one.name, one.kind, "fitted" if one.fitted else "predicted", one.values) for one in self.experiments]
    return _box(_text(self.title or self.file.name),
                _table(("variable", "lower", "upper", "initial", "best"), rows)
                + _table(("experiment", "kind", "use", "values"), experiments)
                + f"<div>search: {_text(self.method)}</div>" + said)


def trials(self):
    failed = sum(1 for one in self.failures if one)
    good = [k for k, target in enumerate(self.targets) if math.isfinite(target)]
    order = sorted(good, key=lambda k: (self.violations[k], self.targets[k]))
    rows = [(k, *(_number(value) for value in self.points[k]), _number(self.targets[k])) for k in order[:5]]
    return _box(f"{len(self)} trials, {failed} failed",
                _progress(self) + ("<div>the best five, values in SI</div>" + _table(("trial", *self.names, "target"), rows) if rows else ""))


def posterior(self):
    """Draws the marginal of each variable with its 95 % interval, thick, and the linear one, thin."""
    shown, more = _first(list(self.names))
    cells = []
    for name in shown:
        k = list(self.names).index(name)
        low, high = self.intervals[k]
        shape = "" if self.shapes[k] is None else f", {_text(self.shapes[k])}"
        what = f"{_text(name)}: {_number(self.medians[k])}, 95 %: {_number(low)} .. {_number(high)}{shape}"
        cells.append(_figure(what, _histogram(list(self[name]), (low, high), tuple(self.linear[k]))))
    said = "".join(f"<div>{_text(sentence)}</div>" for sentence in (self.verdict_text, *self.remarks) if sentence)
    mixed = "" if self.mixed else "<div><b>The chains do not mix: these are no samples of the density.</b></div>"
    return _box(f"Posterior, {len(self)} samples of {len(self.names)} variables",
                mixed + "".join(cells) + more + "<div>thick: 95 % of the samples, thin: the linear interval</div>" + said)


def _progress(trials):
    """Draws the best target so far over the trials, on a logarithmic scale."""
    best, x, y = math.inf, [], []
    for k, target in enumerate(trials.targets):
        if trials.violations[k] > 0 or not target > 0 or not math.isfinite(target):
            continue
        best = min(best, target)
        x.append(k + 1)
        y.append(math.log10(best))
    if len(x) < 2:
        return ""
    return _figure("best target over the trials, logarithmic", _curve(x, y, lambda power: _number(10 ** power)))


def _curve(x, y, said=lambda value: _number(value)):
    step = max(1, len(x) // _POINTS)
    if step > 1:  # each stretch keeps its least and its largest value, so that no peak is lost
        kept = []
        for at in range(0, len(y), 2 * step):
            stretch = [k for k in range(at, min(at + 2 * step, len(y))) if math.isfinite(y[k])]
            if stretch:
                kept += sorted({min(stretch, key=y.__getitem__), max(stretch, key=y.__getitem__)})
    else:
        kept = range(len(x))
    points = [(float(x[k]), float(y[k])) for k in kept if math.isfinite(x[k]) and math.isfinite(y[k])]
    if not points:
        return "<i>no finite number</i>"
    to_x, to_y = _scale([p[0] for p in points], _WIDTH), _scale([p[1] for p in points], _HEIGHT)
    line = " ".join(f"{to_x(a):.1f},{_HEIGHT - to_y(b):.1f}" for a, b in points)
    low, high = min(p[1] for p in points), max(p[1] for p in points)
    return _svg(f'<polyline points="{line}" fill="none" stroke="currentColor"/>', f"{said(low)} .. {said(high)}")


def _histogram(values, interval, linear):
    values = sorted(float(value) for value in values)
    low, high = values[0], values[-1]
    marks = [end for end in (*interval, *linear) if math.isfinite(end)]
    low, high = min([low, *marks]), max([high, *marks])
    if not high > low:
        return f"<b>{_number(low)}</b>"
    bins = [0] * 40
    for value in values:
        bins[min(int(len(bins) * (value - low) / (high - low)), len(bins) - 1)] += 1
    to_x, wide = _scale([low, high], _WIDTH), _WIDTH / len(bins)
    most = max(bins)
    bars = "".join(f'<rect x="{k * wide:.1f}" y="{(1 - count / most) * (_HEIGHT - 10):.1f}" width="{wide:.1f}" '
                   f'height="{count / most * (_HEIGHT - 10):.1f}" fill="currentColor" opacity="0.4"/>'
                   for k, count in enumerate(bins))
    for (a, b), y, thick in ((interval, _HEIGHT - 6, 4), (linear, _HEIGHT - 1, 1.5)):
        if math.isfinite(a) and math.isfinite(b):
            bars += (f'<line x1="{to_x(a):.1f}" x2="{to_x(b):.1f}" y1="{y}" y2="{y}" stroke="currentColor" '
                     f'stroke-width="{thick}"/>')
    return _svg(bars, f"{_number(low)} .. {_number(high)}")


def _scale(values, size):
    low, high = min(values), max(values)
    return (lambda value: size * (value - low) / (high - low)) if high > low else (lambda value: size / 2)


def _svg(drawing, title):
    return (f'<svg viewBox="-2 -2 {_WIDTH + 4} {_HEIGHT + 4}" width="{_WIDTH}" height="{_HEIGHT}" role="img">'
            f"<title>{title}</title>{drawing}</svg><div><small>{title}</small></div>")


def _figure(what, drawing):
    return f'<div style="display:inline-block;margin:4px 12px 4px 0;vertical-align:top"><div>{what}</div>{drawing}</div>'


def _table(heads, rows):
    shown, more = _first(list(rows))
    head = "".join(f'<th style="{_CELL}">{_text(one)}</th>' for one in heads)
    body = "".join("<tr>" + "".join(f'<td style="{_CELL}">{_text(one)}</td>' for one in row) + "</tr>" for row in shown)
    return f"<table><tr>{head}</tr>{body}</table>{more}"


def _box(title, content):
    return f"<div><div><b>{title}</b></div>{content}</div>"


def _first(things):
    """Returns the first things, and a line that says how many are left out."""
    left = len(things) - _MOST
    return things[:_MOST], f"<div>and {left} more</div>" if left > 0 else ""


def _number(value):
    return f"{float(value):.4g}"


def _text(value):
    return html.escape(str(value))
