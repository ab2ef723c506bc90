# SPDX-License-Identifier: MPL-2.0
"""Measurements that `npfem fit` fits: named ones, and CSV files of a user."""
import csv
import math

from . import recovery, tweezers_data

STRETCHING_COLUMNS = ("force_pN", "axial_um", "transverse_um")
RECOVERY_COLUMNS = ("time_s", "length_over_width")
_RANGES = {"force_pN": (0.0, 1000.0), "axial_um": (1.0, 50.0), "transverse_um": (0.5, 50.0), "time_s": (0.0, 100.0),
           "length_over_width": (1.0, 10.0)}


def _numbers(path, columns):
    """Rows of a CSV file as tuples of the columns asked for; lines that start with # are skipped."""
    try:
        return _rows(path, columns)
    except (UnicodeDecodeError, csv.Error) as error:
        raise ValueError("%s is no CSV file in UTF-8: %s" % (path, error)) from None


def _rows(path, columns):
    with open(path, encoding="utf-8", newline="") as stream:
        lines = [(number, line) for number, line in enumerate(stream, 1) if line.strip() and not line.startswith("#")]
    reader = csv.reader(line for _, line in lines)
    header = [name.strip() for name in next(reader, [])]
    missing = [column for column in columns if column not in header]
    if missing:
        raise ValueError("%s: no column %s; needed are %s (the unit is part of the name), found: %s"
                         % (path, " and ".join(missing), ", ".join(columns), ", ".join(header) or "an empty file"))
    rows = []
    for (number, _), cells in zip(lines[1:], reader):
        row = []
        for column in columns:
            text = cells[header.index(column)] if header.index(column) < len(cells) else ""
            least, largest = _RANGES[column]
            try:
                value = float(text)
            except ValueError:
                value = math.nan
            if not least <= value <= largest:
                raise ValueError('%s, line %d: %s is "%s"; a number from %g to %g is needed'
                                 % (path, number, column, text.strip(), least, largest))
            row.append(value)
        rows.append(tuple(row))
    return rows


def stretching(name):
    """[(force_pN, axial_um, transverse_um)] of "mills2004" or a CSV file, loaded points only.

    The size without load is left out: it is that of the cell, which the mesh of the material states.
    """
    if name == "mills2004":
        rows = tweezers_data.MILLS_2004
    elif name.endswith(".csv"):
        rows = _numbers(name, STRETCHING_COLUMNS)
    else:
        raise ValueError('--data "%s": mills2004 or a file that ends in .csv is needed' % name)
    loaded = [tuple(row) for row in rows if row[0] > 0.0]
    if not loaded:
        raise ValueError("%s: no point with a force above 0" % name)
    return loaded


def recovery_time(name):
    """(t_c in s, cells it is the mean of) of "hochmuth1979" or of a CSV file with the recovery of one cell."""
    if name == "hochmuth1979":
        return recovery.HOCHMUTH_1979_TIME_S, 4
    if not name.endswith(".csv"):
        raise ValueError('--relaxation "%s": hochmuth1979 or a file that ends in .csv is needed' % name)
    rows = _numbers(name, RECOVERY_COLUMNS)
    times, ratios = [row[0] for row in rows], [row[1] for row in rows]
    if len(rows) < 4 or any(after <= before for before, after in zip(times, times[1:])):
        raise ValueError("%s: at least 4 points at rising times are needed" % name)
    if ratios[0] < 1.1 * min(ratios):
        raise ValueError("%s: the first point must be the most stretched; length over width begins at %g and is %g at "
                         "least" % (name, ratios[0], min(ratios)))
    return recovery.fit_with_end(times, ratios)[0], 1
