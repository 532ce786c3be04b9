"""What the runs say together, in a few sentences at the top: how far apart the bounds are, whether the runs reached limit cycles and
vibrate alike, and how well localized stresses meet direct ones. What needs care is marked."""

from report.base.page import escape, number, quantities
from report.bodies.field_errors import heading
from report.runs.key_numbers import gaps, stiffness_matrices

# Beyond these a sentence is marked.
BOUNDS_APART, FREQUENCIES_APART, STRESSES_APART = 0.1, 0.03, 0.1


def verdict(page, chain):
    """HTML of the list, "" where the runs say nothing together."""
    found = [sentence for run in chain.rve for sentence in bounds(run)]
    found += limit_cycles(chain.transient) + together(chain.transient)
    found += [sentence for run in chain.localization for sentence in errors(run)]
    found += warnings(chain.runs)
    items = "".join(f'<li>{"<b>Care:</b> " * care}{text}</li>' for care, text in found)
    return f"<ul>{items}</ul>" if items else ""


def bounds(run):
    """How far KUBC lies above SUBC on the diagonal of the stiffness."""
    found = gaps(stiffness_matrices(run))
    if not found:
        return []
    gap = max(found)
    place = found.index(gap) + 1
    apart = f"by a factor of {number(1 + gap, 2)}" if gap >= 1 else f"by {percent(gap)}"
    care = gap > BOUNDS_APART
    words = ": this piece alone does not tell the stiffness of the material more closely than that" if care else ""
    return [(care, f"Stiffness of {escape(run.name)}: the bounds KUBC and SUBC differ {apart} at most (D<sub>{place}{place}</sub>){words}.")]


def limit_cycles(runs):
    """Which transient runs reached one or slide steadily; those that tell nothing are left out."""
    reached = [run for run in runs if run.summary.get("limit_cycle_reached") is True]
    steady = [run for run in reached if str(run.summary.get("limit_cycle")).startswith("Steady sliding")]
    result = [(False, f"{what}: {names(those)}.") for what, those in
              (("Limit cycle reached", [run for run in reached if run not in steady]), ("Steady sliding, without vibration", steady)) if those]
    for run in runs:
        if run.summary.get("limit_cycle_reached") is False:
            why = str(run.summary.get("limit_cycle") or "").split(" (the criterion")[0].removeprefix("No limit cycle")
            result.append((True, f"No limit cycle in the run {escape(run.label)}{escape(why)}. Its means may still change."))
    return result


def together(runs):
    """Main frequencies and friction of runs of different materials under the same pressure and flat."""
    result = []
    for pair in pairs(runs):
        frequencies = [run.number("main_frequency") for run in pair]
        if all(frequencies):
            apart = max(frequencies) / min(frequencies) - 1
            peaks = [1 / run.steady_length() / frequency if run.steady_length() else 0.0 for run, frequency in zip(pair, frequencies)]
            care = apart > max(FREQUENCIES_APART, *peaks)
            words = "; they do not vibrate alike, and what is compared between them differs for this reason, too" if care else \
                ", less than the width of a peak" if apart > FREQUENCIES_APART else ""
            result.append((care, f"Main frequencies of {names(pair)}: {' and '.join(quantities(frequencies, 'Hz'))}, "
                                 f"{percent(apart)} apart{words}."))
        frictions = [run.number("global_interface_friction_coefficient") for run in pair]
        if all(frictions):
            halves = [run.number("global_interface_friction_coefficient_95") for run in pair]
            shown = [number(mu) + (f" ± {number(half, 2)}" if half is not None else "") for mu, half in zip(frictions, halves)]
            result.append((False, f"Global interface friction coefficients of {names(pair)}: {' and '.join(shown)}, "
                                  f"{percent(abs(frictions[0] / frictions[1] - 1))} apart."))
    return result


def pairs(runs):
    """Of each homogeneous run and the heterogeneous ones under the same pressure and velocity."""
    alike = lambda a, b: all(a.number(key) == b.number(key) for key in ("pressure", "flat_velocity", "friction_coefficient"))
    return [(a, b) for a in runs if not a.heterogeneous for b in runs if b.heterogeneous and alike(a, b)]


def errors(run):
    """Of the von Mises stress over the whole body and its interior, and of the component that is met worst."""
    found = run.summary.get("field_errors")
    whole = {name: of.get("all") for name, of in found.items() if isinstance(of, dict)} if isinstance(found, dict) else {}
    whole = {name: error for name, error in whole.items() if name.startswith("mean_") and isinstance(error, (int, float))}
    if "mean_von_mises" not in whole:
        return []
    interior = found["mean_von_mises"].get("interior")
    text = f"Mean stresses of {escape(run.name)} differ from direct ones by {percent(whole['mean_von_mises'])} (von Mises, all cells"
    text += f"; {percent(interior)} in the interior)" if isinstance(interior, (int, float)) else ")"
    worst = max(whole, key=whole.get)
    text += f"; most in {heading(worst)}, by {percent(whole[worst])}" if worst != "mean_von_mises" else ""
    return [(whole["mean_von_mises"] > STRESSES_APART, text + ".")]


def warnings(runs):
    """How many there are, and of which runs."""
    warned = [run for run in runs if run.summary.get("warnings")]
    count = sum(len(run.summary["warnings"]) for run in warned)
    return [(True, f"{count} warning{'s' * (count > 1)} of the programs below ({names(warned, 'name')}).")] if count else []


def names(runs, which="label"):
    return " and ".join(escape(getattr(run, which)) for run in runs) if len(runs) < 3 else ", ".join(escape(getattr(run, which)) for run in runs)


def percent(share):
    return f"{number(100 * float(share), 2)} %"
