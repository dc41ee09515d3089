"""Objects of one's own, which answer many questions at a time."""
import numpy as np

from ._errors import UsageError

PIECES = 32  # a bracket is cut into so many at once
ROUNDS = 9  # 32**9 is 2**45


class Domain:
    """An object of one's own, to be meshed: derive from it, set bounds, and answer inside().

    bounds: ((x, y, z), (x, y, z)), mm, LPS: a box around the object; nothing of it may lie on the box.
    inside(points): points of shape (n, 3), mm; the answer of shape (n,) is the region of each, 0 outside (bool will do).
        The same point must always get the same answer, however many are asked with it. So columns of points are
        contiguous: sines and other functions of NumPy's give strided arrays other last bits at some addresses.
    crossings(starts, ends): need not be there. Both of shape (n, 3), mm; the answer is two arrays of one length, of
        segments (0 … n-1) and of places along them (0 at the start, 1 at the end) where the boundary is. Without it,
        segments are looked at every `detail` mm, and the boundary is found by bisection: many more questions.
    detail: mm; no part of the object, and no gap, is thinner. None: 1/50 of the box's shortest side.
    default_size: mm; of tetrahedra where no size is given. None: 1/20 of that side.
    region_names: {region: name}.

    Python answers on one thread, and where the mesher mends and improves it asks one question at a time: much slower
    than a scan. A function that is quick on a grid is better meshed as an array of its values, with level=0.
    """

    bounds = None
    detail = None
    default_size = None
    region_names = {}

    def inside(self, points):
        raise NotImplementedError("a Domain answers inside(points)")

    crossings = None

    # What the module asks.

    @property
    def _bounds(self):
        box = np.asarray(self.bounds, dtype=float)
        if box.size != 6:
            raise UsageError("a domain's bounds are two corners: ((x, y, z), (x, y, z)), mm", "usage.bounds",
                             "give ((x, y, z), (x, y, z)), the least corner first")
        return [float(c) for c in box.reshape(6)]

    def _shortest_side(self):
        box = np.asarray(self._bounds).reshape(2, 3)
        return float((box[1] - box[0]).min())

    @property
    def _default_size(self):
        size = float(self.default_size or self._shortest_side() / 20)
        if not 0 < size < float("inf"):
            raise UsageError(f"a domain's default_size is {size}", "usage.size", "give a length in mm above 0")
        return size

    @property
    def _region_names(self):
        return {int(region): str(name) for region, name in dict(self.region_names).items()}

    def _regions(self, points):
        regions = np.asarray(self.inside(np.asfortranarray(points)))
        if regions.shape != (len(points),):
            raise ValueError(f"inside() gave an array of shape {regions.shape} for {len(points)} points")
        return regions.astype(np.int32)

    def _crossings(self, starts, ends):
        """(segment, place, from, to) of every crossing, along each segment."""
        if self.crossings is None:
            segments, low, high, before, after = self._brackets(starts, ends)
            at = self._bisect(starts, ends, segments, low, high, before)
        else:
            segments, at, before, after = self._between_own(starts, ends)
        places = starts[segments] + at[:, None] * (ends[segments] - starts[segments])
        return segments, places, before, after

    def _brackets(self, starts, ends):
        """Parts of the segments with different regions at their ends, found `detail` apart."""
        detail = float(self.detail or self._shortest_side() / 50)
        length = np.linalg.norm(ends - starts, axis=1)
        pieces = np.maximum(1, np.ceil(length / detail)).astype(np.int64)
        first = np.concatenate([[0], np.cumsum(pieces + 1)])
        segment = np.repeat(np.arange(len(starts)), pieces + 1)
        step = np.arange(first[-1]) - first[segment]
        t = step / pieces[segment]
        t[first[1:] - 1] = 1.0
        points = starts[segment] + t[:, None] * (ends[segment] - starts[segment])
        points[first[1:] - 1] = ends  # the same point as is asked for by itself
        regions = self._regions(points)
        changes = np.flatnonzero((regions[:-1] != regions[1:]) & (segment[:-1] == segment[1:]))
        return segment[changes], t[changes], t[changes + 1], regions[changes], regions[changes + 1]

    def _bisect(self, starts, ends, segments, low, high, before):
        """Where the region `before` ends first, in each bracket, to a part in 2**45 of it."""
        if len(segments) == 0:
            return low
        start, way = starts[segments], ends[segments] - starts[segments]
        share = np.arange(1, PIECES) / PIECES
        for _ in range(ROUNDS):
            t = low[:, None] + (high - low)[:, None] * share
            points = start[:, None, :] + t[:, :, None] * way[:, None, :]
            same = self._regions(points.reshape(-1, 3)).reshape(t.shape) == before[:, None]
            kept = np.where(same.all(axis=1), PIECES - 1, np.argmin(same, axis=1))
            edges = np.column_stack([low, t, high])
            rows = np.arange(len(low))
            low, high = edges[rows, kept], edges[rows, kept + 1]
        return 0.5 * (low + high)

    def _between_own(self, starts, ends):
        """Crossings that the domain gives, with the regions between them; those that change nothing are left out."""
        found, at = self.crossings(np.asfortranarray(starts), np.asfortranarray(ends))
        found, at = np.asarray(found, dtype=np.int64), np.asarray(at, dtype=float)
        if found.shape != at.shape or found.ndim != 1:
            raise ValueError("crossings() gives two arrays of one length: of segments, and of places along them")
        within = (at > 0) & (at < 1)
        found, at = found[within], at[within]
        order = np.lexsort((at, found))
        found, at = found[order], at[order]
        # Every segment from its start over its crossings to its end; each stretch has the region of its middle.
        segment = np.concatenate([np.arange(len(starts)), found, np.arange(len(starts))])
        t = np.concatenate([np.zeros(len(starts)), at, np.ones(len(starts))])
        order = np.lexsort((t, segment))
        segment, t = segment[order], t[order]
        opens = np.flatnonzero(segment[:-1] == segment[1:])
        middle = 0.5 * (t[opens] + t[opens + 1])
        middle[t[opens] == 0] = 0.0
        of = segment[opens]
        last = t[opens + 1] == 1
        points = starts[of] + middle[:, None] * (ends[of] - starts[of])
        regions = self._regions(np.concatenate([points, ends]))
        at_end = regions[len(points):]
        regions = regions[:len(points)]
        alone = last & (t[opens] == 0)
        regions = np.where(last & ~alone, at_end[of], regions)
        changes = np.flatnonzero((of[:-1] == of[1:]) & (regions[:-1] != regions[1:]))
        segments, places = of[changes], t[opens[changes] + 1]
        before, after = regions[changes], regions[changes + 1]
        missed = of[alone & (regions != at_end[of])]  # the ends differ, and no crossing was given
        if len(missed):
            low, high = np.zeros(len(missed)), np.ones(len(missed))
            start_regions = self._regions(starts[missed])
            segments = np.concatenate([segments, missed])
            places = np.concatenate([places, self._bisect(starts, ends, missed, low, high, start_regions)])
            before = np.concatenate([before, start_regions])
            after = np.concatenate([after, at_end[missed]])
            order = np.lexsort((places, segments))
            segments, places, before, after = segments[order], places[order], before[order], after[order]
        return segments, places, before, after
