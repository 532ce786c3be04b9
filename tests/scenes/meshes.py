"""Meshes of round and irregular inclusions in a box, and constants of isotropic phases, for the tests of bodies on meshes."""

import itertools

import numpy as np

from mesh_files import AROUND, Cells


def blocks_of_cube(dim, n, radii, layers, half):
    """Blocks of points [..., dim] from a square or cube with bulging sides through circles or spheres to the box of 2 x `half`, and
    the number of the region of each: 0 within radii[0], ... `layers` are those of cells from each surface to the next."""
    tangent = np.tan(np.pi / 4 * np.linspace(-1, 1, 2 * n + 1))
    bulging = lambda p: 0.5 * radii[0] * (1 - 0.1 * (np.sum(p**2, axis=-1, keepdims=True) - 1)) * p
    blocks = [(0, bulging(np.stack(np.meshgrid(*[tangent] * dim, indexing="ij"), axis=-1)))]
    for axis, sign in itertools.product(range(dim), (1, -1)):
        face = np.insert(np.stack(np.meshgrid(*[tangent] * (dim - 1), indexing="ij"), axis=-1), axis, sign, axis=-1)
        outward = face / np.linalg.norm(face, axis=-1, keepdims=True)
        surfaces = [bulging(face), *(r * outward for r in radii), half * face]
        for k, m in enumerate(layers):
            # Towards the box the layers grow as their distance from the middle does.
            share = np.linspace(0, 1, m + 1)
            if k == len(radii):
                ratio = half / radii[-1]
                share = (ratio**share - 1) / (ratio - 1)
            blocks.append((k, np.stack([(1 - s) * surfaces[k] + s * surfaces[k + 1] for s in share])))
    return blocks


def inclusion(dim, n, radii, layers, groups, half=1.0):
    """A square or cube of 2 x `half` with a circle or sphere of several regions in its middle: quadrilaterals or hexahedra that follow
    the surfaces, 2 n along a quarter of a circle. Points on opposite sides lie opposite."""
    blocks = blocks_of_cube(dim, n, radii, layers, half)
    flat = np.vstack([block.reshape(-1, dim) for _, block in blocks])
    _, first, number = np.unique(np.round(flat / half, 9), axis=0, return_index=True, return_inverse=True)
    cells, names, begin = [], [], 0
    for region, block in blocks:
        shape = block.shape[:-1]
        index = number.ravel()[begin : begin + np.prod(shape)].reshape(shape)
        begin += np.prod(shape)
        corners = np.stack([index[tuple(slice(s, s + m - 1) for s, m in zip(step, shape))].ravel() for step in AROUND[dim]], axis=1)
        ends = flat[first][corners[0]]
        # The neighbours of the first corner along the axes of the block.
        if np.linalg.det(ends[[1, 3, 4][:dim]] - ends[0]) < 0:
            corners = corners[:, [3, 2, 1, 0] if dim == 2 else [4, 5, 6, 7, 0, 1, 2, 3]]
        cells += corners.tolist()
        names += [groups[region]] * len(corners)
    return Cells("cube", flat[first], cells, names)


def made_irregular(mesh, half=1.0):
    """The same cells, with the points moved where they do not lie on the sides."""
    x = mesh.points / half
    inside = np.prod(1 - x**2, axis=1)
    for axis in range(x.shape[1]):
        mesh.points[:, axis] += 0.15 * half * inside * np.sin(2.5 * x[:, axis - 1] + 1.3 * x[:, axis] + axis)
    return mesh


class Phase:
    """An isotropic material by lambda and G (Pa). `eta` is what stands beside the bulk modulus in formulas of round inclusions."""

    def __init__(self, dim, k, G):
        self.k, self.G = k, G  # k of plane strain in 2D
        self.lame = k - 2 * G / dim
        self.eta = 2 * G * (dim - 1) / dim

    def keys(self, name):
        return {f"Phases/{name}/Young modulus": repr(self.G * (3 * self.lame + 2 * self.G) / (self.lame + self.G)),
                f"Phases/{name}/Poisson ratio": repr(self.lame / (2 * (self.lame + self.G)))}


def order(errors, sizes):
    """Orders with which the errors fall as the numbers of cells grow."""
    return np.log(np.abs(errors[:-1] / errors[1:])) / np.log(np.divide(sizes[1:], sizes[:-1]))
