"""Units as they stand in the files, "W/m^2" or "kg/m^3", and multiples of them."""

import re

PREFIXES = {"G": 1e9, "M": 1e6, "k": 1e3, "c": 1e-2, "m": 1e-3, "µ": 1e-6, "μ": 1e-6, "u": 1e-6, "n": 1e-9, "": 1.0}
# Powers of m, kg, s and a factor.
SYMBOLS = {"m": (1, 0, 0, 1.0), "g": (0, 1, 0, 1e-3), "s": (0, 0, 1, 1.0), "N": (1, 1, -2, 1.0), "Pa": (-1, 1, -2, 1.0),
           "J": (2, 1, -2, 1.0), "W": (2, 1, -3, 1.0), "Hz": (0, 0, -1, 1.0), "%": (0, 0, 0, 1e-2), "1": (0, 0, 0, 1.0),
           "-": (0, 0, 0, 1.0)}
FACTOR = re.compile(r"(?P<symbol>[^\W\d]+|%|1|-)(?:\^?(?P<power>[-+]?\d+))?$")


def parse(unit):
    """Powers of m, kg and s, and the factor to these, of a unit such as "N/mm^2", "Pa s" or "kg/m^3".

    Raises ValueError for a unit that is not made of N, Pa, J, W, Hz, m, g, s, % and prefixes from G to n."""
    powers, factor = [0, 0, 0], 1.0
    for k, part in enumerate(unit.strip().split("/")):
        for word in re.split(r"[\s*·]+", part.strip()) if part.strip() else ():
            found = FACTOR.match(word)
            prefix, symbol = split_prefix(found["symbol"] if found else word)
            power = int(found["power"] or 1) * (1 if k == 0 else -1)
            *own, scale = SYMBOLS[symbol]
            powers = [p + power * o for p, o in zip(powers, own)]
            factor *= (PREFIXES[prefix] * scale) ** power
    return tuple(powers), factor


def split_prefix(word):
    """("M", "Pa") of "MPa"; a symbol itself goes before a prefix. Raises ValueError."""
    if word in SYMBOLS:
        return "", word
    if word[:1] in PREFIXES and word[1:] in SYMBOLS and word[1:].isalpha():
        return word[0], word[1:]
    raise ValueError(f"'{word}' is not a unit that this module knows; it knows {', '.join(SYMBOLS)} and the prefixes "
                     f"{', '.join(p for p in PREFIXES if p)}")


def factor_to(unit, other):
    """By what a number in `unit` is multiplied to be in `other`. Raises ValueError unless both measure the same."""
    own, factor = parse(unit)
    wanted, divisor = parse(other)
    if own != wanted:
        raise ValueError(f"{unit or 'a pure number'} is not a multiple of {other}")
    return factor / divisor
