"""Progress, Ctrl-C, and domains in Python."""
import os
import signal
import threading
import time

import numpy as np
import pytest
import scantet


def test_progress(samples):
    told = []
    scantet.mesh(samples / "sphere.nrrd", level=127.5, size=0.8, progress=told.append)
    assert told and set(told[0]) == {"stage", "doing", "done", "total", "pending"}
    scantet.mesh(samples / "sphere.nrrd", level=127.5, size=2, progress=True)


def test_what_the_progress_raises_ends_the_run(samples, tmp_path):
    def stop(state):
        if state["stage"] in ("refine", "optimize"):
            raise RuntimeError("enough")
    with pytest.raises(RuntimeError, match="enough"):
        scantet.mesh(samples / "torus.nrrd", level=300.5, size=0.15, progress=stop, output=tmp_path / "a.vtu")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("after_s", [0.3, 2.0])
def test_interrupt(samples, tmp_path, after_s):
    sent = []

    def send():
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)
    timer = threading.Timer(after_s, send)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        scantet.mesh(samples / "torus.nrrd", level=300.5, size=0.15, output=tmp_path / "a.vtu")
    took = time.monotonic() - sent[0]
    assert took < 5, took  # about a second where nothing else runs
    assert list(tmp_path.iterdir()) == []


def test_other_threads_run_meanwhile(samples):
    counts = [0]
    ended = threading.Event()

    def count():
        while not ended.is_set():
            counts[0] += 1
            time.sleep(0.001)
    thread = threading.Thread(target=count)
    thread.start()
    scantet.mesh(samples / "sphere.nrrd", level=127.5, size=0.8)
    ended.set()
    thread.join()
    assert counts[0] > 20


class Ball(scantet.Domain):
    bounds = ((-5, -5, -5), (5, 5, 5))
    region_names = {1: "ball"}

    def inside(self, points):
        return (points**2).sum(axis=1) < 16


class Shells(scantet.Domain):
    """Two regions, and crossings by formula."""
    bounds = ((-5, -5, -5), (5, 5, 5))

    def inside(self, points):
        r2 = (points**2).sum(axis=1)
        return np.where(r2 < 4, 2, np.where(r2 < 16, 1, 0))

    def crossings(self, starts, ends):
        way = ends - starts
        a = (way**2).sum(axis=1)
        b = 2 * (starts * way).sum(axis=1)
        found = []
        for r2 in (4, 16):
            with np.errstate(all="ignore"):
                root = np.sqrt(b * b - 4 * a * ((starts**2).sum(axis=1) - r2))
                found += [(-b - root) / (2 * a), (-b + root) / (2 * a)]
        t = np.stack(found, axis=1)
        of = np.repeat(np.arange(len(starts)), 4).reshape(t.shape)
        there = np.isfinite(t)
        return of[there], t[there]


def test_domain():
    mesh = scantet.mesh(Ball(), size=2)
    assert mesh.region_names == {1: "ball"}
    boundary = np.unique(mesh.boundary_facets)
    assert np.allclose(np.linalg.norm(mesh.vertices[boundary], axis=1), 4, atol=1e-9)
    assert mesh.report["mesh"]["volume_mm3"] == pytest.approx(4 / 3 * np.pi * 64, rel=0.25)
    again = scantet.mesh(Ball(), size=2)
    assert np.array_equal(again.vertices, mesh.vertices)


class Waves(scantet.Domain):
    """A ball with waves of sines; counts the batches that are answered otherwise than copies of their columns."""
    bounds = ((-5, -5, -5), (5, 5, 5))

    def __init__(self):
        self.batches, self.otherwise = 0, 0

    @staticmethod
    def waves(x, y, z):
        return np.sin(x) * np.cos(y) + np.sin(z) * np.sin(y)

    def inside(self, points):
        x, y, z = points.T * 1.7
        waves = self.waves(x, y, z)
        self.batches += 1
        self.otherwise += not np.array_equal(waves, self.waves(x.copy(), y.copy(), z.copy()))
        return (points**2).sum(axis=1) < 10 + 2 * waves


def test_domain_of_sines_has_one_mesh():
    meshes = []
    for threads in (1, 2, 2, 1):
        domain = Waves()
        meshes.append(scantet.mesh(domain, size=0.9, threads=threads))
        assert domain.batches > 1000
        assert domain.otherwise == 0
    for mesh in meshes[1:]:
        assert np.array_equal(mesh.vertices, meshes[0].vertices)
        assert np.array_equal(mesh.tets, meshes[0].tets)


def test_domain_is_asked_in_columns():
    class Columns(Shells):
        def inside(self, points):
            assert points.flags.f_contiguous
            return super().inside(points)

        def crossings(self, starts, ends):
            assert starts.flags.f_contiguous and ends.flags.f_contiguous
            return super().crossings(starts, ends)

    assert len(scantet.mesh(Columns(), size=2).tets) > 0


def test_domain_with_crossings():
    mesh = scantet.mesh(Shells(), size=1.5)
    assert set(mesh.tet_regions) == {1, 2}
    boundary = np.unique(mesh.boundary_facets)
    r = np.linalg.norm(mesh.vertices[boundary], axis=1)
    assert np.allclose(np.minimum(abs(r - 2), abs(r - 4)), 0, atol=1e-9)


def test_what_a_domain_raises_comes_out():
    class Broken(Ball):
        def inside(self, points):
            raise ZeroDivisionError("in the domain")

    class Misshapen(Ball):
        def inside(self, points):
            return np.zeros(3)
    with pytest.raises(ZeroDivisionError, match="in the domain"):  # the cause of an input.python
        scantet.mesh(Broken(), size=2)
    with pytest.raises(ValueError, match="shape"):
        scantet.mesh(Misshapen(), size=2)
    with pytest.raises(scantet.UsageError):
        scantet.mesh(Ball(), size=2, level=3)
    boxless = Ball()
    boxless.bounds = (-5, 5)
    with pytest.raises(scantet.UsageError) as caught:
        scantet.mesh(boxless, size=2)
    assert caught.value.code == "usage.bounds"


def test_interrupt_within_a_domain():
    class Slow(Ball):
        def inside(self, points):
            time.sleep(0.001)
            return super().inside(points)
    timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        scantet.mesh(Slow(), size=0.5)
