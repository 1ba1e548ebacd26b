"""Reads every file of a copy of the refractiveindex.info database with `gonio material` and, on its own,
with PyYAML and SciPy (formulas written out anew, PCHIP between rows), and compares.

    python tools/check_refractiveindex.py GONIO DATABASE/data

Needs pyyaml and scipy. Prints how many files answer, which are refused and why, and the largest relative
differences.
"""

import glob
import json
import math
import subprocess
import sys

import numpy as np
import yaml
from scipy.interpolate import PchipInterpolator

G, DATA = sys.argv[1], sys.argv[2]


def form(k, c, um):
    c = list(c) + [0] * 20
    l2 = um * um
    P = lambda i: [(c[j], c[j + 1]) for j in range(i, len(c) - 1, 2) if c[j] != 0]
    if k == 1:
        return math.sqrt(1 + c[0] + sum(b * l2 / (l2 - x * x) for b, x in P(1)))
    if k == 2:
        return math.sqrt(1 + c[0] + sum(b * l2 / (l2 - x) for b, x in P(1)))
    if k == 3:
        return math.sqrt(c[0] + sum(b * um**p for b, p in P(1)))
    if k == 4:
        s = c[0]
        for i in (1, 5):
            if c[i]:
                s += c[i] * um ** c[i + 1] / (l2 - c[i + 2] ** c[i + 3])
        return math.sqrt(s + sum(b * um**p for b, p in P(9)))
    if k == 5:
        return c[0] + sum(b * um**p for b, p in P(1))
    if k == 6:
        return 1 + c[0] + sum(b / (x - 1 / l2) for b, x in P(1))
    if k == 7:
        L = 1 / (l2 - 0.028)
        return c[0] + c[1] * L + c[2] * L * L + c[3] * l2 + c[4] * l2**2 + c[5] * l2**3
    if k == 8:
        q = c[0] + c[1] * l2 / (l2 - c[2]) + c[3] * l2
        return math.sqrt((1 + 2 * q) / (1 - q))
    if k == 9:
        return math.sqrt(c[0] + c[1] / (l2 - c[2]) + c[3] * (um - c[4]) / ((um - c[4]) ** 2 + c[5]))


def rows(text):
    return [[float(x) for x in r.split()] for r in str(text).splitlines() if r.strip()]


def merged(r, j):
    d = {}
    for row in r:
        d.setdefault(row[0], []).append(row[j])
    x = sorted(d)
    return np.array(x), np.array([sum(d[v]) / len(d[v]) for v in x])


done = bad = 0
worst = []
ref = []
nofile = 0
for f in sorted(glob.glob(f"{DATA}/**/*.yml", recursive=True)):
    if f.endswith("about.yml"):
        continue
    y = yaml.load(open(f), Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    types = [str(d["type"]) for d in y["DATA"]]
    if all(t.endswith("n2") for t in types):
        nofile += 1
        continue
    n = k = None
    try:
        for d in y["DATA"]:
            t = d["type"].split()
            if t[0] == "formula" and n is None:
                cc = [float(x) for x in str(d["coefficients"]).split()]
                kk = int(t[1])
                n = lambda um, kk=kk, cc=cc: form(kk, cc, um)
            elif t[0] == "tabulated":
                r = rows(d["data"])
                mk = lambda x, v: (
                    PchipInterpolator(x, v) if len(x) > 1 else (lambda um, v=v: v[0])
                )
                if "n" in t[1] and t[1] != "n2" and n is None:
                    n = mk(*merged(r, 1))
                if "k" in t[1] and k is None:
                    x, v = merged(r, 2 if t[1] == "nk" else 1)
                    k = mk(x, np.maximum(v, 0) if v.min() > -0.2 else v)
    except Exception as e:
        ref.append((f, "py " + repr(e)))
        continue
    p = subprocess.run([G, "material", f, "--json"], capture_output=True, text=True)
    if p.returncode:
        ref.append((f, p.stderr.strip()[-120:]))
        continue
    o = json.loads(p.stdout)
    done += 1
    for i, nm in enumerate(o["wavelength_nm"][::4]):
        i *= 4
        e = 0
        try:
            if o["n"] is not None:
                e = abs(o["n"][i] / float(n(nm / 1e3)) - 1)
            if k is not None and o["k"][i] > 0:
                e = max(e, abs(o["k"][i] - float(k(nm / 1e3))) / max(o["k"][i], 1e-12))
        except Exception as x:
            e = float("inf")
        worst.append((e, f.split("data/")[-1], nm, o["n"] and o["n"][i], o["k"][i]))
worst = [(9e9 if w[0] != w[0] else w[0],) + w[1:] for w in worst]
worst.sort(key=lambda w: -w[0])
print("answered", done, "n2 only", nofile, "refused", len(ref))
print(*ref, sep="\n")
print("values", len(worst), "above 1e-9:", sum(w[0] > 1e-9 for w in worst))
print(*worst[:15], sep="\n")
