"""Binary PLY files as the program writes them."""

import struct


def ply(path):
    """Counts from the header, then the vertices of a binary PLY in double precision."""
    data = path.read_bytes()
    header, body = data.split(b"end_header\n", 1)
    counts = {line.split()[1]: int(line.split()[2])
              for line in header.decode().splitlines() if line.startswith("element")}
    positions = [struct.unpack_from("<3d", body, 24 * v) for v in range(counts["vertex"])]
    return counts, positions


def extent(positions):
    return max(max(axis) - min(axis) for axis in zip(*positions))
