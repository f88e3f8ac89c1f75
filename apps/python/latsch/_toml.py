# SPDX-License-Identifier: Apache-2.0
"""Converts Python values into TOML, so that the readers of files read and check arguments, with the same messages."""
import json
import os
import re


def value(of):
    """Returns a dict as an inline table, a sequence or an array as a list."""
    if hasattr(of, "tolist"):  # arrays and numbers of NumPy
        of = of.tolist()
    if isinstance(of, bool):
        return "true" if of else "false"
    if isinstance(of, int):
        return str(of)
    if isinstance(of, float):
        return repr(of)
    if isinstance(of, (str, os.PathLike)):
        return json.dumps(os.fspath(of), ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(of, dict):
        return "{" + ", ".join(f"{key(name)} = {value(one)}" for name, one in of.items()) + "}"
    if isinstance(of, (list, tuple)):
        return "[" + ", ".join(value(one) for one in of) + "]"
    raise TypeError(f"expected numbers, texts, lists and dicts, found {type(of).__name__}")


def key(name):
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else json.dumps(name, ensure_ascii=False)


def lines(table):
    """Returns one line `key = value` for each entry."""
    return "".join(f"{key(name)} = {value(one)}\n" for name, one in table.items())
