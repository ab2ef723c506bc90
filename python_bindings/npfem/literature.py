# SPDX-License-Identifier: MPL-2.0
"""What is known of the numbers of a healthy human red cell, and how `npfem fit` varies them."""
import collections
import math

# `scale`: base units of the library per `unit`. `band`: what measurements and their evaluations give, in `unit`, from
# `source`; None where there is nothing to compare with. `least`, `largest`: the search ends there. `start`: where a
# material has no value. `laws`: the words of `law_key` under which the parameter acts; None: always.
Known = collections.namedtuple("Known", "unit scale band source least largest start law_key laws")

PARAMETERS = {
    "shear_modulus": Known(
        "uN/m", 1.0, (2.4, 2.75),
        "of Skalak's law, from tweezers and ektacytometry: Dimitrakopoulos, Phys. Rev. E 85 (2012) 041917",
        0.2, 50.0, 3.0, "membrane_law", ("skalak", "neo_hookean", "yeoh", "wlc")),
    "skalak_C": Known(
        "", 1.0, None, "the bilayer keeps its area far better than any C in use; 1 to 100 are usual", 0.5, 200.0, 10.0,
        "membrane_law", ("skalak",)),
    "yeoh_c3": Known(
        "uN/m", 1.0, None, "Mills et al., Mech. Chem. Biosyst. 1 (2004) 169, chose G_s/30", 1e-3, 20.0, 0.2,
        "membrane_law", ("yeoh",)),
    "local_area_modulus": Known(
        "uN/m", 1.0, None, "a modulus of the model, not of the membrane", 1.0, 5000.0, 50.0, None, None),
    "bending_modulus": Known(
        "1e-19 J", 0.1, (2.0, 4.0),
        "micropipettes and flicker: from 1.8e-19 J, Evans, Biophys. J. 43 (1983) 27, to twice that since", 0.1, 50.0,
        3.0, "bending_law", ("dihedral", "juelicher", "cotangent")),
    "stress_free_reduced_volume": Known(
        "", 1.0, (0.95, 0.997),
        "shapes: Lim, Wortis & Mukhopadhyay, PNAS 99 (2002) 16766; motion in shear: Peng, Mashayekh & Zhu, "
        "J. Fluid Mech. 742 (2014) 96", 0.66, 0.999, 0.95, None, None),
    "membrane_shear_viscosity": Known(
        "uN s/m", 1e6, (0.3, 0.7), "recovery of stretched cells: Hochmuth, Worthy & Evans, Biophys. J. 26 (1979) 101",
        0.01, 10.0, 0.5, None, None),
}

FITTED_BY_RECOVERY = "membrane_shear_viscosity"


def band_of(key, law):
    """The band of a parameter (in its unit), or None; that of the shear modulus holds for Skalak's law alone."""
    return None if key == "shear_modulus" and law != "skalak" else PARAMETERS[key].band


def to_coordinate(key, value):
    """The coordinate in which a value (in its unit) is fitted: its logarithm; of a reduced volume, that of 1 - v."""
    return math.log(1.0 - value) if key == "stress_free_reduced_volume" else math.log(value)


def from_coordinate(key, coordinate):
    """The value (in its unit) at a coordinate."""
    return 1.0 - math.exp(coordinate) if key == "stress_free_reduced_volume" else math.exp(coordinate)


def coordinate_slope(key, value):
    """d coordinate / d ln value."""
    return -value / (1.0 - value) if key == "stress_free_reduced_volume" else 1.0
