"""{{provenance}}

The ten lowest natural frequencies with DOLFINx 0.5 and SLEPc: python3 {{name}}.py. Lengths in mm, stiffness in MPa, densities
in tonne/mm3, frequencies in Hz.
"""
{{model}}
from slepc4py import SLEPc  # noqa: E402

space = fem.VectorFunctionSpace(mesh, ("Lagrange", order))
u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
modulus, ratio, density = of_materials(1), of_materials(2), of_materials(3)
lame, shear = modulus * ratio / ((1 + ratio) * (1 - 2 * ratio)), modulus / (2 * (1 + ratio))
strain = ufl.sym(ufl.grad(u))
stress = lame * ufl.tr(strain) * ufl.Identity(3) + 2 * shear * strain
bcs = [fem.dirichletbc(PETSc.ScalarType(0), 3 * dofs_of(space, name) + "xyz".index(axis), space.sub("xyz".index(axis)))
       for name, axes in held for axis in axes]
stiffness = fem.petsc.assemble_matrix(fem.form(ufl.inner(stress, ufl.sym(ufl.grad(v))) * dx), bcs=bcs)
mass = fem.petsc.assemble_matrix(fem.form(density * ufl.inner(u, v) * dx), bcs=bcs, diagonal=0.0)
stiffness.assemble()
mass.assemble()

solver = SLEPc.EPS().create(mesh.comm)
solver.setOperators(stiffness, mass)
solver.setProblemType(SLEPc.EPS.ProblemType.GHEP)
solver.setDimensions(10)
solver.setTarget(-1.0 if not bcs else 0.0)  # what is not held has modes without a stiffness
solver.setWhichEigenpairs(SLEPc.EPS.Which.TARGET_MAGNITUDE)
solver.getST().setType("sinvert")
solver.getST().getKSP().setType("preonly")
solver.getST().getKSP().getPC().setType("lu")
solver.getST().getKSP().getPC().setFactorSolverType("mumps")
solver.solve()
if solver.getConverged() < 10:
    raise SystemExit(f"{solver.getConverged()} of 10 frequencies converged")
mode = fem.Function(space, name="first_mode")
for n in range(10):
    value = solver.getEigenpair(n, mode.vector if n == 0 else None)
    print(f"frequency {n + 1}: {max(value.real, 0.0) ** 0.5 / (2 * np.pi):.10g} Hz")
mode.x.scatter_forward()
write(mode)
