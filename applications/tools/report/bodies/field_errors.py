"""By how much localized and direct stresses differ, by region of the body and by phase."""

from report.base.page import escape, number, table

PLACES = [("all", "all cells"), ("interior", "interior"), ("surface", "surface"), ("surface_inner", "surface without its ends")]
COLUMNS = ("von_mises", "sigma_yy", "sigma_xx", "sigma_zz", "sigma_xy", "sigma_xz", "sigma_yz")
EXPLANATION = ("Relative L2 difference of the localized from the direct stress, both averaged over time. The interior lies at least the "
               "<code>Edge distance</code> of the comparison away from all edges; the surface is what lies within its <code>Surface "
               "depth</code> of the flat. A grain that a free side cuts is not localized well by KUBC, which prescribe the displacement there: "
               "where a row is much larger than that of its interior, look for such grains at the sides. MUBC are better for them.")


def field_errors(run):
    """HTML of the table, "" of a run that was compared with none."""
    errors = run.summary.get("field_errors")
    if not isinstance(errors, dict):
        return ""
    errors = {quantity: by_region for quantity, by_region in errors.items() if isinstance(by_region, dict)}
    columns = [f"mean_{name}" for name in COLUMNS if f"mean_{name}" in errors]
    rows = [[words, *(percent(errors[quantity].get(region)) for quantity in columns)] for region, words in regions(run, errors)]
    rows = [row for row in rows if any(cell != "–" for cell in row[1:])]
    return table(["", *map(heading, columns)], rows) + f'<p class="lead">{EXPLANATION}</p>' if rows else ""


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
