"""Table 4: pressures of fibres and matrix at the contact, and the homogenized friction coefficient."""

import numpy as np

from cases import RVE_SEEDS
from page import fixed, relative
from report.base.figures import BLUE, GREY, ORANGE, above_all, lettered, panels
from report.runs import paper_values as paper

PHASES = ("fibre", "matrix")


def runs(cases):
    return [cases.static_contact(seed) for seed in RVE_SEEDS]


def repartition(pressure, share, moduli):
    """Eq. (19): pressures of equal strain, for a share of fibres."""
    mixed = share * moduli["fibre"] + (1 - share) * moduli["matrix"]
    return {phase: pressure * moduli[phase] / mixed for phase in PHASES}


def homogenized(share, pressures, pressure):
    """Eq. (17)."""
    mu = paper.TABLE_4["mu"]
    return (share * mu["fibre"] * pressures["fibre"] + (1 - share) * mu["matrix"] * pressures["matrix"]) / pressure


def _young(stiffness):
    """Young's modulus of an isotropic plane-strain stiffness."""
    shear = stiffness[2, 2]
    nu = stiffness[0, 1] / (stiffness[0, 0] + stiffness[0, 1])
    return 2 * shear * (1 + nu)


def _fibre_share(run):
    """Of the contact: cells of the lowest row that are fibre."""
    return float(np.mean(run.need("/material/phase_id")[0] == 1))


def table(fragment, results, names):
    found = [results[name] for name in names]
    pressure = found[0].number("pressure")
    moduli = dict(zip(("matrix", "fibre"), (_young(s) for s in found[0].need("/material/stiffness"))))
    share = np.array([_fibre_share(run) for run in found])
    measured = {phase: np.array([run.number("phase_contact_pressures", phase) for run in found]) for phase in PHASES}
    coefficients = np.array([homogenized(s, {p: measured[p][k] for p in PHASES}, pressure) for k, s in enumerate(share)])
    spr = repartition(pressure, paper.FIBRE_SHARE, moduli)
    fits = {phase: np.polyfit(share, measured[phase], 1) for phase in PHASES}
    at_ten = {phase: float(np.polyval(fits[phase], paper.FIBRE_SHARE)) for phase in PHASES}
    rows = []
    for method, ours in (("SPR", {**spr, "mu_homo": homogenized(paper.FIBRE_SHARE, spr, pressure)}),
                         ("SCA", {**at_ten, "mu_homo": homogenized(paper.FIBRE_SHARE, at_ten, pressure)})):
        for key, label, unit in (("fibre", "P_h [MPa]", 1e6), ("matrix", "P_m [MPa]", 1e6), ("mu_homo", "mu_homo", 1.0)):
            value = paper.TABLE_4[method][key]
            everything = {**measured, "mu_homo": coefficients}[key] / unit
            spread = f"{everything.mean():.3f} ± {everything.std(ddof=1):.3f}" if method == "SCA" else "-"
            rows.append([f"{label}, {method}", fixed(value / unit, 2), fixed(ours[key] / unit), relative(ours[key], value), spread])
    fragment.table(["", "paper", "ours at 10 % on the contact", "difference [%]", f"mean and deviation of {len(found)} morphologies"], rows)
    fragment.text(
        "P_h and P_m are the means of −σ_yy over the cells of fibres and matrix at the contact under 0.5 MPa; all nodes slip, with "
        f"friction by phase. In the paper's morphology fibres cover 10 % of the contact, in ours {100 * share.min():.1f} "
        f"to {100 * share.max():.1f} %. At 10 %, our SPR is eq. (19) and our SCA a straight line through the morphologies.")
    figure, axes = panels(2, 5.2, sharex=True)
    shown = np.linspace(min(share.min(), 0.07), max(share.max(), 0.105), 50)
    for axis, phase in zip(axes, PHASES):
        axis.plot(100 * shown, [repartition(pressure, s, moduli)[phase] / 1e6 for s in shown], color=GREY, label="SPR, eq. (19)")
        axis.plot(100 * shown, np.polyval(fits[phase], shown) / 1e6, color=BLUE, lw=0.9, ls="--")
        axis.plot(100 * share, measured[phase] / 1e6, "o", color=BLUE, label="SCA, morphologies")
        axis.plot(10, paper.TABLE_4["SCA"][phase] / 1e6, "x", color=ORANGE, ms=9, mew=2.5, label="paper, SCA")
        axis.plot(10, paper.TABLE_4["SPR"][phase] / 1e6, "+", color=ORANGE, ms=11, mew=2.5, label="paper, SPR")
        axis.set_ylabel(f"pressure of {phase} (MPa)")
    axes[1].set_xlabel("share of fibres on the contact (%)")
    lettered(axes)
    above_all(figure, axes[0].get_legend_handles_labels()[0], columns=4)
    fragment.figure(figure, "Static contact pressures of the phases", "(a) Fibres, (b) matrix; dashed: the straight line.")
