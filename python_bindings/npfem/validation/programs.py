# SPDX-License-Identifier: MPL-2.0
"""The program, as a validation case uses it: a scene run into a folder, a probe that prints numbers."""
import json
import os
import shutil
import subprocess

from .scene_text import toml


class NotHere(Exception):
    """What a case needs is not in this installation."""


class RunFailed(Exception):
    """The program did not do what the case asked of it."""


def _program():
    named = os.environ.get("NPFEM_PROGRAM")
    found = named or shutil.which("npfem")
    if not found:
        raise NotHere("the program npfem is not on the PATH; name it in NPFEM_PROGRAM")
    return found


def _last_lines(text, count=5):
    return "\n".join(text.strip().splitlines()[-count:])


def run_program(report, *arguments):
    """Runs the program; returns what it prints. RunFailed where it ends with another exit code than 0."""
    report.say("%-4s npfem %s" % (report.case.id, " ".join(str(argument) for argument in arguments)))
    done = subprocess.run([_program()] + [str(argument) for argument in arguments], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        raise RunFailed("npfem %s ended with exit code %d: %s" % (arguments[0], done.returncode,
                                                                _last_lines(done.stderr)))
    return done.stdout


def _on_ranks(ranks):
    """What starts a program on several ranks."""
    found = os.environ.get("NPFEM_MPIEXEC") or shutil.which("mpiexec")
    if not found:
        raise NotHere("mpiexec is not on the PATH; name it in NPFEM_MPIEXEC")
    return [found, "-n", str(ranks), "--oversubscribe", "--bind-to", "none"]


def run_scene(report, name, scene, settings=(), accept=(0,), ranks=1, threads=None):
    """Runs a scene; returns its output folder.

    `scene`: its text, or its tables as a dictionary; files that it names lie in `report.folder`. `settings`: more lines
    for --set. `threads`: of each rank; few nodes are best left to one. A run that ends with an exit code not in
    `accept` raises RunFailed.
    """
    path = os.path.join(report.folder, name + ".toml")
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(scene if isinstance(scene, str) else toml(scene))
    folder = os.path.join(report.folder, name)
    command = [_program(), "run", path, "-o", folder, "--overwrite", "--quiet", "--json"]
    for setting in settings:
        command += ["--set", setting]
    if ranks > 1:
        command = _on_ranks(ranks) + command
    environment = dict(os.environ)
    if threads:
        environment["OMP_NUM_THREADS"] = str(threads)
    report.say("%-4s runs %s" % (report.case.id, name))
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False,
                          env=environment)
    if done.returncode not in accept:
        raise RunFailed("npfem run %s ended with exit code %d: %s" % (path, done.returncode, _last_lines(done.stderr)))
    if ranks > 1 and summary_of(folder)["ranks"] != ranks:
        raise NotHere("this npfem was built without MPI")
    return folder


def summary_of(folder):
    """The summary of a run."""
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as stream:
        return json.load(stream)


def probe(report, name, *arguments):
    """The JSON that the program `validate_<name>` prints, which is built with the tests and sees the fluid from inside.

    It lies beside the program, in ../libexec/npfem or on the PATH, and runs on one thread: what it computes is small.
    """
    beside = os.path.dirname(os.path.realpath(_program()))
    folders = [beside, os.path.normpath(os.path.join(beside, "..", "libexec", "npfem"))]
    path = shutil.which("validate_" + name, path=os.pathsep.join(folders + [os.environ.get("PATH", os.defpath)]))
    if not path:
        raise NotHere("validate_%s is not in %s and not on the PATH; it is built and installed with the tests "
                      "(-DNPFEM_TESTS=ON)" % (name, " or ".join(folders)))
    report.say("%-4s asks validate_%s %s" % (report.case.id, name, " ".join(str(a) for a in arguments)))
    done = subprocess.run([path] + [str(argument) for argument in arguments], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, check=False, env=dict(os.environ, OMP_NUM_THREADS="1"))
    if done.returncode != 0:
        raise RunFailed("%s ended with exit code %d: %s" % (path, done.returncode, _last_lines(done.stderr)))
    return json.loads(done.stdout)
