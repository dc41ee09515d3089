"""What a mesh file holds, whatever program read it."""
import numpy as np

EDGES = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]


class Model:
    """Points; tets with corners and, of second order, nodes on edges in VTK's order; the region of each tet, by name; facets
    by the name of their surface; sets and fields; curves as edges or as nodes, and where they end. What a format does not
    hold is None."""

    def __init__(self, points, tets, regions, surfaces=None, nodes=None, elements=None, facets=None, fields=None, curves=None,
                 curve_nodes=None, corners=None):
        self.points, self.tets = np.asarray(points, float), np.asarray(tets, int)
        self.regions = np.asarray(regions)
        self.surfaces = surfaces  # {name: array of corners}
        self.nodes, self.elements = nodes, elements  # {name: indices}
        self.facets = facets  # {name: array of corners}
        self.fields = fields  # {name: values}
        self.curves = curves  # {name: array of edges: ends, and of second order the node between}
        self.curve_nodes = curve_nodes  # {name: indices}
        self.corners = corners  # indices


def volumes(points, tets):
    a, b, c, d = (points[tets[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) / 6


def is_curve(name):
    return name.startswith("curve_")


def is_own_set(name):
    """Whether nodes are a set of the user's."""
    return name not in ("nall", "boundary", "corners") and not name.startswith("nodes_") and not is_curve(name)


def curves_in(nodes):
    """Curves and corners among sets of nodes."""
    return {"curve_nodes": {name: members for name, members in nodes.items() if is_curve(name)},
            "corners": nodes.get("corners", [])}


def by_name(rows, names):
    """{name: the rows that have it}"""
    rows, names = np.asarray(rows), np.asarray(names)
    return {name: rows[names == name] for name in np.unique(names)}


def flags(data, of=lambda values: values):
    return {name[4:]: np.flatnonzero(of(values)) for name, values in data.items() if name.startswith("set_")}
