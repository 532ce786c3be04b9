"""What the paper (Peillex, Baillet, Berthier 2008) reports, with the place it is found at, and how the
numbers of a chain are set beside it."""

# Pa, eq. (10): Voigt xx, yy, xy.
STIFFNESS = [[36.54e9, 9.1e9, 0.0], [9.1e9, 47.26e9, 0.0], [0.0, 0.0, 13.785e9]]

# (homogeneous, heterogeneous) by regime: value and source.
INTERFACE_FRICTION = {
    1: {"homogeneous": (0.220, "table 2, δ = 1500 ns"), "heterogeneous": (0.2145, "table 2, mean of 4")},
    2: {"homogeneous": (0.175, "table 3, δ = 1500 ns"), "heterogeneous": (0.173, "table 3, No. 1")},
}
APPARENT_FRICTION = {1: (0.21, "fig. 6"), 2: (0.17, "fig. 6")}
MAIN_FREQUENCY = {1: (41200.0, "fig. 6"), 2: (39600.0, "fig. 6")}
PRESSURE = {1: 0.5e6, 2: 0.4e6}  # Pa, sections 3.6.1 and 3.6.2
SLIP_SHARE = {1: (0.70, "section 2.4"), 2: (0.20, "section 2.4")}
SEPARATION_SHARE = {1: (0.30, "section 2.4"), 2: (0.80, "section 2.4")}

MODES = [(40000.0, "fig. 8(a), contact surface free"),
         (41580.0, "fig. 8(b), contact surface held in y")]

# Pa, table 4 at P = 0.5 MPa: static contact analysis; the larger one is the fibres'.
STATIC_PRESSURES = {"fibre": 2.0e6, "matrix": 0.33e6}

PIN = (0.056, 0.016)  # m, section 3.1


def is_pin(run):
    """Whether the body has the size of the paper's pin: only then its numbers are set beside a run's."""
    grid = run.grid()
    if grid is None or len(grid[0]) != 2:
        return False
    cells, spacing, _ = grid
    return all(abs(n * h - length) < 1e-6 for n, h, length in zip(cells, spacing * [1, 1], PIN))


def regime(run):
    """1 or 2, the regime of the paper a run is nearest to: by its label, else by its shares."""
    label = str(run.summary.get("regime") or "")
    if "regime 2" in label:
        return 2
    separation = run.number("reference_node", "separation")
    if "regime 1" not in label and separation is not None and separation > 0.5:
        return 2
    return 1


def comparison(run):
    """Rows (quantity, ours, paper's, unit, source) of one transient run; ours may be None."""
    r = regime(run)
    rows = [
        ("Global interface friction coefficient μ<sub>inter</sub>",
         run.number("global_interface_friction_coefficient"),
         *INTERFACE_FRICTION[r][run.kind], ""),
        ("Mean apparent friction coefficient",
         run.number("mean_apparent_friction_coefficient"), *APPARENT_FRICTION[r], ""),
        ("Main frequency", run.number("main_frequency"), *MAIN_FREQUENCY[r], "Hz"),
        ("Reference node: share of slip", run.number("reference_node", "slip"), *SLIP_SHARE[r], ""),
        ("Reference node: share of separation",
         run.number("reference_node", "separation"), *SEPARATION_SHARE[r], ""),
    ]
    return [(what, ours, paper, unit, f"{source}, regime {r}")
            for what, ours, paper, source, unit in rows]


def modes(run):
    """The paper's two first modes beside the computed frequency nearest to each. The summary lists the
    frequencies by boundary condition, {"free": [...], "held": [...]}, or as one list."""
    frequencies = run.summary.get("frequencies")
    cases = frequencies if isinstance(frequencies, dict) else {"": frequencies}
    rows = []
    for name, listed in cases.items():
        listed = [f for f in listed if isinstance(f, (int, float))] if isinstance(listed, list) else []
        found = []
        for value, source in MODES:
            nearest = min(listed, key=lambda f: abs(f - value)) if listed else None
            right = name in ("", "free" if "free" in source else "held")
            if right and nearest is not None and abs(nearest - value) < 0.1 * value:
                found.append(("Mode of vibration", nearest, value, "Hz", source))
        # One list is of one case: only the nearer mode is this run's.
        rows += sorted(found, key=lambda row: abs(row[1] - row[2]))[:1]
    return rows


def static_pressures(run):
    """Rows for the contact pressures of the phases, as a static contact analysis reports them."""
    pressures = run.summary.get("phase_contact_pressures")
    if isinstance(pressures, list):
        pressures = {str(entry.get("name")): entry.get("pressure") for entry in pressures
                     if isinstance(entry, dict)}
    if not isinstance(pressures, dict) or not pressures:
        return []
    numbers = {name: float(value) for name, value in pressures.items()
               if isinstance(value, (int, float))}
    if not numbers:
        return []
    stiffest = max(numbers, key=numbers.get)
    return [(f"Contact pressure, {name}", value,
             STATIC_PRESSURES["fibre" if name == stiffest else "matrix"] if len(numbers) == 2 else None,
             "Pa", "table 4 (SCA), P = 0.5 MPa") for name, value in numbers.items()]
