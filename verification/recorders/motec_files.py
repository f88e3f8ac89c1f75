"""Writes logs of MoTeC as public readers describe them."""
import struct

HEAD, BLOCK = 0x6e2 + 64, 124


def write_all(write):
    # name, unit, kind, code, rate, shift, multiplier, scale, decimals, numbers
    channels = [("Damper FL", "mm", 3, "h", 20, 5, 2, 3, 1, list(range(-4, 6))),
                ("Ground Speed", "km/h", 5, "i", 50, 0, 1, 1, 2, [100000 * i - 7 for i in range(25)]),
                ("Brake Temp", "C", 0, "h", 20, -40, 1, 10, 0, list(range(10))),
                ("Force", "N", 7, "f", 20, 0, 1, 1, 0, [0.5 * i for i in range(10)]),
                ("Half", "", 7, "e", 50, 0, 3, 2, -1, [0.25 * i for i in range(24)]),
                ("Strange", "V", 9, "h", 20, 0, 1, 1, 0, [1, 2]), ("No Scale", "V", 3, "h", 20, 0, 1, 0, 0, [1, 2])]
    blocks, data = b"", b""
    for k, (name, unit, kind, code, rate, shift, multiplier, scale, decimals, numbers) in enumerate(channels):
        at, values = HEAD + BLOCK * k, struct.pack(f"<{len(numbers)}{code}", *numbers)
        blocks += struct.pack("<IIIIHHHHhhhh32s8s12s40x", at - BLOCK if k else 0, at + BLOCK if k + 1 < len(channels) else 0,
                              HEAD + BLOCK * len(channels) + len(data), len(numbers), 0x2ee1 + k, kind,
                              struct.calcsize(code), rate, shift, multiplier, scale, decimals, name.encode(), b"",
                              unit.encode())
        data += values
    head = bytearray(HEAD)
    head[:16] = struct.pack("<I4xII", 0x40, HEAD, HEAD + BLOCK * len(channels))
    for at, text in ((0x5e, "30/11/2026"), (0x7e, "10:15:00"), (0x9e, "A. Driver"), (0xde, "Car 7"), (0x15e, "Proving ground")):
        head[at:at + len(text)] = text.encode()
    rows = []
    for name, unit, _, _, rate, shift, multiplier, scale, decimals, numbers in channels[:5]:
        group = f"{rate} Hz" if name != "Half" else "50 Hz #2"
        if not any(row[0] == group for row in rows):
            rows.append((group, "time", "s", [i / rate for i in range(len(numbers))]))
        rows.append((group, name, unit, [(x / scale * 10.0 ** -decimals + shift) * multiplier for x in numbers]))
    write("log.ld", bytes(head) + blocks + data, rows)
