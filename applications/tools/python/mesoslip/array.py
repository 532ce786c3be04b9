"""numpy arrays that know their unit."""

import numpy as np

from .units import factor_to


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

    def __reduce__(self):
        return Array, (np.asarray(self), self.unit, self.name)

    def __repr__(self):
        return f"{np.array_repr(np.asarray(self)).replace('array(', 'Array(', 1)[:-1]}, unit={self.unit!r})"

    def __str__(self):
        return f"{np.asarray(self)} {self.unit}".rstrip()

    def to(self, unit):
        """Plain values in another unit of the same quantity, as to("MPa"), to("N/mm^2") or to("%").

        Raises ValueError unless `unit` is one."""
        try:
            factor = factor_to(self.unit, unit)
        except ValueError as error:
            raise ValueError(f"{self.name or 'the array'}: {error}") from None
        return np.asarray(self) * factor
