#!/usr/bin/env python3
"""Makes the EXR fixtures of this folder and the seeds in test/fuzz/corpus/picture/, byte by byte and without any
picture library, so that the readers are checked against something else than their own writers. (Two seeds,
piz.exr and pxr24.exr, are not made here: they came from OpenEXRCore.)

Run it by hand from anywhere: python3 test/data/picture/make_pictures.py
"""
import os
import struct
import zlib

HERE = os.path.dirname(os.path.abspath(__file__))
CORPUS = os.path.join(HERE, "..", "..", "fuzz", "corpus", "picture")
HALF, FLOAT, UINT = 1, 2, 0
NONE, ZIPS, ZIP, B44 = 0, 2, 3, 6
LINES = {NONE: 1, ZIPS: 1, ZIP: 16, B44: 32}


def value(channel, x, y):
    """What every fixture holds at a pixel: exact in a half. test_picture_exr.c knows the same formula."""
    return "RGBAY".index(channel) * 100 + y * 10 + x + 0.5


# ---- EXR ----

def attribute(name, kind, data):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data


def channel_list(channels, kind, sampling=1):
    text = b""
    for name in sorted(channels):
        text += name.encode() + b"\0" + struct.pack("<iB3xii", kind, 0, sampling, sampling)
    return text + b"\0"


def pack(data, compression):
    if compression not in (ZIP, ZIPS):
        return data
    half = (len(data) + 1) // 2
    mixed = bytearray(len(data))
    mixed[:half] = data[0::2]
    mixed[half:] = data[1::2]
    for i in range(len(mixed) - 1, 0, -1):
        mixed[i] = (mixed[i] - mixed[i - 1] + 128) & 255
    packed = zlib.compress(bytes(mixed))
    return packed if len(packed) < len(data) else data


def block(channels, kind, x0, y0, width, height):
    """Pixels of a rectangle: per row, per channel in sorted order."""
    code = {HALF: "e", FLOAT: "f", UINT: "I"}[kind]
    data = b""
    for y in range(y0, y0 + height):
        for name in sorted(channels):
            for x in range(x0, x0 + width):
                number = value(name[-1], x, y)
                data += struct.pack("<" + code, int(number) if kind == UINT else number)
    return data


def exr(channels, kind, width, height, compression=ZIP, corner=(0, 0), tile=None, sampling=1):
    x0, y0 = corner
    window = struct.pack("<iiii", x0, y0, x0 + width - 1, y0 + height - 1)
    head = b"\x76\x2f\x31\x01" + struct.pack("<I", 2 | (0x200 if tile else 0))
    head += attribute("channels", "chlist", channel_list(channels, kind, sampling))
    head += attribute("compression", "compression", bytes([compression]))
    head += attribute("dataWindow", "box2i", window)
    head += attribute("displayWindow", "box2i", window)
    head += attribute("lineOrder", "lineOrder", b"\0")
    head += attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    head += attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0))
    head += attribute("screenWindowWidth", "float", struct.pack("<f", 1))
    if tile:
        head += attribute("tiles", "tiledesc", struct.pack("<IIB", tile[0], tile[1], 0))
    head += b"\0"
    chunks = []
    if tile:
        for ty in range(0, height, tile[1]):
            for tx in range(0, width, tile[0]):
                data = pack(block(channels, kind, tx, ty, min(tile[0], width - tx), min(tile[1], height - ty)),
                            compression)
                chunks.append(struct.pack("<iiiii", tx // tile[0], ty // tile[1], 0, 0, len(data)) + data)
    else:
        for y in range(0, height, LINES[compression]):
            data = pack(block(channels, kind, 0, y, width, min(LINES[compression], height - y)), compression)
            chunks.append(struct.pack("<ii", y0 + y, len(data)) + data)
    offset = len(head) + 8 * len(chunks)
    table = b""
    for chunk in chunks:
        table += struct.pack("<Q", offset)
        offset += len(chunk)
    return head + table + b"".join(chunks)


def short_block(data, size):
    """Claims fewer bytes than there are for the last row of y_float.exr."""
    at = len(data) - 24 - 4
    return data[:at] + struct.pack("<i", size) + data[at + 4:]


EXRS = {
    "rgb_half.exr": exr("RGB", HALF, 5, 20),
    "rgb_half_none.exr": exr("RGB", HALF, 5, 3, NONE),
    "rgba_float.exr": exr("RGBA", FLOAT, 4, 3, ZIPS),
    "y_float.exr": exr("Y", FLOAT, 6, 4, NONE),
    "ya_half.exr": exr("YA", HALF, 3, 2),
    "rgb_window.exr": exr("RGB", FLOAT, 3, 18, ZIP, (-7, 11)),
    "rgb_tiled.exr": exr("RGB", HALF, 7, 5, ZIP, (0, 0), (4, 2)),
    "rgba_tiled.exr": exr("RGBA", FLOAT, 5, 5, NONE, (2, 3), (2, 3)),
    "extra_channels.exr": exr(["B", "G", "R", "Y", "Z.R"], HALF, 5, 3, NONE),
    "bad_block.exr": short_block(exr("Y", FLOAT, 6, 4, NONE), 23),
    "bad_uint.exr": exr("RGB", UINT, 2, 2, NONE),
    "bad_sampling.exr": exr("RGB", HALF, 2, 2, NONE, sampling=2),
    "bad_layer.exr": exr(["key.R", "key.G", "key.B"], HALF, 2, 2, NONE),
    "bad_b44.exr": exr("RGB", HALF, 4, 4, B44),
}


# ---- PNG ----

def png_chunk(kind, data, crc=None):
    check = zlib.crc32(kind + data) if crc is None else crc
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", check)


def png(width, height, depth, colour, rows, extra=b"", interlace=0, idat=None):
    head = struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, interlace)
    data = zlib.compress(rows) if idat is None else idat
    return (b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", head) + extra + png_chunk(b"IDAT", data) +
            png_chunk(b"IEND", b""))


def rows(height, size, step=37):
    return b"".join(b"\0" + bytes((y * size + i) * step & 255 for i in range(size)) for y in range(height))


PALETTE = png_chunk(b"PLTE", bytes(range(0, 120, 10)))
GREY8 = png(3, 2, 8, 0, rows(2, 3))
RGB8 = png(3, 2, 8, 2, rows(2, 9))
SEEDS = {
    "grey1.png": png(9, 2, 1, 0, rows(2, 2)),
    "grey8.png": GREY8,
    "grey16_key.png": png(2, 2, 16, 0, rows(2, 4), png_chunk(b"tRNS", b"\0\x25")),
    "grey_alpha8.png": png(2, 2, 8, 4, rows(2, 4)),
    "palette2.png": png(5, 2, 2, 3, b"\0\x1b\xc0\0\xe4\x40", PALETTE + png_chunk(b"tRNS", b"\0\x80")),
    "rgb8.png": RGB8,
    "rgba16.png": png(2, 2, 16, 6, rows(2, 16)),
    "rgb8_interlaced.png": png(2, 2, 8, 2, b"\0\1\2\3" + b"\0\4\5\6" + b"\0\7\x08\x09\x0a\x0b\x0c", b"", 1),
    "bad_crc.png": RGB8[:-16] + b"\0\0\0\0" + RGB8[-12:],
    "bad_cut.png": RGB8[:50],
    "bad_huge.png": png(16384, 16384, 16, 6, b"\0" * 64),
    "bad_size.png": png(0x7fffffff, 0x7fffffff, 8, 2, b"\0" * 64),
    "bad_rows.png": png(100, 100, 8, 2, b"\0" * 64),
    "bad_palette.png": png(2, 1, 8, 3, b"\0\x01\xff", PALETTE),
    "rgb_little.pfm": b"PF\n2 2\n-1.0\n" + struct.pack("<12f", *range(12)),
    "grey_big.pfm": b"Pf 3 1 1e0\n" + struct.pack(">3f", 1, float("inf"), float("nan")),
    "bad_short.pfm": b"PF\n2 2\n-1.0\n" + b"\0" * 47,
    "bad_header.pfm": b"PF\n2 -2\n-1.0\n" + b"\0" * 48,
    "bad_huge.pfm": b"PF\n99999999999999999999 99999999999999999999\n-1.0\n",
    "bad_scale.pfm": b"Pf\n1 1\n0.0e\n" + b"\0" * 4,
    "rgb_half.exr": EXRS["rgb_half.exr"],
    "rgba_float.exr": EXRS["rgba_float.exr"],
    "y_float.exr": EXRS["y_float.exr"],
    "rgb_tiled.exr": EXRS["rgb_tiled.exr"],
    "extra_channels.exr": EXRS["extra_channels.exr"],
    "bad_block.exr": EXRS["bad_block.exr"],
    "bad_cut.exr": EXRS["rgba_float.exr"][:-20],
    "bad_header_cut.exr": EXRS["rgba_float.exr"][:100],
    "nothing": b"",
    "unknown.txt": b"not a picture\n",
}

for folder, files in ((HERE, EXRS), (CORPUS, SEEDS)):
    os.makedirs(folder, exist_ok=True)
    for name, data in files.items():
        with open(os.path.join(folder, name), "wb") as file:
            file.write(data)
