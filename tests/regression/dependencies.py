"""A topic of lib/ includes only topics below it, and lib/CMakeLists.txt says the same."""

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
    print("\n".join(sorted(set(problems))))
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
