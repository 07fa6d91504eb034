#!/usr/bin/env python3
"""Writes the synthetic curves of the meters in this folder. Formulas only, no measured data.

    python3 sensors/make_curves.py            # writes class-b/*.csv and directional-phi/response.csv
    python3 sensors/make_curves.py --check    # fails if a file is not what this script writes

class-b/responsivity.csv     s(λ) = V(600 + (λ − 600 + 1)/1.03) + 0.01 exp(−½((λ − 447)/19)²) + 0.005 exp(−½((λ − 700)/18)²)
                             a V(λ) stretched by 3 % about 600 nm and shifted by 1 nm, with leaks in the blue and in the red
class-b/directional.csv      R(θ) = 1 + 0.025 sin²(2θ) − 0.16 (θ/90°)⁶
directional-phi/response.csv R(θ, φ) = (1 + 0.05 (θ/90°) cos φ − 0.02 (θ/90°)² cos 2φ) (1 − 0.1 (θ/90°)⁴)

The quality indices that go into the headers are those of ISO/CIE 19476:2014:

    f1' = ∫|s* − V| dλ / ∫V dλ,  s* = s ∫S_A V dλ / ∫S_A s dλ        f2 = ∫₀^80° |R(θ) − 1| sin 2θ dθ
"""

import hashlib
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
LICENCE = "MIT OR Apache-2.0"
STEP_DEG = 2.5


def v_lambda():
    """V(λ) at 360, 361, …, 830 nm."""
    rows = [r for r in (HERE.parent / "data" / "v_lambda_1nm.csv").read_text().splitlines() if r and not r.startswith("#")][1:]
    return {float(a): float(b) for a, b in (r.split(",")[:2] for r in rows)}


V = v_lambda()


def v_at(nm):
    low = math.floor(nm)
    a, b = V.get(float(low), 0.0), V.get(float(low + 1), 0.0)
    return a + (nm - low) * (b - a)


def illuminant_a(nm):
    """CIE 015:2018, formula of illuminant A."""
    return (560 / nm) ** 5 * math.expm1(1.435e7 / (2848 * 560)) / math.expm1(1.435e7 / (2848 * nm))


def bell(nm, centre, sigma):
    return math.exp(-0.5 * ((nm - centre) / sigma) ** 2)


def responsivity(nm):
    ends = min(1.0, (nm - 380) / 5, (780 - nm) / 5)
    return ends * (v_at(600 + (nm - 600 + 1) / 1.03) + 0.01 * bell(nm, 447, 19) + 0.005 * bell(nm, 700, 18))


def f1_prime(curve):
    """At 1 nm, the curve linear between its rows."""
    nodes = sorted(curve)

    def s(nm):
        if nm <= nodes[0] or nm >= nodes[-1]:
            return curve.get(nm, 0.0)
        i = next(k for k in range(1, len(nodes)) if nodes[k] >= nm)
        share = (nm - nodes[i - 1]) / (nodes[i] - nodes[i - 1])
        return (1 - share) * curve[nodes[i - 1]] + share * curve[nodes[i]]

    grid = sorted(V)
    values = {nm: s(nm) for nm in grid}
    scale = sum(illuminant_a(nm) * V[nm] for nm in grid) / sum(illuminant_a(nm) * values[nm] for nm in grid)
    return sum(abs(scale * values[nm] - V[nm]) for nm in grid) / sum(V.values())


def directional(theta_deg):
    x = theta_deg / 90
    return 1 + 0.025 * math.sin(math.radians(2 * theta_deg)) ** 2 - 0.16 * x**6


def directional_phi(theta_deg, phi_deg):
    x, phi = theta_deg / 90, math.radians(phi_deg)
    return (1 + 0.05 * x * math.cos(phi) - 0.02 * x * x * math.cos(2 * phi)) * (1 - 0.1 * x**4)


def f2(response, n=8000):
    """Midpoint rule; linear between rows."""
    total, step = 0.0, math.radians(80) / n
    for k in range(n):
        theta = (k + 0.5) * step
        x = math.degrees(theta) / STEP_DEG
        i = int(x)
        r = (1 - x + i) * response(STEP_DEG * i) + (x - i) * response(STEP_DEG * (i + 1))
        total += abs(r - 1) * math.sin(2 * theta) * step
    return total


def text(header, rows):
    body = "\n".join(rows) + "\n"
    header = header | {"licence": LICENCE, "prepared_by": "sensors/make_curves.py", "sha256": hashlib.sha256(body.encode()).hexdigest()}
    return "".join(f"# {key}: {value}\n" for key, value in header.items()) + body


def files():
    curve = {float(nm): round(responsivity(nm), 6) for nm in range(380, 781, 5)}
    thetas = [STEP_DEG * k for k in range(37)]
    phis = [0, 45, 90, 135, 180, 225, 270, 315]
    angles = {"theta_unit": "degree, from the normal of the aperture", "unit": "1", "interpolation": "linear in θ (and φ)"}
    yield "class-b/responsivity.csv", text(
        {
            "name": "Synthetic class B luminous responsivity",
            "kind": "factor",
            "quantity": "relative spectral responsivity",
            "unit": "1",
            "wavelength_unit": "nm (in air)",
            "range": "380-780",
            "step": "5",
            "interpolation": "linear",
            "outside": "zero",
            "source": "SYNTHETIC, no measured device: V(λ) stretched by 3 % about 600 nm and shifted by 1 nm, leaks at 447 nm (1 %) and 700 nm (0.5 %)",
            "f1_prime": f"{100 * f1_prime(curve):.2f} %",
        },
        ["wavelength_nm,s"] + [f"{nm:g},{s:g}" for nm, s in curve.items()],
    )
    yield "class-b/directional.csv", text(
        {
            "name": "Synthetic class B directional response",
            "quantity": "directional response relative to the cosine, R(θ)",
            **angles,
            "range": "0-90",
            "step": f"{STEP_DEG}",
            "source": "SYNTHETIC, no measured device: R(θ) = 1 + 0.025 sin²(2θ) − 0.16 (θ/90°)⁶",
            "f2": f"{100 * f2(directional):.2f} %",
        },
        ["theta_deg,R"] + [f"{t:g},{directional(t):.6g}" for t in thetas],
    )
    yield "directional-phi/response.csv", text(
        {
            "name": "Synthetic directional response of a tilted diffuser",
            "quantity": "directional response relative to the cosine, R(θ, φ)",
            **angles,
            "phi_unit": "degree, from the x axis of the sensor towards its y axis; periodic",
            "range": "θ 0-90, φ 0-315",
            "step": f"θ {STEP_DEG}, φ 45",
            "source": "SYNTHETIC, no measured device: R = (1 + 0.05 x cos φ − 0.02 x² cos 2φ)(1 − 0.1 x⁴) with x = θ/90°",
        },
        ["theta_deg," + ",".join(map(str, phis))] + [f"{t:g}," + ",".join(f"{directional_phi(t, p):.6g}" for p in phis) for t in thetas],
    )


def main():
    wrong = []
    for name, content in files():
        path = HERE / name
        if "--check" in sys.argv:
            if not path.exists() or path.read_text() != content:
                wrong.append(name)
        else:
            path.parent.mkdir(exist_ok=True)
            path.write_text(content)
    if wrong:
        sys.exit(f"not what the script writes: {', '.join(wrong)}")


main()
