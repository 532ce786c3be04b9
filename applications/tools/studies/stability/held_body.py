"""The critical time step of a homogeneous pin whose top and contact are held, from the exact largest frequency: what the
program's prediction, of the free grid, leaves out."""


import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg as linalg


from sliding_pin import SlidingPin

SIZE, DENSITY = (0.056, 0.016), 1770.0  # m, kg/m^3; of pin.prm
STIFFNESS = np.array([[3.654e10, 9.1e9, 0], [9.1e9, 4.726e10, 0], [0, 0, 1.3785e10]])  # Pa; eq. (10)


def largest_frequency(cells):
    """1/s; the contact keeps u_y = 0 and slides freely, the platen has u_x = 0 and one u_y."""
    pin = SlidingPin.build(np.zeros(cells[::-1], int), [STIFFNESS], DENSITY, SIZE, mu=0.0, delta=0.0, beta=0.0)
    scale = sparse.diags(1 / np.sqrt(pin.mass.diagonal()))
    return np.sqrt(linalg.eigsh(scale @ pin.stiffness @ scale, k=1, which="LA", tol=1e-12, return_eigenvectors=False)[0])


def critical_time_step(cells, beta2, beta):
    """s; doc/theory.md, section 2."""
    omega = largest_frequency(cells)
    xi = beta * omega / 2
    return (np.sqrt(xi**2 + 2 * beta2) - xi) / (beta2 * omega)
