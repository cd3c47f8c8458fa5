#!/usr/bin/env python3
"""GEGL's blurs beside defray's qualities: time and PSNR against ray-traced truths, in one run.

perf/scripts/gegl.py DEFRAY [SCENES] [--update FILE]: SCENES holds folders with pinhole.exr, camera.json
and truth_SETTING.exr, as `defray scene` writes them; without it, two built-in scenes, small. --update
puts the table between FILE's markers "gegl.py". Needs GEGL (apt-get install gegl libgegl-dev), oiiotool
and a C compiler; without GEGL it says so and is done.

GEGL gets each pixel's true radius as its mask (share of the largest); both work on two threads,
with pictures in memory: the median of seven runs of GEGL, and of the last seven frames of eight.
"""
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

from table import Table, options

FRAMES = 8
QUALITIES = ["preview", "draft", "normal"]
# Each with its radius over the disc's: a Gaussian of a disc's variance has half of it.
BLURS = {"lens-blur": 1, "variable-blur": 0.5}


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{command[0]}: {done.stderr.strip()}")
    return done.stdout


def build(folder):
    flags = run("pkg-config", "--cflags", "--libs", "gegl-0.4").split()
    source = pathlib.Path(__file__).with_name("gegl_blur.c")
    run("cc", "-O2", source, "-o", folder / "gegl_blur", *flags)
    return folder / "gegl_blur"


class Case:
    """A scene with a focus setting."""

    def __init__(self, defray, scene, setting, folder):
        self.defray, self.folder = defray, folder
        self.truth = scene / f"truth_{setting}.exr"
        self.pinhole = scene / "pinhole.exr"
        self.lens = ["--camera", scene / "camera.json", "--focus-setting", setting]

    def psnr(self, picture):
        return json.loads(run(self.defray, "compare", picture, self.truth, "--json"))["psnr_srgb_db"]

    def by_defray(self, quality):
        for i in range(1, FRAMES + 1):
            shutil.copy(self.pinhole, self.folder / f"in.{i:04}.exr")
        lines = run(self.defray, "render", self.folder / "in.####.exr", "-o",
                    self.folder / "out.####.exr", *self.lens, "--quality", quality, "--no-overlap", "--json")
        seconds = [json.loads(line)["render_s"] for line in lines.splitlines()]
        return statistics.median(seconds[1:]), self.psnr(self.folder / "out.0001.exr")

    def by_gegl(self, blur, operation):
        radii = self.folder / "radius.exr"
        report = json.loads(run(self.defray, "render", self.pinhole, "-o", self.folder / "one.exr",
                                *self.lens, "--quality", "preview", "--coc-out", radii, "--json"))
        largest = max(abs(report[k]) for k in ("nearest_coc_px", "farthest_coc_px"))
        run("oiiotool", radii, "--abs", "--mulc", 1 / largest, "--ch", "0,0,0", "--chnames",
            "R,G,B", "-d", "float", "-o", self.folder / "mask.exr")
        run("oiiotool", self.pinhole, "--ch", "R,G,B,A=1.0", "-d", "float", "-o",
            self.folder / "colour.exr")
        out = self.folder / "gegl.exr"
        seconds = run(blur, f"gegl:{operation}", BLURS[operation] * largest, self.folder / "mask.exr",
                      self.folder / "colour.exr", out)
        return float(seconds), self.psnr(out)


def built_in(defray, folder):
    for scene in ["fence", "spheres"]:
        run(defray, "scene", scene, "-o", folder / scene, "--width", 320, "--height", 208,
            "--truth-samples", 64)
    return folder


def main():
    parser = options(__doc__)
    parser.add_argument("scenes", nargs="?", type=pathlib.Path)
    given = parser.parse_args()
    if not shutil.which("pkg-config") or subprocess.run(
            ["pkg-config", "--exists", "gegl-0.4"]).returncode:
        print("GEGL is not installed (apt-get install gegl libgegl-dev): nothing to compare with.")
        return
    os.environ["GEGL_THREADS"] = "2"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        table = compare(given.defray, given.scenes or built_in(given.defray, folder), folder)
    if given.update:
        table.update(given.update, "gegl.py")


def compare(defray, scenes, folder):
    truths = sorted(scenes.glob("*/truth_*.exr"))
    if not truths:
        sys.exit(f"{scenes}: no folder in it has a truth_SETTING.exr; 'defray scene' writes them")
    table = Table("case", *[f"GEGL {b}" for b in BLURS], *QUALITIES)
    blur = build(folder)
    for truth in truths:
        setting = truth.stem.removeprefix("truth_")
        case = Case(defray, truth.parent, setting, folder)
        cells = [case.by_gegl(blur, b) for b in BLURS] + [case.by_defray(q) for q in QUALITIES]
        table.row(f"{truth.parent.name} {setting}",
                  *[f"{1000 * s:.0f} ms, {db:.2f} dB" for s, db in cells])
    return table


if __name__ == "__main__":
    main()
