# SPDX-License-Identifier: MPL-2.0
"""Mass and momentum are kept to round-off, and a run has the same bits on any number of ranks and threads.

Conservation: random flow under random forces on every node, in a periodic box and between sliding plates; mass per node
must not change, and momentum must change by what forces and walls have given, to 1e-13 of the sum of all forces.

Same bits: a tube with red cells and a platelet, on 1, 2 and 4 ranks and on 2 threads. The state hash adds up the
bits of every population, position and velocity, so that one differing bit anywhere shows; the tables must be the same
to the last digit too. Known weakness: a run on one machine; another processor with the same instruction set is taken to
round alike.
"""
import os

from npfem.validation import Case, probe, run_scene, summary_of

CASE = Case(id="F4", title="Conservation, and the same bits on any ranks", tier="ci", cost_s=6, source="theory")

SCENE = """schema_version = 1
[domain]
kind = "tube"
diameter = "12 um"
length = "21 um"
dx = "0.5 um"
[fluid]
dynamic_viscosity = "1.2 mPa s"
time_step = "0.1 us"
[flow]
mean_velocity = "5 mm/s"
start = "developed"
[[cells]]
name = "rbc"
material = "rbc"
level = 2
count = 3
[[cells]]
name = "platelet"
material = "platelet"
level = 2
count = 1
[run]
steps = 20
"""


def run(report):
    """Sums first, then bits."""
    for walls, where in ((0, "periodic box"), (1, "sliding plates")):
        sums = probe(report, "fluid", "conservation", walls, 200)
        report.below("change of mass per node, %s" % where, sums["mass"], 1e-13)
        report.below("defect of momentum over the forces, %s" % where, sums["momentum"], 1e-13)

    def state(ranks, threads):
        folder = run_scene(report, "ranks_%d_threads_%d" % (ranks, threads), SCENE, ranks=ranks, threads=threads)
        tables = []
        for name in ("cells.csv", "rheology.csv"):
            with open(os.path.join(folder, name), encoding="utf-8") as stream:
                tables.append(stream.read())
        return summary_of(folder)["state_hash"], tables

    alone = state(1, 1)
    for ranks, threads in ((1, 2), (2, 1), (4, 1)):
        hash_of, tables = state(ranks, threads)
        report.below("differing state hash, %d ranks, %d threads each" % (ranks, threads), hash_of != alone[0], 0)
        report.below("differing tables, %d ranks, %d threads each" % (ranks, threads), tables != alone[1], 0)
