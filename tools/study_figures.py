"""Figures of expected.toml in the sentences and tables of a README outside of its written block.

A figure that is copied by hand stays as it is when a run renews expected.toml, and then contradicts it. So a README names
where its figure stands, in a comment that a page does not show, and tools/studies.py writes and checks it:

    The search ends after <!-- = fit_ring_tire.toml steps -->148<!-- / --> steps.

The first word is the study file, the second the path of the number in its entry: steps, target, values.NAME (its value),
values.NAME.lower, errors.NAME (its mean), errors.NAME.largest, results.NAME. Then words of how it is written, in any order:

    %           in percent, without the sign
    root        its square root
    minutes     seconds as minutes
    from 0.63   how far it is from 0.63, in percent of that, with its sign
    times 1000  in another unit
    4           with that many digits in place of 3
"""
import math
import re

FIGURE = re.compile(r"<!-- = (\S+) (\S+)((?: [^ >]+)*) -->(.*?)<!-- / -->", re.DOTALL)


class NoFigure(Exception):
    """Raised if a README names a figure that expected.toml does not have."""


def number_at(entry, path):
    """Returns the number of an entry of expected.toml at a path. Names of results contain dots themselves."""
    table, _, rest = path.partition(".")
    if table == "results":
        return entry["results"][rest]
    if table not in ("values", "errors"):
        return entry[path]
    if rest in entry[table]:
        return entry[table][rest]["value" if table == "values" else "mean"]
    name, _, key = rest.rpartition(".")
    return entry[table][name][key]


def with_digits(value, digits):
    """Returns the number with that many digits. Counts, and other whole numbers with fewer digits, are written whole."""
    if isinstance(value, int):
        return str(value)
    if value == int(value) and abs(value) < 1e15:
        return str(int(value)) if abs(value) < 10**digits else str(int(float(f"{value:.{digits}g}")))
    decimals = digits - 1 - math.floor(math.log10(abs(float(f"{value:.{digits}g}"))))
    return f"{value:.{max(0, decimals)}f}" if decimals >= 0 else str(int(float(f"{value:.{digits}g}")))


def written(value, words):
    """Returns the figure as the words of its comment ask for it."""
    digits, sign = 3, False
    words = list(words)
    while words:
        word = words.pop(0)
        if word == "root":
            value = math.sqrt(value)
        elif word == "%":
            value *= 100.0
        elif word == "minutes":
            value /= 60.0
        elif word == "times":
            value *= float(words.pop(0))
        elif word == "from":
            other = float(words.pop(0))
            value, sign = 100.0 * (value / other - 1.0), True
        elif word.isdigit():
            digits = int(word)
        else:
            raise NoFigure(f"a figure cannot be written \"{word}\"; tools/study_figures.py has the words")
    text = with_digits(value, digits)
    return "+" + text if sign and not text.startswith("-") else text


def figure_of(content, study, path, words):
    try:
        return written(number_at(content[study], path), words.split())
    except (KeyError, TypeError, IndexError):
        raise NoFigure(f"expected.toml has no figure \"{study} {path}\"") from None


def with_figures(text, content):
    """Returns the text of a README with its figures as expected.toml has them. A study without a run keeps its text."""
    def one(match):
        study, path, words, old = match.groups()
        entry = content.get(study, {})
        new = old if "no_run" in entry else figure_of(content, study, path, words)
        return match[0][:match.start(4) - match.start()] + new + match[0][match.end(4) - match.start():]

    return FIGURE.sub(one, text)


def differing_figures(text, content):
    """Returns in words every figure of a README that is not what expected.toml says."""
    wrong = []
    for match in FIGURE.finditer(text):
        study, path, words, old = match.groups()
        new = figure_of(content, study, path, words)
        if old != new and "no_run" not in content.get(study, {}):
            wrong.append(f"\"{old}\" is written for {study} {path}, where expected.toml says {new}")
    return wrong
