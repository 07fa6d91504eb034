#!/usr/bin/env python3
"""Writes the synthetic curves of the meters in this folder. Formulas only, no measured data.

    python3 sensors/make_curves.py            # writes the folders class-l, class-a, class-b, class-c, silicon, trap, par, uv, directional-phi
    python3 sensors/make_curves.py --check    # fails if a file is not what this script writes

class-b/responsivity.csv     s(λ) = V(600 + (λ − 600 + 1)/1.03) + 0.01 exp(−½((λ − 447)/19)²) + 0.005 exp(−½((λ − 700)/18)²)
                             a V(λ) stretched by 3 % about 600 nm and shifted by 1 nm, with leaks in the blue and in the red
class-b/directional.csv      R(θ) = 1 + 0.025 sin²(2θ) − 0.16 (θ/90°)⁶
class-l, class-a, class-c    silicon behind layers of absorbing glass (`GLASS`), and R(θ) = 1 + a sin²(2θ) − b (θ/90°)⁶ (`DIFFUSER`)
silicon/responsivity.csv     s(λ) = λ/(hc/e) (1 − 0.3) exp(−α d) (1 − exp(−α w)), d = 10 nm dead layer, w = 200 µm; α(λ) of silicon at 300 K by
                             K. Rajkanan, R. Singh, J. Shewchun, Solid-State Electronics 22 (1979) 793
trap/responsivity.csv        three such photodiodes that reflect onto each other: of the light 0.3⁵ leaves after five reflections, so that
                             s(λ) = λ/(hc/e) (1 − 0.3⁵) exp(−α d) (1 − exp(−α w)); the internal quantum deficiency is that of one
par/responsivity.csv         the same silicon behind a glass that makes it count photons, with edges at 402 nm and 698 nm
uv/erythema.csv              ISO/CIE 17166: 1 to 298 nm, 10^(0.094 (298 − λ)) to 328 nm, 10^(0.015 (140 − λ)) to 400 nm
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
HC_EV_NM = 1239.841984


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


def absorption_per_cm(nm, kelvin=300.0):
    """Silicon; Rajkanan, Singh and Shewchun 1979: two indirect gaps with two phonons each, one direct gap."""
    k_ev, ev = 8.617333262e-5, HC_EV_NM / nm
    shift = 7.021e-4 * kelvin**2 / (kelvin + 1108)
    total = 0.0
    for gap, a in ((1.1557, 3.231e2), (2.5, 7.237e3)):
        for phonon, c in ((1.827e-2, 5.5), (5.773e-2, 4.0)):
            absorbed, emitted = ev - gap + shift + phonon, ev - gap + shift - phonon
            x = phonon / k_ev / kelvin
            total += c * a * max(absorbed, 0.0) ** 2 / math.expm1(x) - c * a * max(emitted, 0.0) ** 2 / math.expm1(-x)
    return total + 1.052e6 * math.sqrt(max(ev - 3.2 + shift, 0.0))


def silicon_a_w(nm):
    """Photodiode of silicon: 30 % reflected, 10 nm dead, 200 µm deep."""
    alpha = absorption_per_cm(nm)
    return nm / HC_EV_NM * 0.7 * math.exp(-alpha * 1e-6) * -math.expm1(-alpha * 0.02)


def trap_a_w(nm):
    """Trap detector: five reflections at photodiodes as above, so that 0.3⁵ = 0.24 % of the light is lost."""
    return silicon_a_w(nm) / (1 - 0.3) * (1 - 0.3**5)


def glass(nm, long_pass, short_pass, bands=(), leak=0.0):
    """Edges exp(−exp(∓(λ − edge)/width)), absorption bands exp(−depth · bell), and what the short-pass lets through beyond 850 nm."""
    through = math.exp(-math.exp(-(nm - long_pass[0]) / long_pass[1]))
    through *= math.exp(-math.exp(min((nm - short_pass[0]) / short_pass[1], 50)))
    for depth, centre, sigma in bands:
        through *= math.exp(-depth * bell(nm, centre, sigma))
    return through + leak * math.exp(-math.exp(-(nm - 850) / 20))


# Layers of the lux meters, nm: edges chosen for the least f1' with 4 layers (L), too thin bands (A), edges 8 nm and 3 nm off and a leak (C).
GLASS = {
    "l": {"long_pass": (528.3, 55.9), "short_pass": (580.1, 60.3), "bands": ((0.67, 482.4, 19.4), (0.52, 686.8, 72.6))},
    "a": {"long_pass": (528.3, 55.9), "short_pass": (580.1, 60.3), "bands": ((0.536, 482.4, 19.4), (0.416, 686.8, 72.6))},
    "c": {"long_pass": (516.4, 39.8), "short_pass": (563.6, 68.3), "leak": 8e-4},
}
# a and b of R(θ).
DIFFUSER = {"l": (0.008, 0.06), "a": (0.015, 0.10), "c": (0.05, 0.40)}


def par_responsivity(nm):
    """Photons, per W: λ, between soft edges; the glass takes the silicon out."""
    return nm / 700 / (1 + math.exp(-(nm - 402) / 3)) / (1 + math.exp((nm - 698) / 3))


def erythema(nm):
    return 1.0 if nm <= 298 else 10 ** (0.094 * (298 - nm)) if nm <= 328 else 10 ** (0.015 * (140 - nm))


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


    factor = {"kind": "factor", "unit": "1", "wavelength_unit": "nm (in air)", "interpolation": "linear", "outside": "zero"}
    relative = {"quantity": "relative spectral responsivity", **factor}

    def spectral(name, source, step, rows, more=None):
        head = {"name": name, **relative, "range": f"{min(rows):g}-{max(rows):g}", "step": f"{step:g}", "source": source, **(more or {})}
        return text(head, ["wavelength_nm,s"] + [f"{nm:g},{s:g}" for nm, s in rows.items()])

    nms = [float(nm) for nm in range(300, 1151, 5)]
    detector = "SYNTHETIC, no measured device: silicon by the absorption of Rajkanan, Singh and Shewchun 1979, 30 % reflected, 10 nm dead, 200 µm"
    bare = {nm: float(f"{silicon_a_w(nm):.6g}") for nm in nms}
    a_w = {"quantity": "spectral responsivity", **factor, "unit": "A/W"}
    yield "silicon/responsivity.csv", text(
        {"name": "Synthetic silicon photodiode", **a_w, "range": "300-1150", "step": "5", "source": detector, "f1_prime": f"{100 * f1_prime(bare):.2f} %"},
        ["wavelength_nm,s"] + [f"{nm:g},{s:g}" for nm, s in bare.items()],
    )
    trap = {nm: float(f"{trap_a_w(nm):.6g}") for nm in nms}
    yield "trap/responsivity.csv", text(
        {
            "name": "Synthetic trap detector of silicon photodiodes",
            **a_w,
            "range": "300-1150",
            "step": "5",
            "source": detector.replace("30 % reflected", "five reflections of 30 %: 0.24 % lost"),
        },
        ["wavelength_nm,s"] + [f"{nm:g},{s:g}" for nm, s in trap.items()],
    )
    for letter, layers in GLASS.items():
        raw = {nm: silicon_a_w(nm) * glass(nm, **layers) for nm in nms}
        peak = max(raw.values())
        curve = {nm: float(f"{s / peak:.6f}") for nm, s in raw.items()}
        words = "; ".join(f"{key} {value}" for key, value in layers.items())
        yield f"class-{letter}/responsivity.csv", spectral(
            f"Synthetic class {letter.upper()} luminous responsivity",
            f"{detector}; behind layers of glass as make_curves.py has them: {words}",
            5,
            curve,
            {"f1_prime": f"{100 * f1_prime(curve):.2f} %"},
        )
        a, b = DIFFUSER[letter]

        def diffuser(theta_deg, a=a, b=b):
            return 1 + a * math.sin(math.radians(2 * theta_deg)) ** 2 - b * (theta_deg / 90) ** 6

        yield f"class-{letter}/directional.csv", text(
            {
                "name": f"Synthetic class {letter.upper()} directional response",
                "quantity": "directional response relative to the cosine, R(θ)",
                **angles,
                "range": "0-90",
                "step": f"{STEP_DEG}",
                "source": f"SYNTHETIC, no measured device: R(θ) = 1 + {a} sin²(2θ) − {b} (θ/90°)⁶",
                "f2": f"{100 * f2(diffuser):.2f} %",
            },
            ["theta_deg,R"] + [f"{t:g},{diffuser(t):.6g}" for t in thetas],
        )
    yield "par/responsivity.csv", spectral(
        "Synthetic PAR quantum responsivity",
        "SYNTHETIC, no measured device: λ/700 nm between edges at 402 nm and 698 nm that are 3 nm wide",
        2,
        {float(nm): float(f"{par_responsivity(nm):.6f}") for nm in range(370, 751, 2)},
    )
    yield "uv/erythema.csv", spectral(
        "Erythema action spectrum",
        "formula of ISO/CIE 17166, 10^(0.015 (140 − λ)) above 328 nm; not checked against the text",
        1,
        {float(nm): float(f"{erythema(nm):.6g}") for nm in range(250, 401)},
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
