#!/usr/bin/env python3
"""Finds the weights of the model that predicts errors (host/prediction/error_model.cpp).

perf/scripts/fit_prediction.py prediction.csv [--half]: of `defray-perf experiment prediction`, a row a
render: what it is of, whether it sets the model or tests it, its true squared error, and the signs. --half:
every other scene alone sets the model, to see how it does on the rest.
"""
import csv
import sys

import numpy as np
from scipy.optimize import least_squares

NOTHING = 1e-9


def read(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    signs = np.array([[float(v) for v in row[3:]] for row in rows[1:]])
    true_db = 10 * np.log10(np.maximum([float(row[2]) for row in rows[1:]], 1e-7))
    return rows[0][3:], [row[0] for row in rows[1:]], np.array([row[1] == "set" for row in rows[1:]]), true_db, signs


def importance(true_db):
    """Errors that nobody sees, and pictures of nothing but highlights, count less."""
    return np.where(true_db < -50, 0.15, np.where(true_db < -46, 0.6, np.where(true_db > -24, 0.4, 1)))


def predict(model, signs):
    return model[-1] * 10 * np.log10(signs @ np.exp(model[:-1]) + NOTHING)


def fit(signs, true_db):
    """Logarithms of the weights, and the stretch: the best of some starts."""
    count = signs.shape[1]
    even = np.log(10 ** (true_db.mean() / 10) / (signs.mean(0) + 1e-12) / count)
    weights = importance(true_db)

    def off(model):
        return (predict(model, signs) - true_db) * weights

    best = None
    for seed in range(5):
        start = even + np.random.default_rng(seed).normal(0, 1, count)
        found = least_squares(off, np.append(start, 1.1), loss="soft_l1",
                              bounds=(np.append(start - 14, 0.8), np.append(start + 8, 1.5)))
        if best is None or found.cost < best.cost:
            best = found
    return best.x


def show(what, model, signs, true_db):
    if not len(true_db):
        return
    off = true_db - predict(model, signs)  # expected PSNR - true PSNR
    print(f"{what}: {len(off)} renders, expected - true: median {np.median(off):+.2f} dB, absolute "
          f"{np.median(abs(off)):.2f} dB, nine in ten within {np.quantile(abs(off), 0.9):.2f} dB, and from "
          f"{np.quantile(off, 0.05):+.2f} to {np.quantile(off, 0.95):+.2f} dB")


def main():
    if len(sys.argv) < 2 or sys.argv[2:] not in ([], ["--half"]):
        sys.exit(__doc__)
    names, renders, sets, true_db, signs = read(sys.argv[1])
    if sys.argv[2:]:
        scenes = sorted({r.split(",")[0] for r in renders})
        sets = sets & np.array([scenes.index(r.split(",")[0]) % 2 == 0 for r in renders])
    model = fit(signs[sets], true_db[sets])
    for name, weight in zip(names, np.exp(model[:-1])):
        print(f"{weight:10.4g}  {name}")
    print(f"{model[-1]:10.4g}  stretch")
    show("set", model, signs[sets], true_db[sets])
    show("test", model, signs[~sets], true_db[~sets])


if __name__ == "__main__":
    main()
