"""A topic of lib/ includes only topics below it that its library is linked with, and few headers include what takes long to compile. No folder has more than 25 files, no
file more than 350 lines. Ranks exchange whole objects. The drawing of the topics is that of the sources."""

import os
import re
import sys

import architecture
from architecture import includes
from scenes import TOP

# From below: a topic includes only topics that stand before it. Another project links what it uses alone.
ORDER, LINKED = [], {}
with open(os.path.join(TOP, "lib", "CMakeLists.txt"), encoding="utf-8") as lists:
    for library, more in re.findall(r"^mesoslip_library\((\w+)([^)]*)\)", lists.read(), re.MULTILINE):
        below = re.findall(r"\bmesoslip_(\w+)", more)
        ORDER.append(library)
        LINKED[library] = {library, *below}.union(*(LINKED[name] for name in below))
# Further borders: the physics knows neither programs nor files; the last two meet in exchange alone.
NEVER = {"grid": {"parameters", "io", "program"}, "elasticity": {"parameters", "io", "program"}, "statics": {"parameters", "io", "program"},
         "body": {"parameters", "io", "program"}, "dynamics": {"io", "program"}, "contact": {"io", "program"}, "eigenvalues": {"io", "program"},
         "material": {"base", "parameters", "io", "program"}, "sliding": {"localization"}}
MOST_FILES, MOST_LINES = 25, 350  # in a folder, in a file


# Rows of fields, and what objects are sent with: everything else goes through base/exchange.h, so that no member of an object
# is left behind.
SEND = {"base/exchange.cc", "elasticity/brick/plane_exchange.cc", "statics/voxel/planes.cc", "grid/row_partition.cc", "grid/halo.cc", "mesh/shared_points.cc", "dynamics/mesh_surface.cc",
        "homogenization/load_cases.cc"}


# Headers of lib/ that may include what takes GCC seconds, as all who include them read it again; everywhere else it belongs into sources.
# deal.II's base (point.h, tensor.h and the like) is in mesh/mesh.h and precompiled.
HEAVY = {
    "deal.II/": {"mesh/linear_cell.h", "mesh/mesh.h", "mesh/triangulation_cells.h", "body/mesh/cell_values.h",
                 "body/mesh/curved_mapping.h", "body/mesh/distributed_matrix.h", "body/mesh/distributed_mesh.h",
                 "eigenvalues/free_dofs.h", "homogenization/volumes/mesh_volume.h", "localization/strain/cell_set.h"},
    "boost/": {"base/archives.h", "base/object_exchange.h"},
    "nlohmann/json.hpp": {"io/json.h", "sliding/analyses/friction_homogenization.h"},
}


def heavy(name, path):
    """What the header `name` includes although it may not."""
    with open(path, encoding="utf-8") as file:
        included = re.findall(r"^#\s*include <([^>]+)>", file.read(), re.MULTILINE)
    return [header for header in included for start, allowed in HEAVY.items() if header.startswith(start) and name not in allowed]


# The only files that know which release of deal.II there is, Trilinos and PETSc: a port begins there.
ONLY_IN = {r"DEAL_II_VERSION\w*": {"body/mesh/distributed_mesh.cc"},
           r"#include <(?:deal.II/lac/trilinos|Epetra|ml_|ML_|Teuchos|MueLu|Amesos)\w*[./]": {"body/mesh/algebra_ml.cc"},
           r"#include <(?:deal.II/lac/petsc|petsc)\w*[./]": {"body/mesh/algebra_gamg.cc"}}


def only_in(name, path):
    """What the file `name` asks or includes although another one does so for all."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    return [found[0] for words, allowed in ONLY_IN.items() if name not in allowed and (found := re.findall(words, text))]


def sends(path):
    with open(path, encoding="utf-8") as file:
        return re.findall(r"\bMPI_(?:I?[bsr]?send|I?recv|Sendrecv|I?bcast|I?gatherv?|I?scatterv?|I?allgatherv?)\b", file.read(), re.IGNORECASE)


def of_file(topic, path, lib):
    """What is wrong with a file of a topic."""
    name = os.path.relpath(path, lib)
    forbidden = set(ORDER[ORDER.index(topic) + 1:]) | NEVER.get(topic, set())
    problems = [f"lib/{name} includes {used}/" for used in includes(path) if used in forbidden]
    problems += [f"lib/{name} includes {used}/, with which lib/CMakeLists.txt does not link mesoslip_{topic}" for used in includes(path)
                 if used in ORDER and used not in LINKED[topic]]
    problems += [f"lib/{name} has {words}: see ONLY_IN in dependencies.py" for words in only_in(name, path)]
    if name not in SEND:
        problems += [f"lib/{name} calls {call}: use base/exchange.h" for call in sends(path)]
    if name.endswith(".h"):
        problems += [f"lib/{name} includes {header}: in a source, or see HEAVY in dependencies.py" for header in heavy(name, path)]
    with open(path, encoding="utf-8") as file:
        n_lines = sum(1 for _ in file)
    return problems + ([f"lib/{name} has {n_lines} lines"] if n_lines > MOST_LINES else [])


def main():
    lib, problems = os.path.join(TOP, "lib"), []
    for topic in sorted(name for name in os.listdir(lib) if os.path.isdir(os.path.join(lib, name))):
        if topic not in ORDER:
            problems.append(f"lib/{topic}: not in the order of topics")
            continue
        for folder, _, files in os.walk(os.path.join(lib, topic)):
            sources = [os.path.join(folder, name) for name in sorted(files) if name.endswith((".h", ".cc"))]
            if len(sources) > MOST_FILES:
                problems.append(f"{os.path.relpath(folder, TOP)} has {len(sources)} files")
            for path in sources:
                problems += of_file(topic, path, lib)
    if not architecture.is_drawn():
        problems.append("doc/architecture.svg is not that of the sources: PYTHONPATH=tests/scenes tests/system/pages/architecture.py draws it")
    print("\n".join(sorted(set(problems))))
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
