# SPDX-License-Identifier: MPL-2.0
"""Where the numbers of a case come from: npfem, its commit, the machine."""
import os
import platform
import subprocess

from .._library import version


def machine():
    """Processor and number of cores."""
    name = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as stream:
            name = next((line.split(":", 1)[1].strip() for line in stream if line.startswith("model name")), name)
    except OSError:
        pass
    return "%s, %d cores" % (name, os.cpu_count() or 1)


def _git(*arguments):
    """What git says of the folder of this file; "" where there is no git or no checkout."""
    command = ("git", "--no-optional-locks", "-C", os.path.dirname(os.path.abspath(__file__))) + arguments
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=False)
    except OSError:
        return ""
    return done.stdout.strip() if done.returncode == 0 else ""


def commit():
    """NPFEM_COMMIT, which the program sets to the commit it was built from; else that of the checkout that this file
    belongs to, with "+" where tracked files differ from it; else ""."""
    named = os.environ.get("NPFEM_COMMIT", "")
    if named or not _git("ls-files", os.path.basename(__file__)):
        return named
    return _git("describe", "--always", "--dirty=+", "--exclude=*")


def origin():
    """What a record says of where it comes from."""
    return {"version": version(), "commit": commit(), "machine": machine()}
