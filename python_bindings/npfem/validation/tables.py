# SPDX-License-Identifier: MPL-2.0
"""Tables that a run has written."""
import csv


def read_csv(path):
    """Columns by name, each a list of floats; of strings where a value is no number, NaN where it is empty."""
    with open(path, encoding="utf-8", newline="") as stream:
        rows = list(csv.reader(line for line in stream if not line.startswith("#")))
    columns = {}
    for index, name in enumerate(rows[0] if rows else []):
        cells = [row[index] for row in rows[1:]]
        try:
            columns[name] = [float(cell) if cell else float("nan") for cell in cells]
        except ValueError:
            columns[name] = cells
    return columns
