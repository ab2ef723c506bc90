# SPDX-License-Identifier: MPL-2.0
"""Measured stretching of healthy red cells by optical tweezers, and how far a computed curve is from it.

J. P. Mills, L. Qie, M. Dao, C. T. Lim, S. Suresh, "Nonlinear elastic and viscoelastic deformation of the human red
blood cell with optical tweezers", Mech. Chem. Biosyst. 1 (2004) 169-180: means over cells, read off the figure
(reading error about 1 %; spread between cells 9-15 % axial, 8-24 % transverse).
"""
import math

# force (pN), axial diameter (um), transverse diameter (um)
MILLS_2004 = (
    (0.0, 7.78, 7.78),
    (16.0, 9.21, 6.73),
    (20.0, 9.64, 6.48),
    (31.0, 9.99, 6.11),
    (38.5, 10.88, 5.97),
    (47.5, 11.39, 5.47),
    (67.6, 12.31, 4.96),
    (88.0, 13.07, 4.78),
    (109.0, 13.64, 4.52),
    (130.0, 14.10, 4.46),
    (150.7, 14.54, 4.46),
    (172.7, 14.83, 4.52),
    (193.0, 15.29, 4.27),
)


def loaded_forces(largest_pN):
    """The measured forces above 0 and up to `largest_pN`."""
    return [force for force, _, _ in MILLS_2004 if 0.0 < force <= largest_pN]


def rms_errors(rows, points=MILLS_2004):
    """(axial, transverse, points): rms relative departure from the measurement, over the rows at measured forces > 0.

    None where no usable row stands at a measured force; nothing is interpolated.
    """
    by_force = {row["force_pN"]: row for row in rows if row["axial_um"] is not None}
    pairs = [(by_force[force], axial, transverse) for force, axial, transverse in points
             if force > 0 and force in by_force]
    if not pairs:
        return None
    axial = math.sqrt(sum((row["axial_um"] / measured - 1.0) ** 2 for row, measured, _ in pairs) / len(pairs))
    transverse = math.sqrt(sum((row["transverse_um"] / measured - 1.0) ** 2 for row, _, measured in pairs)
                           / len(pairs))
    return axial, transverse, len(pairs)
