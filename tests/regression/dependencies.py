"""A topic of lib/ includes only topics below it, and lib/CMakeLists.txt says the same. Ranks exchange whole objects."""

import os
import re
import sys

TOP = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")

# From below; io serves all and knows none.
ALLOWED = {
    "material": set(),
    "grid": {"material"},
    "io": set(),
    "microstructure": {"material", "grid", "io"},
    "elasticity": {"material", "grid"},
    "homogenization": {"material", "grid", "microstructure", "elasticity", "io"},
    "contact": {"material", "grid", "elasticity", "io"},
    "dynamics": {"material", "grid", "elasticity", "contact", "io"},
    "observation": {"material", "grid", "elasticity", "contact", "dynamics", "io"},
    "localization": {"material", "grid", "elasticity", "homogenization", "contact", "dynamics", "observation", "io"},
    "simulation": {"material", "grid", "elasticity", "homogenization", "contact", "dynamics", "observation", "io"},
}


# Rows of fields, and what objects are sent with: everything else goes through io/exchange.h, so that no member of an object
# is left behind.
SEND = {"io/collective.cc", "io/outcome.cc", "elasticity/row_partition.cc", "elasticity/message_channel.cc",
        "homogenization/load_cases.cc"}


def sends(path):
    with open(path, encoding="utf-8") as file:
        return re.findall(r"\bMPI_(?:I?[bsr]?send|I?recv|Sendrecv|I?bcast|I?gatherv?|I?scatterv?|I?allgatherv?)\b", file.read(), re.IGNORECASE)


def includes(path):
    with open(path, encoding="utf-8") as file:
        return re.findall(r'^#\s*include\s+"([a-z_]+)/', file.read(), re.MULTILINE)


def main():
    lib, problems = os.path.join(TOP, "lib"), []
    topics = [name for name in os.listdir(lib) if os.path.isdir(os.path.join(lib, name))]
    problems += [f"lib/{t}: not in the order of topics" for t in topics if t not in ALLOWED]
    for topic in ALLOWED:
        for folder, _, files in os.walk(os.path.join(lib, topic)):
            for name in files:
                if name.endswith((".h", ".cc")):
                    path = os.path.join(folder, name)
                    problems += [f"{os.path.relpath(path, TOP)} includes {used}/" for used in includes(path)
                                 if used in ALLOWED and used != topic and used not in ALLOWED[topic]]
                    if os.path.relpath(path, lib) not in SEND:
                        problems += [f"{os.path.relpath(path, TOP)} calls {call}: use io/exchange.h" for call in sends(path)]
    print("\n".join(sorted(set(problems))))
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
