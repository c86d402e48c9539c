"""Messages of OSI, packed byte by byte as the wire format of protobuf says, and decoded by protoc.

The first argument of whole, real, message and vector is the number of the field.
"""
import os
import struct
import subprocess


def varint(number):
    number &= (1 << 64) - 1
    out = bytearray()
    while number > 0x7f:
        out.append(number & 0x7f | 0x80)
        number >>= 7
    return bytes(out + bytes([number]))


def whole(field, number):
    return varint(field << 3) + varint(number)


def real(field, number):
    return varint(field << 3 | 1) + struct.pack("<d", number)


def message(field, *parts):
    content = b"".join(parts)
    return varint(field << 3 | 2) + varint(len(content)) + content


def vector(field, *numbers, zeros=True):
    """Numbers of the fields 1, 2, ...; None is absent, and 0 too unless zeros."""
    return message(field, *[real(i + 1, number) for i, number in enumerate(numbers)
                            if number is not None and (zeros or number != 0)])


def box(x, y, yaw, size, *more, zeros=True):
    return message(2, vector(1, *size, zeros=zeros), vector(2, x, y, 0.75, zeros=zeros),
                   vector(3, 0, 0, yaw, zeros=zeros) if yaw is not None else b"", *more)


def moving(number, kind, x, y, yaw=None, size=(4.5, 1.8, 1.5), velocity=None, rate=None, rear=None, zeros=True):
    """kind is the type of a vehicle, or "pedestrian", "animal"."""
    more = (vector(4, *velocity, 0, zeros=zeros) if velocity else b"",
            vector(6, 0, 0, rate, zeros=zeros) if rate is not None else b"")
    identity = message(1, whole(1, number) if number or zeros else b"")
    if isinstance(kind, str):
        return message(5, identity, box(x, y, yaw, size, *more, zeros=zeros), whole(3, {"pedestrian": 3, "animal": 4}[kind]))
    axle = message(5, vector(4, *rear, zeros=zeros)) if rear else b""
    return message(5, identity, box(x, y, yaw, size, *more, zeros=zeros), whole(3, 2), axle,
                   message(6, whole(1, kind), message(2, whole(1, 3))))


def stationary(number, kind, x, y, yaw=0.0, size=(0.2, 0.2, 3)):
    return message(4, message(1, whole(1, number)), box(x, y, yaw, size), message(3, whole(1, kind), whole(2, 5)))


def stamp(time_ns, zeros=True):
    seconds, nanos = divmod(time_ns, 1_000_000_000)
    return message(2, whole(1, seconds) if seconds or zeros else b"", whole(2, nanos) if nanos or zeros else b"")


VERSION = message(1, whole(1, 3), whole(2, 8))
LANE = message(10, b"\x0a\x02\x08\x07", b"\x12\x20" + bytes(32))


def trace_of(*messages):
    return b"".join(struct.pack("<I", len(one)) + one for one in messages)


def parse(lines):
    """A message of protoc's text: {field: [values]}, to its closing brace."""
    fields = {}
    for line in lines:
        line = line.strip()
        if line == "}":
            break
        if line.endswith("{"):
            fields.setdefault(line[:-2], []).append(parse(lines))
        else:
            key, _, value = line.partition(": ")
            fields.setdefault(key, []).append(value)
    return fields


def value_of(fields, *path):
    """A number; 0 where it is absent, None where a message before it is."""
    for name in path[:-1]:
        if fields is None or name not in fields:
            return None
        fields = fields[name][-1]
    return float(fields[path[-1]][-1]) if path[-1] in fields else 0.0


def messages_in(trace):
    at = 0
    while at < len(trace):
        length = struct.unpack_from("<I", trace, at)[0]
        yield trace[at + 4:at + 4 + length]
        at += 4 + length


def decode(trace, kind, folder, place, *files):
    """The messages of a trace, by one run of protoc: they become fields of a message around all."""
    with open(os.path.join(folder, "trace.proto"), "w", encoding="ascii") as file:
        imports = "".join(f'import "{name}";\n' for name in files)
        file.write(f'syntax = "proto2";\n{imports}message Trace {{ repeated osi3.{kind} one = 1; }}\n')
    done = subprocess.run(["protoc", f"-I{folder}", f"-I{place}", "-I/usr/include", "--decode=Trace", "trace.proto"],
                          input=b"".join(message(1, one) for one in messages_in(trace)), capture_output=True, check=True)
    return parse(iter(done.stdout.decode().splitlines()))["one"]
