"""Packs the module for pip (PEP 517 and 660): a wheel is a zip of these files and of what pyproject.toml says.

setuptools would need a network or packages of its own, and leaves build/ and mesoslip.egg-info among the sources."""

import base64
import hashlib
import os
import re
import zipfile

HERE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def _text(*names):
    with open(os.path.join(HERE, *names), encoding="utf-8") as file:
        return file.read()


def _metadata():
    """Name and version in file names, and the text METADATA."""
    project = _text("pyproject.toml")

    def value(key):
        return re.search(rf'^{key} = "(.*)"$', project, re.MULTILINE)[1]
    version = re.search(r'^__version__ = "(.*)"$', _text("mesoslip", "__init__.py"), re.MULTILINE)[1]
    needs = re.findall(r'"(.*?)"', re.search(r"^dependencies = \[(.*)\]$", project, re.MULTILINE)[1])
    lines = ["Metadata-Version: 2.1", f"Name: {value('name')}", f"Version: {version}", f"Summary: {value('description')}",
             f"Requires-Python: {value('requires-python')}", *(f"Requires-Dist: {need}" for need in needs)]
    return f"{value('name')}-{version}", "\n".join(lines) + "\n"


def _write(folder, files):
    """The wheel with {path: bytes} in `folder`; its name."""
    name, metadata = _metadata()
    info = f"{name}.dist-info/"
    files = {**files, info + "METADATA": metadata.encode(),
             info + "WHEEL": b"Wheel-Version: 1.0\nGenerator: mesoslip\nRoot-Is-Purelib: true\nTag: py3-none-any\n"}
    record = []
    wheel = f"{name}-py3-none-any.whl"
    with zipfile.ZipFile(os.path.join(folder, wheel), "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in files.items():
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record.append(f"{path},sha256={digest},{len(content)}\n")
            archive.writestr(path, content)
        archive.writestr(info + "RECORD", "".join(record) + f"{info}RECORD,,\n")
    return wheel


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """The module in a wheel."""
    names = sorted(name for name in os.listdir(os.path.join(HERE, "mesoslip")) if name.endswith(".py"))
    return _write(wheel_directory, {f"mesoslip/{name}": _text("mesoslip", name).encode() for name in names})


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    """A wheel that only names the folder of the sources."""
    return _write(wheel_directory, {"mesoslip.pth": f"{HERE}\n".encode()})
