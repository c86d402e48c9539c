"""Packs and unpacks by libzstd, which every Debian has: `zstd -q --single-thread` would make the same bytes."""
import contextlib
import ctypes
import functools
import io

ROOM = 1 << 17  # the most bytes that the library writes at a time
LEVEL, CHECKSUM = 100, 201  # parameters of the library
GO_ON, END = 0, 2


class Buffer(ctypes.Structure):
    """Bytes that the library reads, or room that it writes into, and how many of them are done."""
    _fields_ = [("bytes", ctypes.c_char_p), ("size", ctypes.c_size_t), ("done", ctypes.c_size_t)]


def buffer(data):
    return Buffer(data, len(data), 0)


@functools.cache
def library():
    """libzstd, or None where it is missing."""
    with contextlib.suppress(OSError):
        found = ctypes.CDLL("libzstd.so.1")
        found.ZSTD_createCCtx.restype = found.ZSTD_createDCtx.restype = ctypes.c_void_p
        found.ZSTD_compressStream2.restype = found.ZSTD_decompressStream.restype = ctypes.c_size_t
        found.ZSTD_getErrorName.restype = ctypes.c_char_p
        return found
    return None


class Stream:
    """The library's state of a stream, and room for what the library makes."""

    def __init__(self, make, free):
        self.state, self.free, self.room = ctypes.c_void_p(make()), free, ctypes.create_string_buffer(ROOM)

    def __del__(self):
        self.free(self.state)

    def step(self, call, given, size, *more):
        """Lets the library go on with what is given. Returns what it made, at most `size` bytes, and how much it has left to do."""
        made = Buffer(ctypes.cast(self.room, ctypes.c_char_p), min(size, ROOM), 0)
        left = ctypes.c_size_t(call(self.state, ctypes.byref(made), ctypes.byref(given), *more))
        if library().ZSTD_isError(left):
            raise ValueError(f"packed by zstd: {library().ZSTD_getErrorName(left).decode()}")
        return ctypes.string_at(self.room, made.done), left.value


class Packer:
    """Packs as zlib.compressobj does."""

    def __init__(self, level):
        self.stream = Stream(library().ZSTD_createCCtx, library().ZSTD_freeCCtx)
        for parameter, value in ((LEVEL, level), (CHECKSUM, 1)):
            library().ZSTD_CCtx_setParameter(self.stream.state, parameter, value)

    def compress(self, data):
        given, packed = buffer(data), []
        while given.done < given.size:
            packed.append(self._step(given, GO_ON)[0])
        return b"".join(packed)

    def flush(self):
        packed, left = [], 1
        while left:
            made, left = self._step(buffer(b""), END)
            packed.append(made)
        return b"".join(packed)

    def _step(self, given, how):
        return self.stream.step(library().ZSTD_compressStream2, given, ROOM, how)


class Unpacked(io.RawIOBase):
    """The bytes that are packed in a file; ValueError where they are damaged or end early."""

    def __init__(self, file):
        super().__init__()
        self.file, self.stream = file, Stream(library().ZSTD_createDCtx, library().ZSTD_freeDCtx)
        self.given = buffer(b"")
        self.is_inside = False  # a frame of zstd that has not ended
        self.has_more = False  # bytes in the library for which there was no room

    def readable(self):
        return True

    def readinto(self, room):
        while self.has_more or self.given.done < self.given.size or self._reads():
            made, left = self.stream.step(library().ZSTD_decompressStream, self.given, len(room))
            self.is_inside, self.has_more = left > 0, left > 0 and len(made) == min(len(room), ROOM)
            if made:
                room[:len(made)] = made
                return len(made)
        return 0

    def _reads(self):
        """Reads on in the file; False at its end."""
        self.given = buffer(self.file.read(ROOM))
        if self.given.size == 0 and self.is_inside:
            raise ValueError("packed by zstd, and ends early")
        return self.given.size > 0

    def close(self):
        self.file.close()
        super().close()


def opened(path):
    """A binary file of the bytes that are packed in a file."""
    return io.BufferedReader(Unpacked(open(path, "rb", buffering=0)), ROOM)
