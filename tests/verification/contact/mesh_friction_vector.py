"""The friction vector in three dimensions: blocks that are as good as rigid, thrown on the flat, against the motion of a point with mass
under the law of friction, d f / dt = -(f - mu m g s / |s|) / delta, s the velocity of the flat over the block; f = 0 at the start.
The blocks are flat: one of height h tilts, and what its friction then turns it is of the order of h^2."""

import tempfile

import h5py
import numpy as np
from scipy.integrate import solve_ivp

from mesh_files import Box
from scenes import Folder, prm

MU, GRAVITY, DENSITY, SIZE = 0.3, 2000.0, 7800.0, (3e-3, 3e-3, 2.5e-4)
BLOCK = "set Dimension = 3\n" + prm({
    "Mesh/File": "block.msh", "Mesh/Scale": 0.001, "Phases/Names": "steel", "Phases/steel/Young modulus": "200e9",
    "Phases/steel/Poisson ratio": 0.2, "Phases/steel/Density": DENSITY, "Supports/Top/Kind": "pressure", "Supports/Top/Pressure": 0,
    "Friction/Coefficient": MU, "Time/Rayleigh beta": 2e-8, "Time/End time": 4.5e-3, "Snapshots/Interval": 1e-5,
    "Observation/History interval": 50})

# Velocity of the flat along x and of the block (m/s), pull (m/s^2), delta (s).
CASES = {
    "thrown askew, Coulomb": (0.0, (0.8, -0.6), (0.0, 0.0), 0.0),
    "thrown askew": (0.0, (0.8, -0.6), (0.0, 0.0), 3e-4),
    "drifting over the moving flat, Coulomb": (1.5, (0.0, 0.7), (0.0, 0.0), 0.0),
    "drifting over the moving flat": (1.5, (0.0, 0.7), (0.0, 0.0), 3e-4),
    "drifting and pulled, Coulomb": (1.2, (0.3, -0.7), (100.0, 250.0), 0.0),
    "drifting and pulled": (1.2, (0.3, -0.7), (100.0, 250.0), 6e-4),
}


def point_with_mass(flat, velocity, pull, delta, times):
    """Displacement, friction over the mass and work of friction over the mass at the times before the slip has fallen to a tenth."""
    flat, pull = np.array([flat, 0.0]), np.array(pull)
    start = np.concatenate([[0, 0], velocity, [0, 0], [0]])

    def target(v):
        return MU * GRAVITY * (flat - v) / np.linalg.norm(flat - v)

    def rates(_, y):
        v = y[2:4]
        f = y[4:6] if delta > 0 else target(v)
        return np.concatenate([v, f + pull, (target(v) - f) / delta if delta > 0 else [0, 0], [f @ (flat - v)]])

    def slow(_, y):
        return np.linalg.norm(flat - y[2:4]) - 0.1 * np.linalg.norm(flat - velocity)

    slow.terminal = True
    solution = solve_ivp(rates, (0, times[-1]), start, events=slow, dense_output=True, rtol=1e-10, atol=1e-14)
    assert len(solution.t_events[0]) == 1, "the slip has to end"
    times = times[times < solution.t_events[0][0]]
    y = solution.sol(times)
    force = y[4:6] if delta > 0 else np.array([target(v) for v in y[2:4].T]).T
    return len(times), y[:2].T, force.T, y[6]


def check(folder, name, flat, velocity, pull, delta):
    settings = {"Flat/Velocity": flat, "Friction/Regularization time": delta, "Body/Initial velocity": "%r, %r, 0" % velocity,
                "Body/Acceleration": "%r, %r, %r" % (*pull, -GRAVITY)}
    folder.write("block.prm", BLOCK + prm(settings))
    folder.run(0, "contact_dynamics", "block.prm", "--output", "block")
    mass = DENSITY * np.prod(SIZE)
    with h5py.File(folder("block", "dynamics.h5")) as file:
        times, u = file["snapshots/time"][()], file["snapshots/displacement"][()].mean(axis=1)
        history = {key: file["history/" + key][()] for key in ("time", "contact_tangential_force", "friction_energy")}
    n, way, _, _ = point_with_mass(flat, velocity, pull, delta, times)
    length = np.linalg.norm(way[-1])
    error = np.abs(u[:n, :2] - way).max() / length
    n, _, force, work = point_with_mass(flat, velocity, pull, delta, history["time"])
    # The block trembles a little at first, as its weight comes at once.
    settled = slice(n // 10, n)
    force_error = np.abs(history["contact_tangential_force"][:n] / mass - force[:, 0])[settled].max() / (MU * GRAVITY)
    work_error = np.abs(history["friction_energy"][:n] / mass - work).max() / work[-1]
    end = np.linalg.norm((u[-1] - u[-30])[:2] / (times[-1] - times[-30]) - [flat, 0]) / np.linalg.norm([flat - velocity[0], velocity[1]])
    turned = np.degrees(np.ptp(np.unwrap(np.arctan2(force[settled, 1], force[settled, 0]))))
    print(f"{name}: way {1e3 * length:.3f} mm off by {error:.1e}, force by {force_error:.1e}, work by {work_error:.1e}; friction turns by "
          f"{turned:.0f} degrees; slip left in the end {end:.1e}")
    assert error < 5e-5 and force_error < 1e-3 and work_error < 1e-4, name
    # Friction that lags lets a pulled block spiral to rest.
    assert end < (0.1 if delta > 0 and any(pull) else 1e-9), name
    assert (turned > 25) == (any(pull)), name


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        box = Box([1e3 * length for length in SIZE], [3, 3, 1], lambda x: "steel")
        box.name_side("Contact", 2, False).name_side("Top", 2, True).write(folder("block.msh"))
        for name, case in CASES.items():
            check(folder, name, *case)


if __name__ == "__main__":
    main()
