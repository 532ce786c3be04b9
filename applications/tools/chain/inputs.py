"""What the .prm files of a chain name, and the copies of it in the results folder."""

import glob
import hashlib
import json
import os
import re
import shutil

SETTING = re.compile(r"\s*set\s([^=]*)=(.*)", re.IGNORECASE)
INCLUDE = re.compile(r"\s*include\s+(.*)", re.IGNORECASE)
RECORD = ".chain"  # in the results folder: where its files come from, and as what they were copied


class ChainError(Exception):
    """One sentence for the user."""


def digest_of(path):
    """SHA-256 of a file, as text."""
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        while piece := file.read(1 << 20):
            digest.update(piece)
    return digest.hexdigest()


def state_of(path):
    """[bytes, time in ns, SHA-256] of a file."""
    found = os.stat(path)
    return [found.st_size, found.st_mtime_ns, digest_of(path)]


def is_unchanged(path, size, time, digest):
    """Copies may have another time: then the content decides."""
    found = os.stat(path)
    return found.st_size == size and (found.st_mtime_ns == time or digest_of(path) == digest)


def settings(prm, including=()):
    """(key, value) of each line of a .prm file that sets one, and ("include", file) of one that includes a file, with what that sets."""
    with open(prm, encoding="utf-8-sig", errors="replace") as file:
        text = re.sub(r"\\\s*\n", " ", file.read())
    for line in text.splitlines():
        line = re.split(r"(?<!\\)#", line)[0].replace("\\#", "#")
        if setting := SETTING.match(line):
            yield setting[1].strip(), setting[2].strip()
        elif include := INCLUDE.match(line):
            name = include[1].strip()
            yield "include", name
            other = os.path.normpath(os.path.join(os.path.dirname(prm), name))
            if os.path.isfile(other) and other not in including:
                for key, value in settings(other, (*including, prm, other)):
                    yield key, value
                    if os.path.dirname(name):  # paths are relative to the file that names them
                        yield key, os.path.normpath(os.path.join(os.path.dirname(name), value))


def values(prm):
    """All values that a .prm file sets but the folder of its output; of those with commas each part as well."""
    for key, value in settings(prm):
        if key.lower() != "output folder":
            yield from dict.fromkeys([value, *(part.strip() for part in value.split(","))])


def output_named(value, folder, names):
    """The one of `names` in whose output, in `folder`, the path `value` of a .prm file lies, or None."""
    first = os.path.relpath(os.path.join(folder, value), folder).split(os.sep)[0]
    return first if first in names else None


def files_behind(value, folder):
    """The files that a path in a .prm file of `folder` names: one, those in a folder (a stack of pictures, the results of a run), or
    those of a pattern. As long as the value, absolute or not."""
    path = os.path.join(folder, value)
    if os.path.isfile(path):
        return [value]
    if value and os.path.isdir(path) and os.path.commonpath([os.path.realpath(folder), os.path.realpath(path)]) != os.path.realpath(path):
        found = [os.path.join(path, name) for name in sorted(os.listdir(path))]
    else:
        found = sorted(glob.glob(path)) if glob.has_magic(value) else []
    files = [name for name in found if os.path.isfile(name)]
    return files if os.path.isabs(value) else [os.path.relpath(name, folder) for name in files]


def input_files(prm, names):
    """Files that a .prm file names, but for those that the chain makes: in the outputs `names`."""
    folder = os.path.dirname(prm)
    return [file for value in values(prm) if not output_named(value, folder, names) for file in files_behind(value, folder)]


def list_inputs(source):
    """Names of the steps of the chain in the folder `source`, and of the files that its results folder needs: the .prm files and what
    they name beside them or below."""
    if not os.path.isdir(source):
        raise ChainError(f"there is no folder {source}")
    chain = sorted(n[:-4] for n in os.listdir(source) if n.endswith(".prm") and os.path.isfile(os.path.join(source, n)))
    if not chain:
        raise ChainError(f"no .prm file in {source}")
    files = [name + ".prm" for name in chain]
    for name in chain:
        for value in input_files(os.path.join(source, name + ".prm"), chain):
            if os.path.isabs(value):
                continue
            if os.path.normpath(value).startswith(os.pardir):
                raise ChainError(f"{name}.prm names {value}, outside of its folder, of which the results folder gets a copy; put that file "
                                 "beside the .prm or below, or give its whole path")
            files.append(os.path.normpath(value))
    return chain, list(dict.fromkeys(files))


def read_record(target):
    """{"source": folder, "copies": {name: state_of() it}}; empty where no chain has run."""
    try:
        with open(os.path.join(target, RECORD), encoding="utf-8") as file:
            record = json.load(file)
        return {"source": str(record["source"]), "copies": dict(record["copies"])}
    except (OSError, ValueError, KeyError, TypeError):
        return {"source": "", "copies": {}}


def are_equal(one, other):
    return os.path.isfile(other) and is_unchanged(other, *state_of(one))


def check_target(source, target, files):
    """Refuses what would overwrite the results of another folder, or a file that somebody has changed in the results folder."""
    source, record = os.path.realpath(source), read_record(target)
    if source == os.path.realpath(target):
        return
    # One that was moved has another name, and a copy of it may differ in nothing.
    if os.path.isdir(record["source"]) and record["source"] != source and not (
            set(files) == set(record["copies"]) and all(are_equal(os.path.join(source, n), os.path.join(target, n)) for n in files)):
        raise ChainError(f"{target} holds the results of {record['source']}; choose another --output, or remove that folder")
    for name in files:
        copy = os.path.join(target, name)
        known = record["copies"].get(name)
        if os.path.isfile(copy) and not (known and is_unchanged(copy, *known)) and not are_equal(os.path.join(source, name), copy):
            raise ChainError(f"{copy} is not as it was copied from {source} and would be overwritten; take over there what was changed, "
                             "then remove it, or choose another --output")


def copy_inputs(source, target, files):
    """Copies the `files` of a chain after check_target(). What did not change keeps its time."""
    if os.path.realpath(source) == os.path.realpath(target):
        return
    before = read_record(target)
    owner = before["source"] if os.path.isdir(before["source"]) else os.path.realpath(source)
    try:
        for name in files:
            copy = os.path.join(target, name)
            os.makedirs(os.path.dirname(copy), exist_ok=True)
            shutil.copy2(os.path.join(source, name), copy)
        with open(os.path.join(target, RECORD), "w", encoding="utf-8") as file:
            json.dump({"source": owner, "copies": {name: state_of(os.path.join(target, name)) for name in files}}, file)
    except OSError as error:
        raise ChainError(f"{error.filename2 or error.filename} cannot be written ({error.strerror}); choose another --output") from error
