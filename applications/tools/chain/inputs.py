"""What the .prm files of a chain name, and the copies of it in the results folder."""

import os
import re
import shutil

SETTING = re.compile(r"\s*set\s[^=]*=(.*)", re.IGNORECASE)


class ChainError(Exception):
    """One sentence for the user."""


def values(prm):
    """All values that a .prm file sets; of those with commas each part as well."""
    with open(prm, encoding="utf-8-sig", errors="replace") as file:
        text = re.sub(r"\\\s*\n", " ", file.read())
    for line in text.splitlines():
        setting = SETTING.match(re.split(r"(?<!\\)#", line)[0].replace("\\#", "#"))
        if setting:
            parts = [part.strip() for part in setting[1].split(",")]
            yield from dict.fromkeys([setting[1].strip(), *parts])


def output_named(value, folder, names):
    """The one of `names` in whose output, in `folder`, the path `value` of a .prm file lies, or None."""
    first = os.path.relpath(os.path.join(folder, value), folder).split(os.sep)[0]
    return first if first in names else None


def input_files(prm, names):
    """Values of a .prm file that name files, but for those that the chain makes: in the outputs `names`."""
    folder = os.path.dirname(prm)
    return [value for value in values(prm)
            if os.path.isfile(os.path.join(folder, value)) and not output_named(value, folder, names)]


def copy_inputs(source, target):
    """Copies the files of a chain and those below that its .prm files name; returns the .prm files' names. What did not
    change keeps its time."""
    copied = sorted(n for n in os.listdir(source) if os.path.isfile(os.path.join(source, n)))
    chain = [n[:-4] for n in copied if n.endswith(".prm")]
    if os.path.realpath(source) == os.path.realpath(target):
        return chain
    for name in chain:
        for value in input_files(os.path.join(source, name + ".prm"), chain):
            if os.path.isabs(value):
                continue
            if os.path.normpath(value).startswith(os.pardir):
                raise ChainError(f"{name}.prm names {value}, outside of its folder, which is copied to {target}; put that file "
                                 "beside the .prm or below, or give its whole path")
            copied.append(value)
    try:
        for name in dict.fromkeys(copied):
            copy = os.path.join(target, name)
            os.makedirs(os.path.dirname(copy), exist_ok=True)
            shutil.copy2(os.path.join(source, name), copy)
    except OSError as error:
        raise ChainError(f"{error.filename2 or error.filename} cannot be written ({error.strerror}); choose another --output") from error
    return chain
