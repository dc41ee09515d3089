"""{{provenance}}

Linear statics with DOLFINx 0.5: python3 {{name}}.py. Lengths in mm, forces in N, stresses in MPa.
"""
{{model}}

space = fem.VectorFunctionSpace(mesh, ("Lagrange", order))
u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
modulus, ratio = of_materials(1), of_materials(2)
lame, shear = modulus * ratio / ((1 + ratio) * (1 - 2 * ratio)), modulus / (2 * (1 + ratio))


def stress(w):
    strain = ufl.sym(ufl.grad(w))
    return lame * ufl.tr(strain) * ufl.Identity(3) + 2 * shear * strain


loads = [ufl.inner(fem.Constant(mesh, np.zeros(3)), v) * dx]
for name, numbers in loaded:
    ds = measure_of(name)
    if len(numbers) == 1:  # a pressure
        loads.append(-numbers[0] * ufl.dot(ufl.FacetNormal(mesh), v) * ds)
    else:  # a force
        loads.append(ufl.dot(fem.Constant(mesh, np.array(numbers) / area_of(ds)), v) * ds)
bcs = [fem.dirichletbc(PETSc.ScalarType(0), 3 * dofs_of(space, name) + "xyz".index(axis), space.sub("xyz".index(axis)))
       for name, axes in held for axis in axes]
displacement = solve(ufl.inner(stress(u), ufl.sym(ufl.grad(v))) * dx, loads, bcs, space)
displacement.name = "displacement"

deviator = ufl.dev(stress(displacement))
of_cells = fem.FunctionSpace(mesh, ("DG", 0))
von_mises = fem.Function(of_cells, name="von_mises")
von_mises.interpolate(fem.Expression(ufl.sqrt(1.5 * ufl.inner(deviator, deviator)), of_cells.element.interpolation_points()))
write(displacement, von_mises)
