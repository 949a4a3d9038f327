"""Options of `wheatstone render` as keyword arguments: names, what they take and their help come from the library's rows."""

import difflib

import numpy as np

from . import _arguments, _wheatstone

_ROWS = {name: (takes, fallback, words) for name, takes, fallback, words in _wheatstone.option_rows()}


def words_of(function, options):
    """Options with their words, as the library takes them. None is an option that is not given."""
    given = [(name, _words_of_one(name, value)) for name, value in options.items()
             if value is not None and _known(function, name)]
    if "exposure" in options and options["exposure"] is not None and options.get("look") is None:
        given.append(("look", ["thesis"]))  # the only one that has an exposure
    return given


def help_text():
    """A line for each option."""
    lines = []
    for name, (takes, fallback, words) in _ROWS.items():
        about = ", ".join(part for part in (takes, f"default {fallback}" if fallback else "") if part)
        lines.append(f"    {name}{f' ({about})' if about else ''}: {words}")
    return "\n".join(lines)


def _known(function, name):
    if name in _ROWS:
        return True
    near = difflib.get_close_matches(name, _ROWS, 1)
    raise TypeError(f"{function}() got an unexpected keyword argument '{name}'"
                    + (f"; did you mean '{near[0]}'?" if near else f"; help(wheatstone.{function}) lists them"))


def _words_of_one(name, value):
    if name == "views":
        return [str(_arguments.whole(name, value))]
    if name in ("span", "zoom", "azimuth", "elevation", "exposure"):
        return [repr(_arguments.number(name, value))]
    if name == "size":
        return ["{}x{}".format(*_arguments.two_whole(name, value, "(width, height)"))]
    if isinstance(value, (bool, np.bool_)):
        return ["true" if value else "false"]
    if name == "depth_mapping" and not isinstance(value, str):
        return [",".join(":".join(_word(name, number) for number in pair) for pair in value)]
    if name == "type_colours" and isinstance(value, dict):
        return [",".join(f"{_arguments.text(name, kind)}={_arguments.text(name, colour)}" for kind, colour in value.items())]
    if isinstance(value, (tuple, list, np.ndarray)):
        return [",".join(_word(name, number) for number in value)]
    return [_word(name, value)]


def _word(name, value):
    if isinstance(value, str):
        return _arguments.text(name, value)
    if isinstance(value, (int, np.integer)) and not isinstance(value, bool):
        return str(int(value))
    return repr(_arguments.number(name, value))
