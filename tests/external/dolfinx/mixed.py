#!/usr/bin/python3
"""The Laplace equation on [-1, 1] x [0, 1], u = r^(1/2) sin(phi/2): given where y = 0 < x and on the three other sides, free where
y = 0 > x. Where the two conditions meet u is singular: the order of P1 is 1/2 in H1, and 1 in L2, and no greater degree helps.

    mixed.py N DEFECT

N elements a unit of length. Planted defects: 1, a thousandth of the boundary values; 2, the free part a cell too short."""

import json
import sys

import numpy
import ufl
from dolfinx import fem, mesh
from mpi4py import MPI
from petsc4py.PETSc import ScalarType

n, defect = int(sys.argv[1]), int(sys.argv[2])
domain = mesh.create_rectangle(MPI.COMM_WORLD, [[-1.0, 0.0], [1.0, 1.0]], [2 * n, n])
space = fem.FunctionSpace(domain, ("Lagrange", 1))
shift = 1.0 / n if defect == 2 else 0.0


def exact(x):
    return (x[0] ** 2 + x[1] ** 2) ** 0.25 * numpy.sin(numpy.arctan2(x[1], x[0]) / 2)


def is_given(x):
    free = numpy.logical_and(numpy.isclose(x[1], 0), x[0] < 1e-9 - shift)
    on_edge = numpy.isclose(x[1], 0) | numpy.isclose(x[1], 1) | numpy.isclose(abs(x[0]), 1)
    return numpy.logical_and(on_edge, ~numpy.logical_and(free, x[0] > -1 + 1e-9))


given = fem.Function(space)
given.interpolate(lambda x: exact(x) * (1.001 if defect == 1 else 1.0))
condition = fem.dirichletbc(given, fem.locate_dofs_geometrical(space, is_given))
u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
nothing = fem.Constant(domain, ScalarType(0)) * v * ufl.dx
solved = fem.petsc.LinearProblem(ufl.dot(ufl.grad(u), ufl.grad(v)) * ufl.dx, nothing, bcs=[condition],
                                 petsc_options={"ksp_type": "preonly", "pc_type": "lu"}).solve()

# In the two cells at the singular point the points of degree 12 know the norms in part, on all meshes the same part.
x = ufl.SpatialCoordinate(domain)
r = ufl.sqrt(x[0] ** 2 + x[1] ** 2)
angle = ufl.atan_2(x[1], x[0]) / 2
wanted = ufl.sqrt(r) * ufl.sin(angle)
slope = ufl.as_vector((-ufl.sin(angle), ufl.cos(angle))) / (2 * ufl.sqrt(r))
dx = ufl.dx(metadata={"quadrature_degree": 12})


def norm(square):
    return domain.comm.allreduce(fem.assemble_scalar(fem.form(square * dx)), op=MPI.SUM) ** 0.5


with open("errors.json", "w") as file:
    json.dump({"L2": norm((solved - wanted) ** 2), "H1": norm(ufl.inner(ufl.grad(solved) - slope, ufl.grad(solved) - slope))}, file)
