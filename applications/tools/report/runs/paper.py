"""What the paper (Peillex, Baillet, Berthier 2008) reports, with the place it is found at, and how the
numbers of a chain are set beside it."""

from report.runs import paper_values as values

D11, D12, D22, D33 = (values.STIFFNESS[entry] for entry in ("D11", "D12", "D22", "D33"))
STIFFNESS = [[D11, D12, 0.0], [D12, D22, 0.0], [0.0, 0.0, D33]]  # Voigt xx, yy, xy

# Value and source by regime.
INTERFACE_FRICTION = {
    1: {"homogeneous": (values.TABLE_2["homogeneous"][1500], "table 2, δ = 1500 ns"),
        "heterogeneous": (sum(values.TABLE_2["heterogeneous"].values()) / 4, "table 2, mean of 4")},
    2: {"homogeneous": (values.TABLE_3["homogeneous"][1500], "table 3, δ = 1500 ns"),
        "heterogeneous": (values.TABLE_3["heterogeneous"][1], "table 3, No. 1")},
}
APPARENT_FRICTION = {regime: (value, "fig. 6") for regime, value in values.MEAN_APPARENT_FRICTION.items()}
MAIN_FREQUENCY = {regime: (value, "fig. 6") for regime, value in values.MAIN_FREQUENCY.items()}
SLIP_SHARE = {regime: (share, "section 2.4") for regime, share in values.SLIP.items()}
SEPARATION_SHARE = {regime: (1 - share, "section 2.4") for regime, share in values.SLIP.items()}
PRESSURE = {1: 0.5e6, 2: 0.4e6}  # Pa, sections 3.6.1 and 3.6.2
MODES = [(values.MODES["free"], "fig. 8(a), contact surface free"),
         (values.MODES["held"], "fig. 8(b), contact surface held in y")]
STATIC_PRESSURES = values.TABLE_4["SCA"]  # at P = 0.5 MPa; the larger one is the fibres'

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
    frequencies by boundary condition, {"free": [...], "held": [...]}, or as one list, of which only the nearer mode is this run's."""
    frequencies = run.summary.get("frequencies")
    cases = frequencies if isinstance(frequencies, dict) else {"": frequencies}
    rows = []
    for name, listed in cases.items():
        listed = [f for f in listed if isinstance(f, (int, float))] if isinstance(listed, list) else []
        found = [("Mode of vibration", min(listed, key=lambda f: abs(f - value)), value, "Hz", source) for value, source in MODES
                 if listed and name in ("", "free" if "free" in source else "held")]
        rows += sorted((row for row in found if abs(row[1] - row[2]) < 0.1 * row[2]), key=lambda row: abs(row[1] - row[2]))[:1]
    return rows


def static_pressures(run):
    """Rows for the contact pressures of the phases, as a static contact analysis reports them."""
    pressures = run.summary.get("phase_contact_pressures")
    numbers = {name: float(value) for name, value in pressures.items() if isinstance(value, (int, float))} \
        if isinstance(pressures, dict) else {}
    if not numbers:
        return []
    stiffest = max(numbers, key=numbers.get)
    return [(f"Contact pressure, {name}", value,
             STATIC_PRESSURES["fibre" if name == stiffest else "matrix"] if len(numbers) == 2 else None,
             "Pa", "table 4 (SCA), P = 0.5 MPa") for name, value in numbers.items()]
