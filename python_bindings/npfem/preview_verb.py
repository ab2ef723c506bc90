# SPDX-License-Identifier: MPL-2.0
"""`npfem preview DIR`: a picture of a run."""
import os

from ._files import require_writable, write_aside


def add_to(verbs):
    """Adds the verb to the command line."""
    verb = verbs.add_parser("preview", help="draw a picture of a run",
                            description="Draws the cells in their vessel, and a cut along the flow, from the output "
                                        "folder of a run. Needs numpy and matplotlib, no display.")
    verb.add_argument("folder", metavar="DIR", help="output folder of a run")
    verb.add_argument("-o", "--output", metavar="FILE.png", help="picture to write (default: DIR/preview.png)")
    verb.add_argument("--instant", type=int, default=-1, metavar="N",
                      help="which of the instants written, from 0; negative: from the end (default: -1, the last)")
    verb.set_defaults(run=run)


def run(options):
    """Draws the picture; returns the exit code."""
    from .render import render

    if not os.path.isdir(options.folder):
        raise OSError("%s is not a folder: the output folder of a run is needed" % options.folder)
    path = options.output or os.path.join(options.folder, "preview.png")
    require_writable(path)
    write_aside(path, lambda aside: render(options.folder, aside, options.instant))
    print("wrote %s" % path)
    return 0
