import pathlib

import dolfinx
import h5py
import numpy as np
import ufl
from dolfinx import fem
from dolfinx.io import XDMFFile
from mpi4py import MPI
from petsc4py import PETSc

if MPI.COMM_WORLD.size > 1:
    raise SystemExit("this script is for one process; give it more threads with OMP_NUM_THREADS")
folder = pathlib.Path(__file__).resolve().parent
with XDMFFile(MPI.COMM_WORLD, str(folder / "{{mesh}}"), "r") as file:
    mesh = file.read_mesh(name="mesh")
arrays = h5py.File(folder / "{{arrays}}", "r")
order = mesh.ufl_domain().ufl_coordinate_element().degree()
for first, second in ((2, 3), (2, 0)):
    mesh.topology.create_connectivity(first, second)
exact = {"quadrature_degree": 2 * order}
dx = ufl.Measure("dx", domain=mesh, metadata=exact)

materials = [  # name, Young's modulus in MPa, Poisson's ratio, density in tonne/mm3, conductivity; None: not known
{{materials}}
]
held = [  # set, and what is held of it
{{hold}}
]
loaded = [  # set, numbers
{{load}}
]


def of_materials(column):
    """A constant of the materials, as a function with one value a cell."""
    f = fem.Function(fem.FunctionSpace(mesh, ("DG", 0)))
    numbers = arrays["mesh/fields/material"][:].astype(int) - 1
    values = np.array([row[column] for row in materials], dtype=float)
    f.x.array[f.function_space.dofmap.list.array] = values[numbers[mesh.topology.original_cell_index]]
    return f


def dofs_of(space, name):
    """The degrees of freedom at the nodes of a set, blocks of a vector counted once. space: of the elements' order."""
    is_member = (arrays[f"set/nodes/{name}"][:] == 1)[np.asarray(mesh.geometry.input_global_indices)]
    return np.unique(space.dofmap.list.array[is_member[mesh.geometry.dofmap.array]]).astype(np.int32)


def measure_of(name):
    """Integrals over the facets of a set."""
    def rows(corners):
        return np.sort(np.asarray(corners, dtype=np.int64), axis=1).view("i8,i8,i8").ravel()

    wanted = arrays["boundary/topology"][:][arrays[f"set/facets/{name}"][:] == 1, :3]
    facets = dolfinx.mesh.exterior_facet_indices(mesh.topology)
    corners_of_cells = mesh.topology.connectivity(3, 0).array.reshape(-1, 4)
    nodes_of_cells = mesh.geometry.dofmap.array.reshape(len(corners_of_cells), -1)[:, :4]
    node_of = np.empty(corners_of_cells.max() + 1, dtype=np.int64)  # in the file, by corner
    node_of[corners_of_cells] = np.asarray(mesh.geometry.input_global_indices)[nodes_of_cells]
    corners = node_of[mesh.topology.connectivity(2, 0).array.reshape(-1, 3)[facets]]
    facets = np.sort(facets[np.isin(rows(corners), rows(wanted))])
    if len(facets) != len(wanted):
        raise SystemExit(f"the set {name} has facets that are not on the outer boundary: no load can be put on them")
    tags = dolfinx.mesh.meshtags(mesh, 2, facets, np.ones(len(facets), dtype=np.int32))
    return ufl.Measure("ds", domain=mesh, subdomain_data=tags, subdomain_id=1, metadata=exact)


def area_of(ds):
    return fem.assemble_scalar(fem.form(fem.Constant(mesh, PETSc.ScalarType(1)) * ds))


def solve(a, loads, bcs, space):
    """The function for which a is the sum of loads."""
    a = fem.form(a)
    matrix = fem.petsc.assemble_matrix(a, bcs=bcs)
    matrix.assemble()
    right = matrix.createVecRight()
    for load in loads:
        fem.petsc.assemble_vector(right, fem.form(load))
    fem.petsc.apply_lifting(right, [a], [bcs])
    right.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
    fem.petsc.set_bc(right, bcs)
    solver = PETSc.KSP().create(mesh.comm)
    solver.setOperators(matrix)
    solver.setType("preonly")
    solver.getPC().setType("lu")
    solver.getPC().setFactorSolverType("mumps")
    solution = fem.Function(space)
    solver.solve(right, solution.vector)
    solution.x.scatter_forward()
    return solution


def write(*functions):
    for function in functions:
        path = folder / ("{{name}}_" + function.name + ".xdmf")
        with XDMFFile(mesh.comm, str(path), "w") as out:
            out.write_mesh(mesh)
            out.write_function(function)
        values = function.x.array
        print(f"{function.name}: {values.min():.6g} to {values.max():.6g}, in {path.name}")
