#!/usr/bin/env python3
"""One report.html, with its pictures and their data in it, from the result folders of a chain.

    make_report.py [--output report.html] [--surface-times 1e-3,2e-3] [--pictures DIR] folder...

Each folder is the output of rve_homogenization, contact_dynamics or stress_localization (recognised by
"program" in summary.json), or holds such folders. Any subset works: what is missing is named and left out.
"""

import argparse
import base64
import concurrent.futures
import datetime
import json
import multiprocessing
import os
import platform
import re
import signal
import sys

if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # at once and without a word; the report of before stays
sys.dont_write_bytecode = True  # leave no __pycache__ in a source tree
TOOLS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, TOOLS)
sys.path.append(os.path.join(TOOLS, "python", "mesoslip"))  # for ranks.py; the module as a whole reads files in another way

from ranks import idle_cores
from report import sections
from report.base import figures
from report.base.data import Chain, Missing, without_folders
from report.base.page import Page, escape, note
from report.base.words import explained
from report.runs.space_time import has_surface_map


def attempt(page, make, *arguments):
    """HTML of a section part; a note instead of a traceback if it cannot be made."""
    try:
        return make(page, *arguments)
    except Missing as missing:
        return note(f"Left out: {missing}.")
    except Exception as error:  # a report is never worth losing for one figure
        figures.plt.close("all")
        return note(f"Left out: {type(error).__name__} while drawing ({without_folders(str(error))}).")


WORK = []  # (page, chain, parts) of the processes that drawn() forks


def draw(k):
    """HTML of the part k, and what drawing it has noted of each run."""
    page, chain, parts = WORK[-1]
    known = [len(run.notes) for run in chain.runs]
    return attempt(page, *parts[k]), [run.notes[n:] for run, n in zip(chain.runs, known)]


def drawn(page, chain, parts):
    """HTML of each part. Processes on idle cores share the parts."""
    processes = min(idle_cores(0.05), len(parts))
    if processes < 2 or "fork" not in multiprocessing.get_all_start_methods():
        return [attempt(page, *part) for part in parts]
    WORK.append((page, chain, parts))
    with concurrent.futures.ProcessPoolExecutor(processes, multiprocessing.get_context("fork")) as pool:
        found = list(pool.map(draw, range(len(parts))))
    WORK.pop()
    for _, of_runs in found:
        for run, notes in zip(chain.runs, of_runs):
            run.notes += [text for text in notes if text not in run.notes]
    return [html for html, _ in found]


def made(page, part, html):
    """HTML of a part, or of a list of parts in a row, of which `html` has the next."""
    return page.row(next(html) for _ in part) if isinstance(part, list) else next(html)


def processor():
    """The machine, by its processor."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            model = next((line.split(":")[1].strip() for line in file if line.startswith("model name")), platform.machine())
    except OSError:
        model = platform.machine()
    return f"{model}, {os.cpu_count()} processors"


def build(chain, title, folder=".", surface_times=()):
    """The Page of a chain that will stand in a folder; `surface_times` (s) are those of the pictures of contact surfaces in 3D."""
    what = f"{len(chain.runs)} result folder{'s' if len(chain.runs) != 1 else ''}"
    page = Page(title, f"From the composite’s microstructure to its sliding contact and back: {what}. "
                       "Tension is positive; contact pressures are positive, too. " + thickness(chain) +
                f"Written on {datetime.datetime.now():%Y-%m-%d %H:%M} by make_report.py on a machine with {escape(processor())}.", folder)
    plan = sections.plan(chain, surface_times)
    html = iter(drawn(page, chain, [one for _, parts in plan for part in parts for one in (part if isinstance(part, list) else [part])]))
    for heading, parts in plan:
        page.section(heading, "".join(made(page, part, html) for part in parts))
    words = explained(content for _, content, _ in page.sections)
    if words:
        page.section("Words", words)
    notes = chain.all_notes()
    if notes:
        page.section("Notes", "".join(note(text) for text in dict.fromkeys(notes)))
    details = "".join(
        f"<details><summary>{escape(run.name)}/summary.json</summary><pre>"
        f"{escape(json.dumps(run.summary, indent=1))}</pre></details>" for run in chain.runs)
    if details:
        page.section("Everything the programs summarised", details, "screen")
    return page


def thickness(chain):
    plane = [run for run in chain.dynamics if run.per_thickness()]
    return "Bodies are plane: forces and energies are those per metre of thickness (N/m, J/m). " if plane else ""


def title_of(folders):
    """The program and the name of the folder that holds all that is shown."""
    paths = [os.path.abspath(folder) for folder in folders]
    name = os.path.basename(os.path.commonpath(paths))
    return f"mesoslip: {name}" if name else "mesoslip"


def write_pictures(html, folder):
    """The pictures of a page as figure-NUMBER.png."""
    os.makedirs(folder, exist_ok=True)
    for data, figure in re.findall(r'src="data:image/png;base64,([^"]+)"><figcaption><b>Figure (\d+)\.', html):
        with open(os.path.join(folder, f"figure-{figure}.png"), "wb") as stream:
            stream.write(base64.b64decode(data))


def times_of(text):
    """Times (s) from the words of an option."""
    try:
        times = [float(word) for word in text.split(",")]
    except ValueError:
        times = [-1.0]
    if not all(0 <= time < float("inf") for time in times):
        raise argparse.ArgumentTypeError(f'"{text}" are not times in seconds; write them as 1e-3,2e-3')
    return times


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folders", nargs="+", metavar="folder", help="result folder(s) of a chain")
    parser.add_argument("--output", default="report.html", help="file to write (default: %(default)s)")
    parser.add_argument("--title", help="title (default: mesoslip and the name of the folder that holds all of them)")
    parser.add_argument("--surface-times", type=times_of, default=(), metavar="T,...",
                        help="times (s) at which the contact surfaces of bodies in 3D are shown, from their maps of the contact "
                             "(default: four of the last periods)")
    parser.add_argument("--pictures", metavar="DIR", help="folder for the figures as PNG files, too: figure-1.png and so on")
    options = parser.parse_args(arguments)

    chain = Chain(options.folders)
    if not chain.runs:
        for text in chain.notes:
            print(f"make_report.py: {text}", file=sys.stderr)
        print("make_report.py: nothing to report; give at least one result folder", file=sys.stderr)
        return 2
    if options.surface_times and not any(has_surface_map(run) for run in chain.transient):
        print("make_report.py: --surface-times has no effect: no run has a map of a contact surface in 3D (Contact map/Interval)")
    text = build(chain, options.title or title_of(options.folders), os.path.dirname(os.path.abspath(options.output)),
                 options.surface_times).html()
    part = options.output + ".part"
    try:
        with open(part, "w", encoding="utf-8") as stream:
            stream.write(text)
        os.replace(part, options.output)
        if options.pictures:
            write_pictures(text, options.pictures)
    except OSError as error:
        print(f"make_report.py: cannot write {error.filename or options.output}: {error}", file=sys.stderr)
        return 2
    print(f"{options.output}: {len(chain.runs)} runs, {len(text) / 1e6:.1f} MB")
    for remark in chain.all_notes():
        print(f"note: {remark}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
