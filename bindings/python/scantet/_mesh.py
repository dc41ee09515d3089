"""The result: a mesh, and what is known of it."""
import html
import json
import os
import tempfile

import numpy as np

# The arrays of the mesh, shared with the library; __init__.pyi says what each is.
ARRAYS = ("tets", "tet_regions", "boundary_facets", "facet_regions", "facet_patches", "vertex_dimension",
          "vertex_stratum", "curve_edges", "edge_curves", "corners", "tet_edge_vertices", "tet_materials",
          "region_names", "patches", "curves", "sets", "fields", "materials")


class Page:
    """HTML that notebooks show."""

    def __init__(self, text, height):
        self.text = text
        self.height = height

    def _repr_html_(self):
        return (f'<iframe srcdoc="{html.escape(self.text)}" style="width:100%;height:{self.height}px;border:0">'
                "</iframe>")


class Mesh:
    """A tetrahedral mesh, and what is known of it.

    Arrays are read-only, and share the memory of the mesh, which lives as long as one of them. n vertices, m tets, f
    boundary facets; numbers of vertices are uint32, regions int32.
    vertices (n, 3) float64, mm, in the axes of `space`; in "lps" shared, in "ras" a copy. tets (m, 4), positively
    oriented. tet_regions (m,). boundary_facets (f, 3), normals out of the first of facet_regions (f, 2) into the
    second, 0 outside. facet_patches (f,): of patches, a list of (name, region, region). vertex_dimension (n,) uint8: 3
    inside, 2 on the boundary, 1 on a curve, 0 a corner; vertex_stratum (n,): which region, patch, curve, corner.
    curve_edges (e, 2), edge_curves (e,): of curves, a list of (name, regions). corners: vertices. tet_edge_vertices:
    (m, 6) of elements of second order, else (0, 6). tet_materials: (m,) of materials, or (0,). region_names: {region:
    name}. sets: {name: {"vertices", "facets", "tets": array}}. fields: {name: (m,) float64}.
    """

    def __init__(self, result, ras):
        self._result = result
        self._arrays = result.arrays()
        self._ras = ras
        self._turned = None
        self._report = None

    @property
    def space(self):
        """World axes of `vertices`: "lps", or what the option space asked for."""
        return "ras" if self._ras else "lps"

    @property
    def vertices(self):
        """(n, 3), mm; see points()."""
        return self.points(self.space)

    def points(self, space="lps"):
        """(n, 3) float64, mm, in the axes "lps" (shared memory) or "ras" (a copy, made once)."""
        if space == "lps":
            return self._arrays["vertices"]
        if space != "ras":
            raise ValueError(f'space: "{space}" is not "lps" or "ras"')
        if self._turned is None:
            self._turned = self._arrays["vertices"] * np.array([-1.0, -1.0, 1.0])
            self._turned.flags.writeable = False
        return self._turned

    @property
    def report(self):
        """All that was measured, as `--report FILE.json` has it (docs/reports.md): a dict."""
        if self._report is None:
            self._report = json.loads(self._result.report_json)
        return self._report

    @property
    def notes(self):
        """Worth knowing: sizes chosen by default, expected trouble. Texts."""
        return self._result.notes

    @property
    def findings(self):
        """Bounds unmet and faults of the mesh. Texts; empty: all is as asked for."""
        return self._result.findings

    @property
    def written(self):
        """Files that the run has written (options output and report)."""
        return self._result.written

    def save(self, path, *, space=None, gmsh_version="4.1"):
        """Writes a mesh file, or a report (.json, .csv, .html, .svg, .png), by the extension; whole or not at all.

        space: axes of the coordinates written; None: those of `space`. gmsh_version: of .msh, "4.1" or "2.2". The bytes
        of a mesh file are those that the command writes. Raises UsageError (usage.format), OutputError.
        """
        space = space or self.space
        if space not in ("lps", "ras"):
            raise ValueError(f'space: "{space}" is not "lps" or "ras"')
        self._result.save(os.fsencode(path), space == "ras", gmsh_version)

    def to_meshio(self):
        """A meshio.Mesh: tetra and triangle cells, cell data "region" (of facets: the region behind). Copies."""
        import meshio
        cells = [("tetra", self.tets.astype(np.int64)), ("triangle", self.boundary_facets.astype(np.int64))]
        behind = np.ascontiguousarray(self.facet_regions[:, 0])
        return meshio.Mesh(self.vertices, cells, cell_data={"region": [self.tet_regions, behind]})

    def to_vtk(self):
        """A vtkUnstructuredGrid of the tets, with the cell array "region". Copies."""
        from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
        from vtkmodules.vtkCommonCore import vtkPoints
        from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkUnstructuredGrid
        points = vtkPoints()
        points.SetData(numpy_to_vtk(np.ascontiguousarray(self.vertices), deep=True))
        offsets = np.arange(0, 4 * len(self.tets) + 1, 4, dtype=np.int64)
        cells = vtkCellArray()
        cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                      numpy_to_vtkIdTypeArray(self.tets.reshape(-1).astype(np.int64), deep=True))
        grid = vtkUnstructuredGrid()
        grid.SetPoints(points)
        grid.SetCells(VTK_TETRA, cells)
        regions = numpy_to_vtk(self.tet_regions, deep=True)
        regions.SetName("region")
        grid.GetCellData().SetScalars(regions)
        return grid

    def to_pyvista(self):
        """A pyvista.UnstructuredGrid, as to_vtk()."""
        import pyvista
        return pyvista.wrap(self.to_vtk())

    def _written(self, name):
        with tempfile.TemporaryDirectory(prefix="scantet_") as folder:
            path = os.path.join(folder, name)
            self.save(path)
            with open(path, encoding="utf-8") as file:
                return file.read()

    def histograms(self):
        """The histograms of the report as the text of an SVG picture."""
        text = self._written("histograms.svg")
        return text[text.index("<svg"):]

    def page(self, height=700):
        """The page to explore the mesh in, for a notebook to show, `height` pixels high."""
        return Page(self._written("page.html"), height)

    def _repr_html_(self):
        rows = [("vertices", f"{len(self.vertices):,}"), ("tetrahedra", f"{len(self.tets):,}"),
                ("boundary triangles", f"{len(self.boundary_facets):,}")]
        quality = self.report.get("quality", {})
        if quality:
            rows += [("volume", f"{self.report['mesh']['volume_mm3']:.6g} mm³"),
                     ("dihedral angles", f"{quality['min_dihedral_deg']:.1f}° to {quality['max_dihedral_deg']:.1f}°")]
        if len(self.region_names) > 1:
            rows.append(("regions", ", ".join(self.region_names.values())))
        rows += [("unmet", finding) for finding in self.findings]
        table = "".join(f"<tr><th style='text-align:left'>{html.escape(name)}</th>"
                        f"<td style='text-align:left'>{html.escape(value)}</td></tr>" for name, value in rows)
        return f"<div><table>{table}</table><div style='max-width:900px'>{self.histograms()}</div></div>"

    def __str__(self):
        return self._result.report_text

    def __repr__(self):
        regions = len(self.region_names)
        return (f"<scantet.Mesh: {len(self.vertices)} vertices, {len(self.tets)} tets, "
                f"{regions} region{'s' if regions != 1 else ''}>")


def shared(name):
    return property(lambda self: self._arrays[name])


for array in ARRAYS:
    setattr(Mesh, array, shared(array))
