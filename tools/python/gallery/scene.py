"""scene.py: the surfaces of the gallery, and pictures of them by NumPy and zlib alone."""
import os
import struct
import sys
import zlib

import numpy as np
from scipy.spatial import ConvexHull

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "examples", "jobs"))
from mesh import laplacian, surface  # noqa: E402,F401  (for the programs)

PALETTE = np.array([[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]])
ARMS = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0.3], [0, 0.2, 1]])


def creature(n=2000):
    """(points, triangles): a closed surface with five arms."""
    k = np.arange(n)
    z, angle = 1 - (2 * k + 1.0) / n, np.pi * (1 + 5 ** 0.5) * k
    ball = np.stack([np.sqrt(1 - z * z) * np.cos(angle), np.sqrt(1 - z * z) * np.sin(angle), z], 1)
    triangles = ConvexHull(ball).simplices
    a, b, c = (ball[triangles[:, k]] for k in range(3))
    inward = (np.cross(b - a, c - a) * a).sum(1) < 0
    triangles[inward] = triangles[inward][:, ::-1]
    tips = ARMS / np.linalg.norm(ARMS, axis=1)[:, None]
    radius = 1 + 0.8 * np.exp(9 * (ball @ tips.T - 1)).sum(1)
    return ball * radius[:, None], triangles


def ring(around=90, rings=20):
    """(points, triangles): a bumpy surface with a hole, boundary curves of `around` vertices."""
    row, column = np.divmod(np.arange(around * rings), around)
    radius, angle = 0.35 + 0.65 * row / (rings - 1.0), 2 * np.pi * column / around
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    points = np.stack([x, y, 0.25 * np.sin(4 * x) * np.cos(5 * y)], axis=1)
    a = np.arange(around * (rings - 1))
    b = a - a % around + (a + 1) % around
    return points, np.concatenate([np.stack([a, a + around, b], 1),
                                   np.stack([b, a + around, b + around], 1)])


def write_png(path, image):
    """Writes height x width x 3 bytes."""
    def chunk(kind, data):
        size, sum_of = struct.pack(">I", len(data)), struct.pack(">I", zlib.crc32(kind + data))
        return size + kind + data + sum_of
    height, width = image.shape[:2]
    # Filter 2, the difference to the row above: smooth shades become short.
    above = np.concatenate([np.zeros((1,) + image.shape[1:], np.uint8), image[:-1]])
    rows = np.concatenate([np.full((height, 1), 2, np.uint8),
                           (image - above).reshape(height, -1)], axis=1)
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                   + chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)) + chunk(b"IEND", b""))


def draw(panels, name, size=240):
    """Draws (points, triangles, values at vertices) side by side, to the folder of argument 1."""
    image = np.concatenate([panel(*p, size) for p in panels], axis=1)
    write_png(os.path.join(sys.argv[1] if len(sys.argv) > 1 else ".", name), image)


def panel(points, triangles, values, size):
    """One view from the front and above, with a depth buffer."""
    if points.shape[1] == 2:
        seen = np.c_[points, np.zeros(len(points))]
    else:
        c, s = np.cos(0.5), np.sin(0.5)
        turn = np.array([[c, s, 0], [-s * s, c * s, c], [s * c, -c * c, s]])
        seen = points @ turn.T
    low, high = seen.min(0), seen.max(0)
    flat = (seen[:, :2] - (low + high)[:2] / 2) * 0.92 * size / (high - low)[:2].max() + size / 2
    t = 4 * (values - values.min()) / max(np.ptp(values), 1e-300)
    colors = np.stack([np.interp(t, np.arange(5), PALETTE[:, k]) for k in range(3)], axis=1)
    image, depth = np.full((size, size, 3), 255, np.uint8), np.full((size, size), -np.inf)
    for corner in triangles:
        (ax, ay), (bx, by), (cx, cy) = flat[corner]
        twice = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        if abs(twice) < 1e-9:
            continue
        x0, y0 = np.floor(flat[corner].min(0)).astype(int)
        x1, y1 = np.ceil(flat[corner].max(0)).astype(int) + 1
        y, x = np.mgrid[y0:y1, x0:x1]
        u = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / twice
        v = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / twice
        part = np.stack([1 - u - v, u, v], axis=-1)
        height = part @ seen[corner, 2]
        on = (part.min(-1) >= -1e-9) & (height > depth[y, x])
        normal = np.cross(seen[corner[1]] - seen[corner[0]], seen[corner[2]] - seen[corner[0]])
        light = 0.45 + 0.55 * abs(normal[2]) / np.linalg.norm(normal)
        depth[y[on], x[on]] = height[on]
        image[y[on], x[on]] = light * (part @ colors[corner])[on]
    return image[::-1]
