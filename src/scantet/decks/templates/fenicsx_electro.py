"""{{provenance}}

Steady currents with DOLFINx 0.5: python3 {{name}}.py. Lengths in mm, currents in A, conductivities in S/mm, potentials in V.
"""
{{model}}

space = fem.FunctionSpace(mesh, ("Lagrange", order))
u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
loads = [fem.Constant(mesh, PETSc.ScalarType(0)) * v * dx]
for name, (whole,) in loaded:
    ds = measure_of(name)
    loads.append(whole / area_of(ds) * v * ds)
bcs = [fem.dirichletbc(PETSc.ScalarType(value), dofs_of(space, name), space) for name, value in held]
potential = solve(of_materials(4) * ufl.inner(ufl.grad(u), ufl.grad(v)) * dx, loads, bcs, space)
potential.name = "potential"
write(potential)
