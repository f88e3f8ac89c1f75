"""Writes TDMS files from National Instruments' text on their internal structure."""
import math
import struct

CODES = {1: "b", 2: "h", 3: "i", 4: "q", 5: "B", 6: "H", 7: "I", 8: "Q", 9: "f", 10: "d", 0x19: "f", 0x1a: "d", 0x21: "B"}
DESCRIBES, NEW_LIST, HAS_DATA, INTERLEAVED, BIG_ENDIAN, DAQMX = 2, 4, 8, 32, 64, 128
NO_DATA, AS_BEFORE = "no data", "as before"


def text(order, value):
    return struct.pack(order + "I", len(value.encode())) + value.encode()


def prop(order, name, value):
    if isinstance(value, str):
        return text(order, name) + struct.pack(order + "I", 0x20) + text(order, value)
    if isinstance(value, tuple):  # a time stamp: seconds, fraction in units of 2^-64
        stamp = struct.pack("<Qq", value[1], value[0]) if order == "<" else struct.pack(">qQ", *value)
        return text(order, name) + struct.pack(order + "I", 0x44) + stamp
    if isinstance(value, int):
        return text(order, name) + struct.pack(order + "Ii", 3, value)
    return text(order, name) + struct.pack(order + "Id", 10, value)


def segment(objects, data, contents, length=None, version=4713):
    """Returns a segment: objects are (path, index, properties), an index (type, count[, bytes]) or one of the words."""
    order = ">" if contents & BIG_ENDIAN else "<"
    body = b""
    if contents & DESCRIBES:
        body = struct.pack(order + "I", len(objects))
        for path, index, properties in objects:
            body += text(order, path)
            if index in (NO_DATA, AS_BEFORE):
                body += struct.pack(order + "I", 0xffffffff if index == NO_DATA else 0)
            else:
                body += struct.pack(order + "IIIQ", 20 + 8 * (len(index) - 2), index[0], 1, index[1])
                body += b"".join(struct.pack(order + "Q", size) for size in index[2:])
            body += struct.pack(order + "I", len(properties)) + b"".join(prop(order, *one) for one in properties.items())
    length = len(body) + len(data) if length is None else length
    return b"TDSm" + struct.pack("<I", contents) + struct.pack(order + "IQQ", version, length, len(body)) + body + data


def pack(order, kind, values):
    return struct.pack(f"{order}{len(values)}{CODES[kind]}", *values)


def rows_of(order, columns):
    return b"".join(pack(order, kind, [values[i]]) for i in range(len(columns[0][1])) for kind, values in columns)


def times(count, step, first=0.0, start=0.0):
    return [start + first + i * step for i in range(count)]


def write_all(write):
    wave = {"wf_increment": 0.001, "wf_start_offset": 0.5, "wf_samples": 6}
    fz, fx = [1000.0 + 0.1 * i for i in range(18)], [3 * i - 7 for i in range(18)]
    for order, end in (("<", 0), (">", BIG_ENDIAN)):
        name = "little" if order == "<" else "big"
        first = [("/", NO_DATA, {"title": "Drum 3"}), ("/'hub'", NO_DATA, {}),
                 ("/'hub'/'Fz'", (10, 3), dict(wave, unit_string="N")), ("/'hub'/'Fx'", (2, 3), dict(wave, unit_string="kN"))]
        chunk = lambda k: pack(order, 10, fz[3 * k:3 * k + 3]) + pack(order, 2, fx[3 * k:3 * k + 3])  # noqa: E731
        data = (segment(first, chunk(0), DESCRIBES | NEW_LIST | HAS_DATA | end)
                + segment([], chunk(1) + chunk(2), HAS_DATA | end)                  # two chunks, nothing described
                + segment([("/'hub'", NO_DATA, {"operator": "B"})], chunk(3), DESCRIBES | HAS_DATA | end)
                + segment([("/'hub'/'Fx'", AS_BEFORE, {}), ("/'hub'/'Fz'", AS_BEFORE, {})],
                          pack(order, 2, fx[12:15]) + pack(order, 10, fz[12:15]), DESCRIBES | NEW_LIST | HAS_DATA | end)
                + segment([("/'hub'/'Fz'", (10, 3), {})], pack(order, 2, fx[15:18]) + pack(order, 10, fz[15:18]),
                          DESCRIBES | HAS_DATA | end))
        write(f"segments_{name}.tdms", data, [("hub", "time", "s", times(18, 0.001, 0.5)), ("hub", "Fz", "N", fz),
                                              ("hub", "Fx", "kN", fx)])
        kinds = [kind for kind in CODES if kind not in (0x19, 0x1a, 0x21)] + [0x19, 0x1a, 0x21]
        columns = [(kind, [float(i) - 2 if CODES[kind] in "fd" else i - 2 if CODES[kind].islower() else i % 2 * 200 + i
                           for i in range(5)]) for kind in kinds if kind != 0x21] + [(0x21, [0, 1, 1, 0, 1])]
        objects = [(f"/'all'/'kind {kind}'", (kind, 5), {"unit_string": "N"}) for kind, _ in columns]
        rows = [("all", f"kind {kind}", "N", values) for kind, values in columns]
        write(f"interleaved_{name}.tdms",
              segment(objects, rows_of(order, columns), DESCRIBES | NEW_LIST | HAS_DATA | INTERLEAVED | end), rows)
        write(f"kinds_{name}.tdms", segment(objects, b"".join(pack(order, *one) for one in columns),
                                            DESCRIBES | NEW_LIST | HAS_DATA | end), rows)
    part = [("/'hub'", NO_DATA, {}), ("/'hub'/'Fz'", (10, 1000), {"wf_increment": 0.0, "unit_string": "N"})]
    write("part.tdms", segment(part, pack("<", 10, fz[:6]), DESCRIBES | NEW_LIST | HAS_DATA), [("hub", "Fz", "N", fz[:6])])
    # Groups of two rates, the second one 0.25 s later; a quote in a name; channels that are left out between others.
    start, later = (3800000000, 0), (3800000000, 1 << 62)
    slow = dict(wf_increment=0.01, wf_start_time=later, unit_string="degC")
    texts = b"".join(struct.pack("<I", end) for end in (3, 6, 9)) + b"onetwosix"
    objects = [("/'Dr. T''s'/'Fz'", (9, 4), dict(wf_increment=0.002, wf_start_time=start, unit_string="kN")),
               ("/'Dr. T''s'/'note'", (0x20, 3, len(texts)), {}), ("/'slow'/'T'", (3, 2), slow),
               ("/'slow'/'clock'", (0x44, 2), {}), ("/'slow'/'vector'", (0x08000c, 2), {}),
               ("/'slow'/'counts'", (2, 2), {"NI_Number_Of_Scales": 1, "NI_Scaling_Status": "unscaled"}),
               ("/'list'/'Time'", (10, 3), {"unit_string": "ms"}), ("/'list'/'Mz'", (10, 3), {"unit_string": "N m"})]
    force, list_time, list_moment = [0.5, 1.5, -2.25, 8.0], [0.0, 1.0, 4.0], [1.0, math.nan, 3.0]
    data = (pack("<", 9, force) + texts + pack("<", 3, [20, 21]) + bytes(32) + bytes(16) + pack("<", 2, [7, 8])
            + pack("<", 10, list_time) + pack("<", 10, list_moment))
    write("groups.tdms", segment(objects, data, DESCRIBES | NEW_LIST | HAS_DATA, version=4712),
          [("Dr. T's", "time", "s", times(4, 0.002)), ("Dr. T's", "Fz", "kN", force),
           ("slow", "time", "s", times(2, 0.01, 0.0, 0.25)), ("slow", "T", "degC", [20, 21]),
           ("list", "time", "ms", list_time), ("list", "Mz", "N m", list_moment)])
    # Files that were not closed, or are cut off: the last segment ends within a record.
    pair = [("/'hub'/'Fz'", (10, 3), wave), ("/'hub'/'Fx'", (2, 3), wave)]
    numbers = [(10, fz[:6]), (2, fx[:6])]
    flags = DESCRIBES | NEW_LIST | HAS_DATA
    read = [("hub", "time", "s", times(6, 0.001, 0.5)), ("hub", "Fz", "", fz[:6]), ("hub", "Fx", "", fx[:6])]
    part = rows_of("<", [(10, fz[6:7]), (2, fx[6:7])])[:9]
    write("open.tdms", segment(pair, rows_of("<", numbers) + part, flags | INTERLEAVED, (1 << 64) - 1), read)
    chunks = b"".join(pack("<", 10, fz[a:a + 3]) + pack("<", 2, fx[a:a + 3]) for a in (0, 3, 6))
    whole = segment(pair, chunks, flags)
    write("cut.tdms", whole[:-5], read)
    write("cut_description.tdms", segment(pair, chunks[:60], flags) + segment(pair, chunks, flags)[:80], read)
    one = segment(pair[:1], pack("<", 10, fz[:6]) + b"123", flags, (1 << 64) - 1)
    write("open_alone.tdms", one, read[:2])
