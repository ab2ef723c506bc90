# SPDX-License-Identifier: MPL-2.0
"""Writing files so that none is ever half-written."""
import json
import os


def require_writable(path):
    """Raises OSError, naming the path, where a file could not be written there: before work is spent on it."""
    folder = os.path.dirname(os.path.abspath(path))
    if not os.path.isdir(folder):
        raise OSError("cannot write %s: there is no folder %s" % (path, folder))
    if os.path.isdir(path):
        raise OSError("cannot write %s: it is a folder" % path)
    if not os.access(path if os.path.exists(path) else folder, os.W_OK):
        raise OSError("cannot write %s: no permission" % path)


def require_writable_folder(path):
    """The same for a folder, which need not be there yet."""
    present = os.path.abspath(path)
    while not os.path.lexists(present):
        present = os.path.dirname(present)
    if not os.path.isdir(present):
        raise OSError("cannot write into %s: %s is not a folder" % (path, present))
    if not os.access(present, os.W_OK | os.X_OK):
        raise OSError("cannot write into %s: no permission for %s" % (path, present))


def require_png(path):
    """The same for a picture, which must be named .png."""
    if not path.endswith(".png"):
        raise ValueError("--plot %s: a name that ends in .png is needed" % path)
    require_writable(path)


def write_aside(path, write):
    """Calls write(other path with the same ending), then gives that file its name."""
    root, ending = os.path.splitext(path)
    aside = "%s.%d%s" % (root, os.getpid(), ending)
    try:
        write(aside)
        os.replace(aside, path)
    finally:
        if os.path.exists(aside):
            os.remove(aside)


def write_json(path, document):
    """Writes numbers for other programs, and says so."""
    def write(aside):
        with open(aside, "w", encoding="utf-8") as stream:
            json.dump(document, stream, indent=2)
            stream.write("\n")

    write_aside(path, write)
    print("wrote %s" % path)
