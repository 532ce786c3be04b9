"""By how much localized and direct stresses differ, by region of the body and by phase; and over which times both are averaged."""

import os

from report.base.data import settings
from report.base.page import escape, number, quantities, table

PLACES = [("all", "all cells"), ("interior", "interior"), ("surface", "surface"), ("surface_inner", "surface without its ends")]
NORMAL = {2: ("yy", "xx"), 3: ("zz", "xx", "yy")}  # the normal of the flat first
WHY_NOT_WELL = {"KUBC": "which prescribe the displacement there", "PBC": "which repeat the body beyond it"}


def field_errors(run):
    """HTML of the table, "" of a run that was compared with none."""
    errors = run.summary.get("field_errors")
    if not isinstance(errors, dict):
        return ""
    errors = {quantity: by_region for quantity, by_region in errors.items() if isinstance(by_region, dict)}
    names = ["von_mises", *(f"sigma_{of}" for of in (*NORMAL[3 if run.summary.get("dim") == 3 else 2], "xy", "xz", "yz"))]
    columns = [f"mean_{name}" for name in names if f"mean_{name}" in errors]
    rows = [[words, *(percent(errors[quantity].get(region)) for quantity in columns)] for region, words in regions(run, errors)]
    rows = [row for row in rows if any(cell != "–" for cell in row[1:])]
    return table(["", *map(heading, columns)], rows) + f'<p class="lead">{explanation(run)}</p>' if rows else ""


def explanation(run):
    """What the numbers are, and what the run says of its tensors and regions."""
    condition, told = run.summary.get("concentration"), settings(run.folder)
    text = "Relative L2 difference of the localized from the direct stress, both averaged over time."
    text += f" Localized with the tensors of {escape(condition)}." if condition else ""
    edge, depth = (length_of(told.get(f"Comparison/{key}")) for key in ("Edge distance", "Surface depth"))
    words = "; ".join([f"the interior lies at least {edge} from all edges"] * bool(edge) +
                      [f"the surface is what lies within {depth} of the flat"] * bool(depth))
    text += f" {words[0].upper()}{words[1:]}." if words else ""
    if condition in WHY_NOT_WELL:
        text += (f" A grain that a free side cuts is not localized well by {condition}, {WHY_NOT_WELL[condition]}: where a row is much larger "
                 "than that of its interior, look for such grains at the sides. MUBC are better for them.")
    return text


def length_of(text):
    """In mm; empty if it is none above zero."""
    try:
        return f"{1e3 * float(text):.4g} mm" if float(text) > 0 else ""
    except (TypeError, ValueError):
        return ""


def window(run, dynamics):
    """Sentences on the times over which stresses are averaged, and on runs of `dynamics` whose steady part begins later."""
    ends, count, direct = (run.summary.get(key) for key in ("window", "snapshots", "direct_snapshots"))
    if not isinstance(ends, list) or len(ends) != 2:
        return ""
    begin, end = quantities(ends, "s")
    text = f" Averaged from {begin} to {end}"
    if count:
        text += f", over {number(count)} snapshots" + (f" ({number(direct)} of the direct run)" if direct not in (None, 0, count) else "")
    read = settings(run.folder)
    names = [os.path.basename(os.path.dirname(read.get(f"Input/{key} run", ""))) for key in ("Homogeneous", "Direct")]
    late = [other for other in dynamics if other.name in names and other.steady_from() >= ends[1]]
    return text + "." + "".join(f" The steady part of the {escape(other.label)} run begins after that, at "
                                f"{quantities([other.steady_from()], 's')[0]}; these are not means over it." for other in late)


def regions(run, errors):
    """(key, words) in the order of the rows: places, then every phase with its interior."""
    known = {region for by_region in errors.values() for region in by_region}
    result = [place for place in PLACES if place[0] in known]
    for phase in run.summary.get("phases") or []:
        key = next((key for key in (f"phase_{phase}", phase) if f"{key}_interior" in known), None)
        if key is not None:
            result += [(key, f"phase {escape(phase)}"), (f"{key}_interior", f"phase {escape(phase)}, interior")]
    return result


def heading(quantity):
    name = quantity.removeprefix("mean_")
    return "von Mises" if name == "von_mises" else f"σ<sub>{name.removeprefix('sigma_')}</sub>"


def percent(error):
    return f"{number(100 * error, 3)} %" if isinstance(error, (int, float)) else "–"
