#!/usr/bin/python3
"""How many calls a domain in Python gets, and how many questions come with one: a ball and a gyroid.

  python_domain.py [--size MM]

Prints, for each, the mesh's first digits of SHA-256, too: they stay as they are however the questions are asked.
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


class Gyroid(Counted):
    """A sheet of it within a ball."""

    bounds = ((-5, -5, -5), (5, 5, 5))

    def inside(self, points):
        x, y, z = points.T * 1.2
        gyroid = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)
        return (np.abs(gyroid) < 0.6) & ((points**2).sum(axis=1) < 20)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=float, default=0.8)
    arguments = parser.parse_args()
    print(f"size {arguments.size} mm, load {os.getloadavg()[0]:.1f}")
    for kind in (Ball, BallWithCrossings, Gyroid):
        domain = kind()
        begin = time.monotonic()
        mesh = scantet.mesh(domain, size=arguments.size)
        seconds = time.monotonic() - begin
        told = ", ".join(f"{domain.questions[what]} {what} in {domain.calls[what]} calls" for what in ("points", "segments"))
        sums = hashlib.sha256(mesh.vertices.tobytes() + mesh.tets.tobytes()).hexdigest()[:12]
        print(f"{kind.__name__}: {len(mesh.tets)} tets, {seconds:.1f} s, {told}; {domain.evaluated} points evaluated; {sums}", flush=True)


if __name__ == "__main__":
    main()
