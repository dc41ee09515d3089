"""Pictures of tetrahedral meshes without a screen: tets of one side of a cut, coloured, as PNG files."""
import struct
import zlib

import numpy as np

COLOURS = np.array([[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]], float)  # viridis


def colours_of(values, low, high):
    at = np.clip((values - low) / ((high - low) or 1), 0, 1) * (len(COLOURS) - 1)
    lower = np.minimum(at.astype(int), len(COLOURS) - 2)
    part = (at - lower)[:, None]
    return COLOURS[lower] * (1 - part) + COLOURS[lower + 1] * part


def outside(tets):
    """The triangles that only one tet has, with its number."""
    faces = np.concatenate([tets[:, c] for c in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))])
    owners = np.tile(np.arange(len(tets)), 4)
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    once = first[count == 1]
    return faces[once], owners[once]


def draw(points, tets, colours, axis, side):
    """A picture of side x side pixels, with the tets seen from the low end of the axis ("x" or "y"), z upwards."""
    fine = 2 * side
    across = {"x": (1, 2, 0), "y": (0, 2, 1)}[axis]
    faces, owners = outside(tets)
    flat = points[:, across]
    low, high = flat[np.unique(tets)].min(axis=0), flat[np.unique(tets)].max(axis=0)
    scale = 0.94 * fine / max(high[:2] - low[:2])
    seen = flat.copy()
    seen[:, :2] = (flat[:, :2] - (low + high)[:2] / 2) * scale + fine / 2
    corners = seen[faces]
    normals = np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    length = np.maximum(np.linalg.norm(normals, axis=1), 1e-30)
    light = 0.45 + 0.55 * np.abs(normals[:, "xyz".index(axis)] / length)
    shades = colours[owners] * light[:, None]
    picture = np.full((fine, fine, 3), 255.0)
    depth = np.full((fine, fine), np.inf)
    for triangle, shade in zip(corners, shades):
        a, b, c = triangle
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if abs(area) < 1e-9:
            continue
        x0, y0 = np.floor(triangle[:, :2].min(axis=0)).astype(int)
        x1, y1 = np.ceil(triangle[:, :2].max(axis=0)).astype(int) + 1
        y, x = np.mgrid[y0:y1, x0:x1]
        v = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area
        w = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area
        far = a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2])
        hit = (v >= 0) & (w >= 0) & (v + w <= 1) & (far < depth[y0:y1, x0:x1])
        depth[y0:y1, x0:x1][hit] = far[hit]
        picture[y0:y1, x0:x1][hit] = shade
    return picture[::-1].reshape(side, 2, side, 2, 3).mean(axis=(1, 3))


def side_by_side(model, panels, axis, side=420):
    """panels: (which tets, a value a tet, the values of the darkest and the brightest colour)."""
    return np.hstack([draw(model.points, model.tets[which], colours_of(values, low, high)[which], axis, side)
                      for which, values, low, high in panels])


def save_png(path, picture):
    height, width = picture.shape[:2]
    rows = np.zeros((height, 1 + 3 * width), np.uint8)
    rows[:, 1:] = np.round(picture).astype(np.uint8).reshape(height, -1)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)) + chunk(b"IEND", b""))
