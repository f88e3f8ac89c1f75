"""Writes time histories of RPC III from MTS' text on RPC file formats."""
import struct


def header(records):
    records = [("FORMAT", records.pop("FORMAT")), ("NUM_HEADER_BLOCKS", 0), ("NUM_PARAMS", 0)] + list(records.items())
    blocks = (len(records) + 3) // 4
    records[1], records[2] = ("NUM_HEADER_BLOCKS", blocks), ("NUM_PARAMS", len(records))
    data = b"".join(struct.pack("<32s96s", key.encode(), str(value).encode()) for key, value in records)
    return data + bytes(512 * blocks - len(data))


def history(columns, code, order, frame, group, whole=True, **more):
    """Returns the groups of the channels, the last one filled up with zeros, and the number of frames."""
    samples, data = len(columns[0]), b""
    for begin in range(0, samples, group):
        for values in columns:
            part = values[begin:begin + group]
            part = part + [0] * ((group if whole else -(-len(part) // frame) * frame) - len(part))
            data += struct.pack(f"{order}{len(part)}{code}", *part)
    return data, -(-samples // frame)


def write_all(write):
    step, scales = "4.882813E-03", ("3.053249E-04", "-2.5")
    names = ('"Left vertical"', "Fz")
    ints = [[((i * 7919) % 65536) - 32768 for i in range(37)], [5 * i + 1 for i in range(37)]]
    reals = [[1.5 * i - 3 for i in range(37)], [0.25 * i + 1 for i in range(37)]]

    def expected(columns, factors, samples=37):
        time = [i * float(step) for i in range(samples)]
        return [("time history", "time", "s", time)] + [
            ("time history", name, unit, [x * factor for x in values[:samples]])
            for name, unit, values, factor in zip(("Left vertical", "Fz"), ("mm", "kN"), columns, factors)]

    def rpc(columns, kind, form, frame, group, whole=True, **more):
        order, code = ">" if form.endswith("BIG_END") else "<", "h" if kind == "SHORT_INTEGER" else "f"
        data, frames = history(columns, code, order, frame, group, whole)
        records = dict(FORMAT=form, FILE_TYPE="TIME_HISTORY", DATA_TYPE=kind, TIME_TYPE="RESPONSE", DELTA_T=step,
                       PTS_PER_FRAME=frame, CHANNELS=len(columns), PTS_PER_GROUP=group, FRAMES=frames, HALF_FRAMES=0,
                       INT_FULL_SCALE=32752)
        for i, _ in enumerate(columns):
            records[f"DESC.CHAN_{i + 1}"], records[f"UNITS.CHAN_{i + 1}"] = names[i], ("mm", "kN")[i]
            records[f"SCALE.CHAN_{i + 1}"] = scales[i] if code == "h" else "1."
        records.update(more)
        return header({key: value for key, value in records.items() if value is not None}) + data

    factors = [float(x) for x in scales]
    for form in ("BINARY", "BINARY_IEEE_LITTLE_END", "BINARY_IEEE_BIG_END"):
        end = "rsp" if form == "BINARY" else "drv" if form.endswith("LITTLE_END") else "tim"
        write(f"integers.{end}", rpc(ints, "SHORT_INTEGER", form, 4, 8), expected(ints, factors))
        write(f"reals_{end}.rsp", rpc(reals, "FLOATING_POINT", form, 8, 8), expected(reals, [1.0, 1.0]))
    plain = rpc(ints, "SHORT_INTEGER", "BINARY", 4, 16, DATA_TYPE=None, TIME_TYPE=2)
    write("short_group.rsp", rpc(ints, "SHORT_INTEGER", "BINARY", 8, 16, False), expected(ints, factors))
    write("stated_samples.rsp", rpc(ints, "SHORT_INTEGER", "BINARY", 8, 16, SAMPLES=30), expected(ints, factors, 30))
    write("default_type.rsp", plain, expected(ints, factors))
    write("cut.rsp", plain[:-20], expected(ints, factors, 32))
    write("trailing.rsp", plain + b"more", expected(ints, factors))
    full = [values[:32] for values in ints]
    write("no_filling.rsp", rpc(full, "SHORT_INTEGER", "BINARY", 4, 16), expected(full, factors, 32))
