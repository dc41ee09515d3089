"""A typed program that calls the package: checked by mypy, not run."""
import numpy as np
from numpy.typing import NDArray

import scantet


class Ball(scantet.Domain):
    bounds = ((-5, -5, -5), (5, 5, 5))

    def inside(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        return np.asarray((points**2).sum(axis=1) < 16)


def volume(path: str) -> float:
    mesh = scantet.mesh(path, level=[100, 300], size=2, min_dihedral=12, output="bone.vtu", progress=True)
    corners: NDArray[np.float64] = mesh.vertices[mesh.tets]
    names: dict[int, str] = mesh.region_names
    print(names)
    return float(np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() / 6)


def refused(mesh: scantet.Mesh) -> None:
    mesh.tets = mesh.tets  # type: ignore[misc]
    scantet.mesh("ct.nrrd", levle=3)  # type: ignore[call-arg]


try:
    scantet.mesh(Ball(), size=2)
except scantet.Error as error:
    print(error.code, error.remedy)
