#!/usr/bin/python3
"""How many calls a domain in Python gets, and how many questions come with one: balls, and a ball with waves of sines.

  python_domain.py [--size MM] [--rows]

Prints, for each, the mesh's first digits of SHA-256, too: they stay as they are however the questions are asked.
--rows: the waves look at their points by rows in memory, not by columns; then some batches are answered otherwise.
"""
import argparse
import collections
import hashlib
import os
import pathlib
import sys
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, os.environ.get("SCANTET_PYTHON", str(ROOT / "build/release/python")))
import numpy as np  # noqa: E402

import scantet  # noqa: E402


class Counted(scantet.Domain):
    """Counts what the mesher asks; each call takes the GIL once."""

    def __init__(self):
        self.calls, self.questions, self.evaluated = collections.Counter(), collections.Counter(), 0
        self._within = threading.local()

    def _regions(self, points):
        self.evaluated += len(points)
        if not getattr(self._within, "crossings", False):
            self._count("points", points)
        return super()._regions(points)

    def _crossings(self, starts, ends):
        self._count("segments", starts)
        self._within.crossings = True
        try:
            return super()._crossings(starts, ends)
        finally:
            self._within.crossings = False

    def _count(self, kind, questions):
        self.calls[kind] += 1
        self.questions[kind] += len(questions)


class Ball(Counted):
    bounds = ((-5, -5, -5), (5, 5, 5))

    def inside(self, points):
        return (points**2).sum(axis=1) < 16


class BallWithCrossings(Ball):
    def crossings(self, starts, ends):
        way = ends - starts
        a, b, c = (way**2).sum(axis=1), (starts * way).sum(axis=1), (starts**2).sum(axis=1) - 16
        root = np.sqrt(np.maximum(b * b - a * c, 0))
        hit = np.flatnonzero((b * b > a * c) & (a > 0))
        at = np.concatenate([(-b - root)[hit] / a[hit], (-b + root)[hit] / a[hit]])
        return np.concatenate([hit, hit]), at


class Waves(Counted):
    """A ball with waves of sines; counts the batches that are answered otherwise than copies of their columns."""

    bounds = ((-5, -5, -5), (5, 5, 5))
    rows = False
    batches, otherwise = 0, 0

    @staticmethod
    def waves(x, y, z):
        return np.sin(x) * np.cos(y) + np.sin(z) * np.sin(y)

    def inside(self, points):
        x, y, z = (np.ascontiguousarray(points) if self.rows else points).T * 1.7
        waves = self.waves(x, y, z)
        self.batches += 1
        self.otherwise += not np.array_equal(waves, self.waves(x.copy(), y.copy(), z.copy()))
        return (points**2).sum(axis=1) < 10 + 2 * waves


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=float, default=0.8)
    parser.add_argument("--rows", action="store_true")
    arguments = parser.parse_args()
    Waves.rows = arguments.rows
    print(f"size {arguments.size} mm, load {os.getloadavg()[0]:.1f}")
    for kind in (Ball, BallWithCrossings, Waves):
        domain = kind()
        begin = time.process_time()
        mesh = scantet.mesh(domain, size=arguments.size)
        seconds = time.process_time() - begin
        told = ", ".join(f"{domain.questions[what]} {what} in {domain.calls[what]} calls" for what in ("points", "segments"))
        sums = hashlib.sha256(mesh.vertices.tobytes() + mesh.tets.tobytes()).hexdigest()[:12]
        print(f"{kind.__name__}: {len(mesh.tets)} tets, {seconds:.1f} s of processors, {told}; {domain.evaluated} points evaluated; {sums}", flush=True)
    print(f"Waves: {domain.otherwise} of {domain.batches} batches answered otherwise than copies of their columns")


if __name__ == "__main__":
    main()
