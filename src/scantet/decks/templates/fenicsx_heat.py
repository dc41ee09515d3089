"""{{provenance}}

Steady heat with DOLFINx 0.5: python3 {{name}}.py. Lengths in mm, heat in W, conductivities in W/(mm K), temperatures in K or degrees C.
"""
{{model}}

space = fem.FunctionSpace(mesh, ("Lagrange", order))
u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
loads = [fem.Constant(mesh, PETSc.ScalarType(0)) * v * dx]
for name, (whole,) in loaded:
    ds = measure_of(name)
    loads.append(whole / area_of(ds) * v * ds)
bcs = [fem.dirichletbc(PETSc.ScalarType(value), dofs_of(space, name), space) for name, value in held]
temperature = solve(of_materials(4) * ufl.inner(ufl.grad(u), ufl.grad(v)) * dx, loads, bcs, space)
temperature.name = "temperature"
write(temperature)
