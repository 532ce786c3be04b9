"""What the scripts of the example meshes share: groups by place, periodic sides, the file. Lengths in mm."""

import math
import random

import gmsh

TOLERANCE = 1e-6  # mm


def in_box(dim, low, high):
    """Entities of one dimension that lie in a box."""
    low, high = ([x + s * TOLERANCE for x in box] for box, s in ((low, -1), (high, 1)))
    return [tag for _, tag in gmsh.model.getEntitiesInBoundingBox(*low, *high, dim)]


def side(dim, size, axis, upper):
    """Entities on one side of the box from 0 to size: curves of a plane body, surfaces of a solid one."""
    low, high = [0, 0, 0], [*size, 0][:3]
    low[axis] = high[axis] = size[axis] if upper else 0
    return in_box(dim - 1, low, high)


def group(dim, tags, name):
    """A physical group: a phase (dim of the body) or a boundary (one less)."""
    gmsh.model.setPhysicalName(dim, gmsh.model.addPhysicalGroup(dim, tags), name)


def make_periodic(dim, size):
    """Opposite sides of the box get the same nodes."""
    for axis in range(dim):
        shift = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
        shift[4 * axis + 3] = size[axis]

        def place(tag):
            """The same for both of a pair of opposite entities."""
            box = gmsh.model.getBoundingBox(dim - 1, tag)
            return [round(x, 4) for k, x in enumerate(box) if k % 3 != axis]

        upper, lower = (sorted(side(dim, size, axis, which), key=place) for which in (True, False))
        gmsh.model.mesh.setPeriodic(dim - 1, upper, lower, shift)


def inclusions(dim, body, tools, names=("matrix", "fibre")):
    """Cuts inclusions out of a body and fills them again, so that both share their points; groups of both phases."""
    pieces, origin = gmsh.model.occ.fragment([(dim, body)], [(dim, tool) for tool in tools])
    gmsh.model.occ.synchronize()
    inside = sorted({tag for parts in origin[1:] for _, tag in parts} & {tag for _, tag in origin[0]})
    gmsh.model.occ.remove([piece for piece in pieces if piece not in origin[0]], recursive=True)
    gmsh.model.occ.synchronize()
    group(dim, [tag for _, tag in origin[0] if tag not in inside], names[0])
    group(dim, inside, names[1])


def scattered(n, size, radius, distance, seed, margin=0.0):
    """n centres at random, so far apart that round inclusions do not touch, and off the sides by margin or cut by them."""
    generator = random.Random(seed)
    centres = []
    for _ in range(100000):
        x = [generator.uniform(margin, length - margin) for length in size]
        off_the_sides = all(min(abs(x[d]), abs(length - x[d])) > distance or margin for d, length in enumerate(size))
        if off_the_sides and all(math.dist(x, other) > 2 * radius + distance for other in centres):
            centres.append(x)
        if len(centres) == n:
            return centres
    raise SystemExit(f"{n} inclusions of radius {radius} do not fit")


def measure(dim, tag):
    """Area or volume of the cells of an entity."""
    kinds, _, _ = gmsh.model.mesh.getElements(dim, tag)
    total = 0.0
    for kind in kinds:
        points, weights = gmsh.model.mesh.getIntegrationPoints(kind, "Gauss2")
        determinants = gmsh.model.mesh.getJacobians(kind, points, tag)[1]
        total += sum(abs(d) * w for d, w in zip(determinants, list(weights) * (len(determinants) // len(weights))))
    return total


def tell_measures(dim):
    """Prints how much of each phase is lost to facets: plane cells cut off what is round."""
    for _, number in gmsh.model.getPhysicalGroups(dim):
        tags = gmsh.model.getEntitiesForPhysicalGroup(dim, number)
        exact, meshed = sum(gmsh.model.occ.getMass(dim, tag) for tag in tags), sum(measure(dim, tag) for tag in tags)
        name = gmsh.model.getPhysicalName(dim, number)
        print(f"{name}: {meshed:.5g} mm^{dim} in the mesh, {exact:.5g} in the geometry, {100 * (meshed / exact - 1):+.1f} %")


def write(name, dim, size, quadrilaterals=True):
    """Meshes with cells of one size (mm) and writes NAME.msh, in binary form for its size."""
    gmsh.option.setNumber("Mesh.MeshSizeMin", size)
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.option.setNumber("Mesh.Algorithm", 6)
    if quadrilaterals:
        gmsh.option.setNumber("Mesh.RecombineAll", 1)
        gmsh.option.setNumber("Mesh.RecombinationAlgorithm", 2)
    gmsh.model.mesh.generate(dim)
    tell_measures(dim)
    gmsh.option.setNumber("Mesh.Binary", 1)
    gmsh.write(name + ".msh")


def start(name):
    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 2)
    gmsh.model.add(name)
