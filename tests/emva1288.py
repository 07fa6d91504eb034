#!/usr/bin/env python3
"""The package emva1288 judges frames that `etendue photon-transfer` wrote.

usage: emva1288.py DESCRIPTOR FIGURES TRUTH

DESCRIPTOR is the data set, FIGURES what etendue measured from the same frames (JSON), TRUTH what was put in (JSON): the pixel, and the
photons a second. The package knows nothing of either. Tolerances are standard uncertainties of what the package measures, from the number
of pixels and levels: four of them are allowed. Its saturation is read off the levels, which are a step apart.

Prints a line a quantity and how many were compared; exit code 1 if one is outside.
"""

import json
import logging
import sys
import warnings

import numpy as np

warnings.filterwarnings("ignore")
if not hasattr(np, "asfarray"):
    np.asfarray = lambda a, dtype=float: np.asarray(a, dtype=dtype)  # gone with NumPy 2; the package asks for it

logging.disable(logging.CRITICAL)

from emva1288.process import Emva1288  # noqa: E402

ALLOWED_U = 4.0

descriptor, figures, truth = sys.argv[1:]
measured = json.load(open(figures))["figures"]
put_in = json.load(open(truth))
package = Emva1288(descriptor)._results

failures, count = 0, 0


def compare(what, found, expected, u):
    global failures, count
    deviation = (found - expected) / u
    count += 1
    bad = not abs(deviation) <= ALLOWED_U
    failures += bad
    print(f"{'BAD ' if bad else ''}{what}: {found:.6g}, expected {expected:.6g}, u {u:.2g}: {deviation:+.2f} u")


def u(key):
    return measured[key]["standard_uncertainty"]


# The package against what was put in.
compare("K / (DN/e)", package.K, put_in["gain_dn_per_e"], u("gain_dn_per_e"))
compare("QE", package.QE / 100, put_in["quantum_efficiency"], u("quantum_efficiency"))
compare("R / (DN/photon)", package.R, put_in["gain_dn_per_e"] * put_in["quantum_efficiency"], u("responsivity_dn_per_photon"))
compare("sigma_d / e", package.sigma_d, put_in["read_noise_e"], u("dark_noise_e"))
compare("dark current / (e/s)", package.u_I_mean, put_in["dark_current_e_s"], u("dark_current_e_s"))
compare("DSNU / e", package.DSNU1288, put_in["dsnu_e"], u("dsnu_e"))
compare("PRNU", package.PRNU1288 / 100, put_in["prnu"], u("prnu"))
compare("saturation / e", package.u_e_sat, put_in["saturation_e"], u("saturation_e"))

# The package against etendue: the same frames and the same definitions, so far closer than the uncertainty.
SAME = 1e-6
for what, found, key in [
    ("K", package.K, "gain_dn_per_e"),
    ("R", package.R, "responsivity_dn_per_photon"),
    ("QE", package.QE / 100, "quantum_efficiency"),
    ("sigma_y.dark", package.sigma_y_dark, "dark_noise_dn"),
    ("sigma_d", package.sigma_d, "dark_noise_e"),
    ("dark current", package.u_I_mean, "dark_current_e_s"),
    ("DSNU", package.DSNU1288, "dsnu_e"),
    ("PRNU", package.PRNU1288 / 100, "prnu"),
    ("LE_min", package.LE_min / 100, "linearity_error_min"),
    ("LE_max", package.LE_max / 100, "linearity_error_max"),
]:
    expected = measured[key]["value"]
    compare(f"{what}, of etendue", found, expected, SAME / ALLOWED_U * max(abs(expected), 1e-3))

print(f"{count} quantities compared, {failures} outside")
sys.exit(failures > 0)
