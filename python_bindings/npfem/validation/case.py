# SPDX-License-Identifier: MPL-2.0
"""A validation case, and what it reports: numbers beside their references, curves beside measured points."""
import dataclasses
import math

# From quick to slow; a tier holds the quicker ones too.
TIERS = ("ci", "nightly", "release")


@dataclasses.dataclass(frozen=True)
class Case:
    """What a case is. The reason for each tolerance stands in its file.

    `id`: its number in the list of cases (S1, C1, ...); `title`: a line; `tier`: one of TIERS; `source`: where the
    reference comes from; `cost_s`: seconds on two cores, roughly.
    """
    id: str
    title: str
    tier: str
    source: str
    cost_s: float

    def __post_init__(self):
        if self.tier not in TIERS:
            raise ValueError('case %s: tier "%s" is not known; allowed: %s' % (self.id, self.tier, ", ".join(TIERS)))


@dataclasses.dataclass
class Result:
    """One number of a case.

    `error`: what is compared with `tolerance`: relative to the reference where `relative`, else in the unit.
    `verdict`: "pass"; "fail"; "known": fails, and the cause in `known_failure` was named beforehand; "mended": was to
    fail and does not; "measured": has no reference.
    """
    quantity: str
    ours: float
    unit: str = ""
    reference: float = None
    error: float = None
    tolerance: float = None
    relative: bool = False
    known_failure: str = ""
    verdict: str = "measured"

    @property
    def good(self):
        """Whether a test may pass with it: a failure that was not named and one that is gone may not."""
        return self.verdict in ("pass", "known", "measured")


class Report:
    """What one run of a case has found. `folder`: where the case may write."""

    def __init__(self, case, folder, say=lambda line: None):
        self.case = case
        self.folder = folder
        self.say = say
        self.results = []
        self.plots = []

    def compare(self, quantity, ours, reference, relative=None, absolute=None, unit="", known_failure=""):
        """Our number beside the reference, within `relative` of it or within `absolute` (in `unit`).

        `known_failure`: the suspected cause, where the case is known to miss its tolerance. It then counts as a failure
        of the case only when it no longer does, so that the mark is taken away.
        """
        if (relative is None) == (absolute is None):
            raise ValueError('%s, "%s": give one of relative and absolute' % (self.case.id, quantity))
        ours, reference = float(ours), float(reference)
        tolerance = absolute if relative is None else relative
        error = ours - reference if relative is None else ours / reference - 1.0
        return self._judge(Result(quantity, ours, unit, reference, error, tolerance, relative is not None,
                                  known_failure), math.isfinite(error) and abs(error) <= tolerance)

    def below(self, quantity, ours, limit, unit="", known_failure=""):
        """Our number, an error by itself, whose size must not exceed `limit`."""
        ours = float(ours)
        return self._judge(Result(quantity, ours, unit, 0.0, ours, limit, False, known_failure),
                           math.isfinite(ours) and abs(ours) <= limit)

    def within(self, quantity, ours, low, high, unit="", known_failure=""):
        """Our number beside a band; the reference is its middle, the tolerance half its width."""
        return self.compare(quantity, ours, 0.5 * (low + high), absolute=0.5 * (high - low), unit=unit,
                            known_failure=known_failure)

    def measured(self, quantity, ours, unit=""):
        """Our number where there is no reference to hold it against."""
        self.results.append(Result(quantity, float(ours), unit))
        self._tell(self.results[-1])

    def plot(self, title, x_label, y_label, **options):
        """A new plot for the page; `options`: x_log, y_log."""
        self.plots.append({"title": title, "x": x_label, "y": y_label, "curves": [], **options})
        return self.plots[-1]

    @staticmethod
    def curve(plot, label, x, y, points=False, band=None):
        """A line of ours, or points somebody measured, with half the width of their scatter in `band`."""
        plot["curves"].append({"label": label, "x": [float(v) for v in x], "y": [float(v) for v in y],
                               "points": bool(points), "band": None if band is None else [float(v) for v in band]})

    def _judge(self, result, inside):
        if result.known_failure:
            result.verdict = "mended" if inside else "known"
        else:
            result.verdict = "pass" if inside else "fail"
        self.results.append(result)
        self._tell(result)
        return result

    def _tell(self, result):
        self.say("%-4s %-8s %s: %s" % (self.case.id, result.verdict, result.quantity, describe(result)))


def describe(result):
    """"11.30 um, reference 11.39 um, error -0.8 % (3 % allowed)"."""
    unit = " " + result.unit if result.unit else ""
    text = "%.5g%s" % (result.ours, unit)
    if result.verdict == "measured":
        return text
    if result.relative:
        text += ", reference %.5g%s, error %+.2g %% (%.3g %% allowed)" % (result.reference, unit, 100 * result.error,
                                                                         100 * result.tolerance)
    elif result.reference:
        text += ", reference %.5g%s, error %+.2g%s (%.3g allowed)" % (result.reference, unit, result.error, unit,
                                                                     result.tolerance)
    else:
        text += " (%.3g allowed)" % result.tolerance
    return text + ("; known: " + result.known_failure if result.known_failure else "")
