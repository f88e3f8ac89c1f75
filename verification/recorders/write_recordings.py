#!/usr/bin/env python3
"""Writes recorders' files (universal file 58, MDF 4; TDMS, RPC III and MoTeC by the modules beside this one) from
their formats' texts, independently of Latsch's readers.

   write_recordings.py FOLDER

Beside each file NAME stands NAME.expected: a line "group|channel|unit|values" for each channel, the values as
hexadecimal floating-point numbers, so that the test compares every bit."""
import math
import pathlib
import struct
import sys
import zlib

sys.dont_write_bytecode = True  # the modules lie beside the sources
import motec_files  # noqa: E402
import rpc_files  # noqa: E402
import tdms_files  # noqa: E402

FOLDER = pathlib.Path(sys.argv[1])
FOLDER.mkdir(parents=True, exist_ok=True)


def write(name, data, rows):
    (FOLDER / name).write_bytes(data)
    lines = ["|".join([group, channel, unit, " ".join(float(x).hex() if math.isfinite(x) else "nan" for x in values)])
             for group, channel, unit, values in rows]
    (FOLDER / (name + ".expected")).write_text("\n".join(lines) + "\n")


# Universal files.
def uff(number, body):
    return f"    -1\n{number:6d}\n".encode() + body + b"    -1\n"


def head(kind, numbers, count, even, first, step, unit, quantity, dof=(12, 3), reference=(1, -1), below=(0, "NONE")):
    lines = ["Response of the hub", "NONE", "01-Jan-26", "NONE", "NONE"]
    lines.append(f"{kind:5d}{1:10d}{0:5d}{0:10d} {'NONE':10s}{dof[0]:10d}{dof[1]:4d} {'NONE':10s}"
                 f"{reference[0]:10d}{reference[1]:4d}")
    lines.append(f"{numbers:10d}{count:10d}{even:10d}{first:13.5e}{step:13.5e}{0:13.5e}")
    over = (17, "s") if kind == 1 else (18, "Hz")
    for quantity_, unit_ in (over, (quantity, unit), below, (0, "NONE")):
        lines.append(f"{quantity_:10d}{0:5d}{0:5d}{0:5d} {'NONE':20s} {unit_:20s}")
    return "".join(f"{line:80s}\n" for line in lines).encode()


def text_58(kind, numbers, even, x, y, **more):
    is_complex, is_double = numbers in (5, 6), numbers in (4, 6)
    flat = []
    for t, value in zip(x, y):
        flat += ([] if even else [("x", t)]) + [("y", value.real)] + ([("y", value.imag)] if is_complex else [])
    per = 6 if not is_double else 3 if is_complex and not even else 4
    cells = [f"{v:20.12e}" if is_double and what == "y" else f"{v:13.5e}" for what, v in flat]
    body = b"".join(("".join(cells[i:i + per]) + "\n").encode() for i in range(0, len(cells), per))
    return uff(58, f"{'':80s}\n".encode()[:0] + head(kind, numbers, len(y), int(even), x[0], x[1] - x[0], **more) + body)


def binary_58(kind, numbers, even, x, y, order, lines=11, is_short=False, **more):
    is_complex, is_double = numbers in (5, 6), numbers in (4, 6)
    code, sign = "d" if is_double else "f", "<" if order == 1 else ">"
    data = b""
    for t, value in zip(x, y):
        if not even:
            data += struct.pack(sign + ("f" if is_short else code), t)
        data += struct.pack(sign + code, value.real) + (struct.pack(sign + code, value.imag) if is_complex else b"")
    first = f"    -1\n{58:6d}b{order:6d}{2:6d}{lines:12d}{len(data):12d}{0:6d}{0:6d}{0:12d}{0:12d}\n".encode()
    extra = b"a line more\n" * (lines - 11)
    return (first + head(kind, numbers, len(y), int(even), x[0], x[1] - x[0], **more) + extra + data + b"\n    -1\n")


X = [0.5 * i for i in range(7)]
UNEVEN = [0.25 * i * i for i in range(7)]
REAL = [complex(1.5 * i - 3.25, 0) for i in range(7)]
COMPLEX = [complex(1.5 * i - 3.25, 0.125 * i) for i in range(7)]
RE, IM = [v.real for v in COMPLEX], [v.imag for v in COMPLEX]
HEADER = uff(151, b"drum 3\nhub forces\n")
UNITS = uff(164, f"{5:10d}{'mm (milli-newton)':20s}{2:10d}\n{1e3:25.17E}{1e3:25.17E}{1:25.17E}\n{273.15:25.17E}\n"
            .replace("E+", "D+").encode())
POINTS = uff(15, f"{12:10d}{0:10d}{0:10d}{0:10d}{100:13.5e}{0:13.5e}{-250:13.5e}\n".encode())
POINTS_2411 = uff(2411, f"{1:10d}{0:10d}{0:10d}{0:10d}\n{100:25.16e}{0:25.16e}{0:25.16e}\n".replace("e+", "D+").encode())
FORCE = dict(unit="N", quantity=13)
SHIFTED = [(2, True, REAL), (2, False, REAL), (4, True, REAL), (4, False, REAL),
           (5, True, COMPLEX), (5, False, COMPLEX), (6, True, COMPLEX), (6, False, COMPLEX)]
for numbers, even, y in SHIFTED:
    x = X if even else UNEVEN
    parts = [("12+Z", RE)] if numbers in (2, 4) else [("12+Z real", RE), ("12+Z imag", IM)]
    rows = [("time 1", "time", "s", x)] + [("time 1", name, "N", values) for name, values in parts]
    name = f"{numbers}_{'even' if even else 'uneven'}"
    write(f"text_{name}.uff", HEADER + UNITS + POINTS + POINTS_2411 + text_58(1, numbers, even, x, y, **FORCE), rows)
    for order in (1, 2):
        write(f"binary_{name}_{order}.uff", HEADER + binary_58(1, numbers, even, x, y, order, 11 + order, **FORCE), rows)
    if not even and numbers in (4, 6):
        write(f"short_{name}.unv", binary_58(1, numbers, even, x, y, 1, is_short=True, **FORCE), rows)
LOUD = [complex(-1 - 2 ** -10 * i, 0) for i in range(7)]
touching = text_58(1, 2, True, X, LOUD, unit="NONE", quantity=12)
touching = touching.replace(b" -1.0", b"--1.0").replace(b"--1.0", b" -1.0")
write("units.uff", UNITS + touching, [("time 1", "time", "s", X),
                                      ("time 1", "12+Z", "m s^-2", [0.001 * float(f"{v.real:.5e}") for v in LOUD])])
kinds = [(2, "auto spectrum 12+Z", ""), (3, "cross spectrum 12+Z/1-X", ""), (4, "frf 12+Z/1-X", ""),
         (6, "coherence 12+Z/1-X", ""), (12, "spectrum 12+Z", "")]
write("functions.uff",
      b"".join(text_58(kind, 2, True, X, REAL, **FORCE) for kind, _, _ in kinds)
      + text_58(9, 2, True, X, REAL, **FORCE) + text_58(4, 2, True, X, REAL, unit="m/s^2", quantity=12, below=(13, "N")),
      [("frequency 1", "frequency", "Hz", X)] + [("frequency 1", name, "N", RE) for _, name, _ in kinds]
      + [("frequency 1", "frf 12+Z/1-X #2", "(m/s^2)/(N)", RE)])
write("touching.uff",
      text_58(1, 2, True, X, REAL, **FORCE).replace(b"  -3.25000e+00", b" -3.25000e+000").replace(b"1.25000e+00", b"1.25000+000"),
      [("time 1", "time", "s", X), ("time 1", "12+Z", "N", RE)])


# MDF 4.
class Mdf:
    """A file under construction: blocks are appended, a link is the position of a block."""

    def __init__(self, mark=b"MDF     ", version=410):
        self.data = bytearray(64 + 104)
        self.data[:64] = mark + b"4.10    " + b"writer  " + struct.pack("<4xH30xHH", version, 0, 0)
        self.groups = []

    def block(self, name, links, data, length=None):
        self.data += b"\0" * (-len(self.data) % 8)
        at = len(self.data)
        length = 24 + 8 * len(links) + len(data) if length is None else length
        self.data += struct.pack("<4sIQQ", b"##" + name, 0, length, len(links)) + struct.pack(f"<{len(links)}Q", *links)
        self.data += data
        return at

    def text(self, text):
        return self.block(b"TX", [], text.encode() + b"\0") if text else 0

    def rule(self, kind, values, unit=""):
        links = [0, self.text(unit), 0, 0] + ([self.text("formula")] if kind == 3 else [])
        return self.block(b"CC", links, struct.pack(f"<BBHHHdd{len(values)}d", kind, 0, 0, len(links) - 4, len(values),
                                                    0, 0, *values))

    def channel(self, following, name, data_type, bit, byte, bits, kind=0, unit="", rule=0, flags=0, invalid=0, part=0,
                xml=False):
        unit_at = self.block(b"MD", [], f"<CNunit><TX>{unit}</TX></CNunit>".encode()) if xml else self.text(unit)
        return self.block(b"CN", [following, part, self.text(name), 0, rule, 0, unit_at, 0],
                          struct.pack("<BBBBIIIIBBH6d", kind, 1 if kind in (2, 3) else 0, data_type, bit, byte, bits,
                                      flags, invalid, 0, 0, 0, *[0.0] * 6))

    def channels(self, rows):
        following = 0
        for row in reversed(rows):
            following = self.channel(following, *row[0], **row[1])
        return following

    def channel_group(self, following, first, name, record_id, cycles, size, invalid=0, flags=0, master=None):
        links = [following, first, self.text(name), 0, 0, 0] + ([] if master is None else [master])
        return self.block(b"CG", links, struct.pack("<QQHHIII", record_id, cycles, flags, 0, 0, size, invalid))

    def data_group(self, first, data, id_bytes=0):
        self.groups.append((first, data, id_bytes))

    def end(self):
        following = 0
        for first, data, id_bytes in reversed(self.groups):
            following = self.block(b"DG", [following, first, data, 0], struct.pack("<B7x", id_bytes))
        self.data[64:168] = struct.pack("<4sIQQ6Q", b"##HD", 0, 104, 6, following, 0, 0, 0, 0, 0) + bytes(32)
        return bytes(self.data)


def packed(mdf, data, columns=0):
    plain = data
    if columns:
        rows = len(data) // columns
        plain = bytes(data[r * columns + c] for c in range(columns) for r in range(rows)) + data[rows * columns:]
    body = zlib.compress(plain)
    return mdf.block(b"DZ", [], struct.pack("<2sBBIQQ", b"DT", 1 if columns else 0, 0, columns, len(data), len(body)) + body)


def listed(mdf, parts, following=0):
    return mdf.block(b"DL", [following] + parts, struct.pack("<B3xIQ", 1, len(parts), 0))


N = 40
TIME = [0.001 * i for i in range(N)]
BITS = [(i * 2654435761 + 12345) & (2 ** 64 - 1) for i in range(N)]
BITS = [(b * 6364136223846793005 + 1442695040888963407) & (2 ** 64 - 1) for b in BITS]


def signed(value, bits):
    return value - (1 << bits) if value >> (bits - 1) else value


FIELDS = [("u3", 0, 5, 8, 3), ("u16be", 1, 0, 9, 16), ("s12", 2, 4, 11, 12), ("u13be", 1, 2, 13, 13), ("s64", 2, 3, 15, 64),
          ("s64be", 3, 3, 24, 64), ("half", 4, 0, 33, 16), ("single", 4, 0, 35, 32), ("single_be", 5, 0, 39, 32),
          ("double_be", 5, 0, 43, 64), ("s32", 2, 0, 51, 32), ("u32", 0, 0, 55, 32), ("s16", 2, 0, 59, 16),
          ("u24", 0, 0, 61, 24), ("s8", 2, 0, 64, 8)]
SIZE = 65


def records(with_time=True):
    """Returns N records and the numbers in them."""
    values, result = {field[0]: [] for field in FIELDS}, []
    for i in range(N):
        record = bytearray(SIZE)
        record[:8] = struct.pack("<d", TIME[i])
        for k, (name, kind, bit, byte, bits) in enumerate(FIELDS):
            raw = (BITS[i] * (2 * k + 1)) & ((1 << bits) - 1)
            if kind in (4, 5):
                number = (i - 20) * 1.25
                code = {16: "e", 32: "f", 64: "d"}[bits]
                raw = int.from_bytes(struct.pack("<" + code, number), "little")
            else:
                number = float(signed(raw, bits) if kind in (2, 3) else raw)
            count = (bit + bits + 7) // 8
            record[byte:byte + count] = (int.from_bytes(record[byte:byte + count], "little") | 0).to_bytes(count, "little")
            record[byte:byte + count] = (raw << bit).to_bytes(count, "big" if kind in (1, 3, 5) else "little")
            values[name].append(number)
        result.append(bytes(record))
    return result, values


RECORDS, VALUES = records()
ALL = [(("t", 4, 0, 0, 64), dict(kind=2, unit="s"))] + [((name, kind, bit, byte, bits), dict(unit="N", xml=name == "u3"))
                                                        for name, kind, bit, byte, bits in FIELDS]
EXPECTED = [("rig", "time", "s", TIME)] + [("rig", field[0], "N", VALUES[field[0]]) for field in FIELDS]
JOINED = b"".join(RECORDS)
CUTS = [0, 100, 777, 1500, len(JOINED)]
PARTS = [JOINED[a:b] for a, b in zip(CUTS, CUTS[1:])]


def sorted_file(name, data_of, mark=b"MDF     ", cycles=N, rows=EXPECTED, tail=b""):
    mdf = Mdf(mark)
    group = mdf.channel_group(0, mdf.channels(ALL), "rig", 0, cycles, SIZE)
    if mark == b"MDF     ":
        mdf.data_group(group, data_of(mdf))
        write(name, mdf.end(), rows)
    else:
        mdf.data += b"\0" * (-len(mdf.data) % 8)
        mdf.data_group(group, len(mdf.data) + 64)
        data = mdf.end()
        assert len(data) % 8 == 0
        position = len(data)
        data = data.replace(struct.pack("<Q", mdf.groups[0][1]), struct.pack("<Q", position))
        write(name, data + struct.pack("<4sIQQ", b"##DT", 0, 24, 0) + JOINED + tail, rows)


sorted_file("plain.mf4", lambda m: m.block(b"DT", [], JOINED))
sorted_file("list.mf4", lambda m: listed(m, [m.block(b"DT", [], p) for p in PARTS[:2]],
                                         listed(m, [m.block(b"DT", [], p) for p in PARTS[2:]])))
sorted_file("deflated.mdf", lambda m: packed(m, JOINED))
sorted_file("transposed.mf4", lambda m: packed(m, JOINED, SIZE))
sorted_file("transposed_rest.mf4", lambda m: packed(m, JOINED, SIZE - 2))
sorted_file("headed.mf4", lambda m: m.block(b"HL", [listed(m, [packed(m, p, SIZE) for p in PARTS])], struct.pack("<HB5x", 1, 1)))
sorted_file("unfinished.mf4", None, b"UnFinMF ", 0, tail=JOINED[:SIZE - 1])

# Rules.
mdf = Mdf()
RAW = [i - 5 for i in range(16)]
TABLE, RANGES = [-2, 10, 0, 20, 4, 60], [-3, -1, 7, 2, 4, 9, -99]
rules = [("none", mdf.rule(0, []), lambda x: x), ("linear", mdf.rule(1, [2.5, 0.5], "kN"), lambda x: 0.5 * x + 2.5),
         ("rational", mdf.rule(2, [1, 0, 2, 0, 1, -3]), lambda x: (x * x + 2) / (x - 3) if x != 3 else math.nan),
         ("between", mdf.rule(4, TABLE),
          lambda x: 10 if x <= -2 else 60 if x >= 4 else 10 + 10 * (x + 2) / 2 if x < 0 else 20 + 40 * x / 4),
         ("nearest", mdf.rule(5, TABLE), lambda x: 10 if x <= -1 else 20 if x <= 2 else 60),
         ("range", mdf.rule(6, RANGES), lambda x: 7 if -3 <= x <= -1 else 9 if 2 <= x <= 4 else -99)]
left = [(("text", 7, 0, 0, 32), {}), (("texts", 2, 0, 0, 32), dict(rule=mdf.rule(7, [1.0]))),
        (("formula", 2, 0, 0, 32), dict(rule=mdf.rule(3, []))), (("long", 0, 0, 0, 32), dict(kind=1)),
        (("bits", 0, 0, 0, 65), {}), (("array", 0, 0, 0, 32), dict(part=mdf.block(b"CA", [], bytes(16))))]
rows = [((name, 2, 0, 0, 32), dict(rule=rule, unit="" if name == "linear" else "N")) for name, rule, _ in rules]
virtual = [(("", 0, 0, 0, 0), dict(kind=3, rule=mdf.rule(1, [1.0, 0.01])))]
group = mdf.channel_group(0, mdf.channels(virtual + rows + left), "", 0, len(RAW), 4)
mdf.data_group(group, mdf.block(b"DT", [], b"".join(struct.pack("<i", x) for x in RAW)))
write("rules.mf4", mdf.end(), [("group 1", "time", "s", [0.01 * i + 1.0 for i in range(len(RAW))])]
      + [("group 1", name, "kN" if name == "linear" else "N", [rule(x) for x in RAW]) for name, _, rule in rules])

# Unsorted, with values of variable length between the records, and invalid samples.
for id_bytes in (1, 2, 4, 8):
    mdf = Mdf()
    slow = mdf.channels([(("t", 4, 0, 0, 64), dict(kind=2)),
                         (("Fz", 4, 0, 8, 32), dict(unit="N", flags=2, invalid=3))])
    fast = mdf.channels([(("t", 4, 0, 0, 64), dict(kind=2)), (("Fz", 2, 0, 8, 16), dict(unit="kN"))])
    groups = mdf.channel_group(0, 0, "long", 9, 0, 0, flags=1)
    groups = mdf.channel_group(groups, fast, "fast", 7, 20, 10)
    groups = mdf.channel_group(groups, slow, "slow", 5, 5, 12, invalid=1)
    stream, tag = b"", lambda i: i.to_bytes(id_bytes, "little")
    for i in range(20):
        stream += tag(7) + struct.pack("<dh", 0.001 * i, 3 * i - 7)
        if i % 4 == 0:
            stream += tag(5) + struct.pack("<dfB", 0.001 * i, 0.5 * i, 8 if i == 8 else 0)
            stream += tag(9) + struct.pack("<I", 5) + b"hello"
    stream += (tag(7) + b"cut")
    mdf.data_group(groups, mdf.block(b"DT", [], stream), id_bytes)
    write(f"unsorted_{id_bytes}.mf4", mdf.end(),
          [("slow", "time", "s", [0.001 * i for i in range(0, 20, 4)]),
           ("slow", "Fz", "N", [math.nan if i == 8 else 0.5 * i for i in range(0, 20, 4)]),
           ("fast", "time", "s", [0.001 * i for i in range(20)]), ("fast", "Fz", "kN", [3 * i - 7 for i in range(20)])])

# Columns in data groups of their own, with the master in another one.
mdf = Mdf(version=420)
master = mdf.channel_group(0, mdf.channels([(("t", 4, 0, 0, 64), dict(kind=2, unit="ms"))]), "columns", 0, N, 8)
mdf.data_group(master, mdf.block(b"DV", [], b"".join(struct.pack("<d", t) for t in TIME)))
for name in ("Fx", "Fz"):
    group = mdf.channel_group(0, mdf.channels([((name, 5, 0, 0, 64), dict(unit="N"))]), name, 0, N, 8, flags=8, master=master)
    part = [mdf.block(b"DV", [], b"".join(struct.pack(">d", 2 * t) for t in half)) for half in (TIME[:9], TIME[9:])]
    mdf.data_group(group, mdf.block(b"LD", [0] + part, struct.pack("<IIQ", 1, 2, 72)))
write("columns.mf4", mdf.end(), [("columns", "time", "ms", TIME)]
      + [("columns", name, "N", [2 * t for t in TIME]) for name in ("Fx", "Fz")])

for kind in (tdms_files, rpc_files, motec_files):
    kind.write_all(write)
