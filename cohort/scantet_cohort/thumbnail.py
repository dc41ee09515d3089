"""Pictures of surfaces without a display: triangles projected, sampled and sorted by depth, in NumPy alone."""
import pathlib
import struct
import zlib
from typing import Tuple

import numpy as np

SIDE = 120  # pixels
FINER = 2  # each pixel is the mean of so many squared
BLOCK = 1 << 20  # samples held at once
FRONT = np.array([0.25, 0.88, 0.40])  # seen from the front, a little from the left and above; LPS


def read_stl(path: pathlib.Path) -> np.ndarray:
    """The triangles of a binary STL file: (n, 3, 3), mm."""
    data = path.read_bytes()
    (count,) = struct.unpack_from("<I", data, 80)
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    return np.frombuffer(data, record, count, 84)["corners"].astype(np.float64)


def _view_axes() -> np.ndarray:
    """Rows: right, up and towards the viewer, of the world."""
    towards = FRONT * [1, -1, 1] / np.linalg.norm(FRONT)
    right = np.cross([0, 0, 1], towards)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(towards, right), towards])


def _in_view(triangles: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """Of the triangles of a closed surface that face the viewer, as the others are hidden: corners in pixels with depth, and how
    bright each is (0 to 1)."""
    seen = triangles @ _view_axes().T
    normals = np.cross(seen[:, 1] - seen[:, 0], seen[:, 2] - seen[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    light = np.array([-0.4, 0.5, 0.77])
    bright = 0.25 + 0.75 * np.abs(normals @ light) / np.where(lengths > 0, lengths, 1)
    low, high = seen.min(axis=(0, 1)), seen.max(axis=(0, 1))
    scale = 0.94 * SIDE * FINER / max(high[0] - low[0], high[1] - low[1], 1e-9)
    facing = normals[:, 2] > 0
    return (seen[facing] - (low + high) / 2) * scale + SIDE * FINER / 2, bright[facing]


def _weights(parts: int) -> np.ndarray:
    """Barycentric weights of points spread over a triangle, `parts` along each edge."""
    i, j = np.meshgrid(np.arange(parts), np.arange(parts), indexing="ij")
    keep = i + j < parts
    a, b = (i[keep] + 1 / 3) / parts, (j[keep] + 1 / 3) / parts
    return np.stack([a, b, 1 - a - b], axis=1)


def _draw(corners: np.ndarray, bright: np.ndarray) -> np.ndarray:
    """The brightness of the nearest triangle at each fine pixel; 0 where there is none."""
    side = SIDE * FINER
    depths, image = np.full(side * side, -np.inf), np.zeros(side * side)
    edges = np.linalg.norm(corners[:, :, :2] - np.roll(corners[:, :, :2], 1, axis=1), axis=2).max(axis=1)
    parts = 2 ** np.clip(np.ceil(np.log2(np.maximum(edges / 0.8, 1))), 0, 9).astype(int)
    for count in np.unique(parts):
        weights, members = _weights(int(count)), np.flatnonzero(parts == count)
        for chunk in np.array_split(members, -(-len(members) * len(weights) // BLOCK)):
            points = np.einsum("sk,nkd->nsd", weights, corners[chunk]).reshape(-1, 3)
            pixel = np.clip(points[:, :2].astype(int), 0, side - 1)
            place = (side - 1 - pixel[:, 1]) * side + pixel[:, 0]
            order = np.argsort(points[:, 2], kind="stable")  # of several writes to a place the last one stays
            place, depth = place[order], points[order, 2]
            value = np.repeat(bright[chunk], len(weights))[order]
            nearer = depth > depths[place]
            depths[place[nearer]], image[place[nearer]] = depth[nearer], value[nearer]
    return image.reshape(side, side)


def _png(pixels: np.ndarray) -> bytes:
    """A grey picture with transparency, (side, side, 2) bytes."""
    def chunk(kind: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    height, width = pixels.shape[:2]
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    header = struct.pack(">IIBBBBB", width, height, 8, 4, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def picture(triangles: np.ndarray) -> bytes:
    """A PNG file of the surface; the same triangles give the same bytes."""
    if len(triangles) == 0:
        return _png(np.zeros((SIDE, SIDE, 2), np.uint8))
    fine = _draw(*_in_view(triangles)).reshape(SIDE, FINER, SIDE, FINER)
    covered = (fine > 0).mean(axis=(1, 3))
    grey = fine.sum(axis=(1, 3)) / np.maximum((fine > 0).sum(axis=(1, 3)), 1)
    return _png((np.stack([40 + 200 * grey, 255 * covered], axis=2)).astype(np.uint8))
