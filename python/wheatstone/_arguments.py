"""Arguments as the library takes them. What is of another kind is a ValueError that names the argument; what a number may
be is said by the library."""

import numbers
import operator
import os

import numpy as np


def _refuse(name, value, expected):
    kind = type(value).__name__
    if isinstance(value, numbers.Number) and not isinstance(value, (bool, np.bool_)):
        said = f"{value!r}" if not isinstance(value, int) or abs(value) < 1e30 else "beyond all limits"
    elif isinstance(value, (str, bytes)) and len(value) < 40:
        said = ascii(value)
    elif isinstance(value, (tuple, list)) and len(value) < 5:
        said = f"a {kind} of {len(value)}"
    else:
        said = kind
    raise ValueError(f"{name} is {said}, expected {expected}") from None


def number(name, value):
    """A real number."""
    if isinstance(value, (str, bytes, bool, np.bool_)) or getattr(value, "ndim", 0) != 0:
        _refuse(name, value, "a number")
    try:
        return float(value)
    except (TypeError, ValueError):
        _refuse(name, value, "a number")
    except OverflowError:
        _refuse(name, value, "a smaller number")


def number_or_none(name, value):
    return None if value is None else number(name, value)


def whole(name, value, least=-(2**31), most=2**31 - 1):
    """A whole number that the library's own type holds."""
    expected = "a whole number" + (f" from {least} to {most}" if least == 0 else "")
    if isinstance(value, (bool, np.bool_)):
        _refuse(name, value, expected)
    try:
        given = operator.index(value)
    except TypeError:
        _refuse(name, value, expected)
    if not least <= given <= most:
        _refuse(name, given, expected if least == 0 else "a smaller whole number" if given > 0 else "a larger whole number")
    return given


def seed(value):
    return whole("seed", value, 0, 2**63 - 1)


def two_whole(name, value, expected):
    """Two whole numbers, as a width and a height."""
    try:
        first, second = value
    except (TypeError, ValueError):
        _refuse(name, value, expected)
    if isinstance(value, (str, bytes)):
        _refuse(name, value, expected)
    return whole(name, first), whole(name, second)


def flag(name, value):
    if not isinstance(value, (bool, np.bool_)):
        _refuse(name, value, "True or False")
    return bool(value)


def text(name, value):
    """Text that UTF-8 has, without NUL."""
    if not isinstance(value, str):
        _refuse(name, value, "text")
    if "\0" in value or not _is_unicode(value):
        _refuse(name, value, "text without NUL and single surrogates")
    return value


def _is_unicode(value):
    try:
        value.encode()
    except UnicodeEncodeError:
        return False
    return True


def path(name, value):
    """A file's name as the system has it, in bytes."""
    try:
        given = os.fsencode(value)
    except (TypeError, UnicodeEncodeError):
        _refuse(name, value, "the name of a file")
    if not given or b"\0" in given:
        _refuse(name, value, "the name of a file")
    return given
