from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Path = str | bytes | PathLike[str]
_Text = str | float | PathLike[str] | Sequence[str | float] | None
_Texts = _Path | Sequence[_Path | str]
_Images = Any | Sequence[Any]
_Progress = Callable[[dict[str, Any]], object] | bool | None

__version__: str

class Error(Exception):
    code: str
    remedy: str

class UsageError(Error, ValueError): ...
class UnknownOptionError(UsageError, TypeError): ...
class InputError(Error, ValueError): ...
class OutputError(Error, OSError): ...
class BudgetError(Error): ...
class InternalError(Error, RuntimeError): ...
class UnmetWarning(UserWarning): ...

class Scan:
    @property
    def values(self) -> NDArray[Any]: ...
    @property
    def affine(self) -> NDArray[np.float64]: ...
    @property
    def shape(self) -> tuple[int, int, int]: ...
    @property
    def pixel_type(self) -> str: ...
    @property
    def format(self) -> str: ...
    @property
    def min(self) -> float: ...
    @property
    def max(self) -> float: ...

class Domain:
    bounds: ArrayLike
    detail: float | None
    default_size: float | None
    region_names: dict[int, str]
    crossings: Callable[[NDArray[np.float64], NDArray[np.float64]], tuple[ArrayLike, ArrayLike]] | None
    def inside(self, points: NDArray[np.float64]) -> ArrayLike: ...

class Page:
    text: str
    height: int
    def _repr_html_(self) -> str: ...

class Mesh:
    @property
    def space(self) -> str: ...
    @property
    def vertices(self) -> NDArray[np.float64]: ...
    def points(self, space: str = "lps") -> NDArray[np.float64]: ...
    tets: NDArray[np.uint32]
    tet_regions: NDArray[np.int32]
    boundary_facets: NDArray[np.uint32]
    facet_regions: NDArray[np.int32]
    facet_patches: NDArray[np.uint32]
    vertex_dimension: NDArray[np.uint8]
    vertex_stratum: NDArray[np.int32]
    curve_edges: NDArray[np.uint32]
    edge_curves: NDArray[np.uint32]
    corners: NDArray[np.uint32]
    tet_edge_vertices: NDArray[np.uint32]
    tet_materials: NDArray[np.uint32]
    region_names: dict[int, str]
    patches: list[tuple[str, int, int]]
    curves: list[tuple[str, tuple[int, ...]]]
    sets: dict[str, dict[str, NDArray[np.uint32]]]
    fields: dict[str, NDArray[np.float64]]
    materials: list[dict[str, Any]]
    @property
    def report(self) -> dict[str, Any]: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def findings(self) -> list[str]: ...
    @property
    def written(self) -> list[str]: ...
    def save(self, path: _Path, *, space: str | None = None, gmsh_version: str = "4.1") -> None: ...
    def to_meshio(self) -> Any: ...
    def to_vtk(self) -> Any: ...
    def to_pyvista(self) -> Any: ...
    def histograms(self) -> str: ...
    def page(self, height: int = 700) -> Page: ...
    def _repr_html_(self) -> str: ...

class Verification:
    grade: str
    is_as_required: bool
    text: str
    def __bool__(self) -> bool: ...

def mesh(
    image: Any,
    *,
    affine: ArrayLike | None = None,
    axes: str | None = None,
    progress: _Progress = None,
    # Options of `scantet mesh` (scripts/python_stub.py):
    alpha: float | str | None = ...,
    as_grey: bool = ...,
    border: str = ...,
    boundary_size: float | str | None = ...,
    bounds: _Text = ...,
    cell_radius_edge: float | str | None = ...,
    certificate: _Text = ...,
    certify: str = ...,
    components: float | str | None = ...,
    config: _Text = ...,
    crop: _Text = ...,
    crop_voxels: _Text = ...,
    cut: _Texts = ...,
    facet_distance: float | str | None = ...,
    facet_radius_edge: float | str | None = ...,
    feature_share: float | str | None = ...,
    fill_cavities: float | str | None = ...,
    inside: str = ...,
    label_names: _Text = ...,
    label_smoothing: float | str | None = ...,
    labels: _Text = ...,
    layers: _Text = ...,
    least_size: float | str | None = ...,
    level: float | Sequence[float] | None = ...,
    lipschitz: float | str | None = ...,
    max_dihedral: float | str | None = ...,
    max_distance: float | str | None = ...,
    max_memory: float | str | None = ...,
    max_time: float | str | None = ...,
    max_vertices: int = ...,
    median: int = ...,
    min_component: float | str | None = ...,
    min_dihedral: float | str | None = ...,
    min_edge: float | str | None = ...,
    min_scaled_jacobian: float | str | None = ...,
    no_theory: bool = ...,
    optimize: str = ...,
    output: _Texts = ...,
    outside: float | str | None = ...,
    plan: bool = ...,
    plugin: _Texts = ...,
    quiet: bool = ...,
    region_size: _Texts = ...,
    repair: bool = ...,
    report: _Texts = ...,
    resample: float | str | None = ...,
    seed: int = ...,
    seeding: str = ...,
    sharp_edges: float | str | None = ...,
    size: float | str | None = ...,
    smooth: float | str | None = ...,
    smoothing: str = ...,
    space: str = ...,
    target_tets: float | str | None = ...,
    threads: int = ...,
    tissue: _Images = ...,
    wave_speed: float | str | None = ...,
    # End of the options.
) -> Mesh: ...
def info(
    image: Any, *, affine: ArrayLike | None = None, axes: str | None = None, progress: _Progress = None, **options: Any
) -> dict[str, dict[str, Any]]: ...
def options(plugin: _Texts = ()) -> dict[str, dict[str, Any]]: ...
def read(path: _Path, *, progress: _Progress = None) -> Scan: ...
def read_mesh(path: _Path, *, progress: _Progress = None) -> Mesh: ...
def scan(image: Any, affine: ArrayLike | None = None, axes: str | None = None) -> Scan: ...
def verify(
    mesh_file: _Path | None = None,
    against: _Path | None = None,
    level: float | Sequence[float] | None = None,
    *,
    progress: _Progress = None,
    **options: Any,
) -> Verification: ...
