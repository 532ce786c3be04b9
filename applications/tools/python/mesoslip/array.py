"""numpy arrays that know their unit."""

import numpy as np

PREFIXES = {"G": 1e9, "M": 1e6, "k": 1e3, "": 1.0, "m": 1e-3, "µ": 1e-6, "u": 1e-6, "n": 1e-9}


class Array(np.ndarray):
    """A numpy array with `unit` (SI, "" for pure numbers) and `name` (its place in the file).

    Indexing keeps the unit. Arithmetic returns plain numpy arrays: the unit of a result is not guessed.
    """

    def __new__(cls, values, unit="", name=""):
        array = np.asarray(values).view(cls)
        array.unit, array.name = unit, name
        return array

    def __array_finalize__(self, source):
        self.unit, self.name = getattr(source, "unit", ""), getattr(source, "name", "")

    def __array_ufunc__(self, ufunc, method, *inputs, **options):
        plain = [np.asarray(i) if isinstance(i, Array) else i for i in inputs]
        if options.get("out"):
            options["out"] = tuple(np.asarray(o) if isinstance(o, Array) else o for o in options["out"])
        return getattr(ufunc, method)(*plain, **options)

    def to(self, unit):
        """Plain values in another multiple of the unit, as to("MPa") or to("µm").

        Raises ValueError unless `unit` is a prefix before this array's own."""
        for prefix, factor in PREFIXES.items():
            if unit == prefix + self.unit:
                return np.asarray(self) / factor
        raise ValueError(f"{self.name or 'the array'} is in {self.unit or 'no unit'}, which is not a multiple of {unit}")
