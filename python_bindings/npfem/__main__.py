# SPDX-License-Identifier: MPL-2.0
"""The verbs of the program that live in Python: stretch, relax, fit, preview, report; also `python -m npfem ...`.

Exit codes: 0 done, 1 failed, 2 bad input or a missing Python module, 130 interrupted.
"""
import argparse
import sys

from . import fit_verb, preview_verb, relax_verb, report_verb, stretch_verb
from ._library import Error

OK, FAILED, BAD_INPUT, INTERRUPTED = 0, 1, 2, 130

_DEBIAN_PACKAGES = {"numpy": "python3-numpy", "matplotlib": "python3-matplotlib"}

# Of npfem.h: statuses that bad input leads to.
_BAD_INPUT_STATUSES = ("NPFEM_ERROR_ARGUMENT", "NPFEM_ERROR_INPUT", "NPFEM_ERROR_NAME", "NPFEM_ERROR_IO")


def parser():
    """The command line: one sub-command per verb."""
    top = argparse.ArgumentParser(prog="npfem", description="Deformable blood cells: tools written in Python.")
    verbs = top.add_subparsers(dest="verb", metavar="verb", required=True)
    for verb in (stretch_verb, relax_verb, fit_verb, preview_verb, report_verb):
        verb.add_to(verbs)
    return top


def main(arguments=None):
    """Runs one verb; returns its exit code."""
    chosen = parser().parse_args(arguments)
    try:
        return chosen.run(chosen)
    except Error as error:
        print("npfem %s: %s" % (chosen.verb, error), file=sys.stderr)
        return BAD_INPUT if error.name in _BAD_INPUT_STATUSES else FAILED
    except (OSError, ValueError) as error:
        print("npfem %s: %s" % (chosen.verb, error), file=sys.stderr)
        return BAD_INPUT
    except ModuleNotFoundError as error:
        package = _DEBIAN_PACKAGES.get((error.name or "").split(".")[0])
        print("npfem %s: %s for %s%s" % (chosen.verb, error, sys.executable,
                                         "; Debian and Ubuntu have it as " + package if package else ""),
              file=sys.stderr)
        return BAD_INPUT
    except (ImportError, ArithmeticError) as error:
        print("npfem %s: %s" % (chosen.verb, error), file=sys.stderr)
        return FAILED
    except KeyboardInterrupt:
        # Files are written aside and renamed, so none is left half-written.
        print("npfem %s: interrupted" % chosen.verb, file=sys.stderr)
        return INTERRUPTED


if __name__ == "__main__":
    sys.exit(main())
