# SPDX-License-Identifier: MPL-2.0
"""Arguments that several verbs take."""
import argparse

_LEVELS = "2, 3, 4 have 66, 258, 1026 vertices"


def _level(text):
    level = int(text)
    if level < 0:
        raise argparse.ArgumentTypeError("%d: no mesh has a negative level; %s" % (level, _LEVELS))
    return level


def add_level(verb):
    """--level; -1 where it is not given."""
    verb.add_argument("--level", type=_level, default=-1, metavar="LEVEL",
                      help="level of the mesh: %s (default: the material's own)" % _LEVELS)
