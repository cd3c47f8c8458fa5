#!/usr/bin/env python3
"""How fast defray is, beside how fast it wants to be: each goal with what was measured.

perf/scripts/goals.py DEFRAY [--quick] [--update FILE]: built-in scenes at 1920x1080 and 3840x2160;
--quick takes small ones, a rehearsal whose figures mean nothing; --update puts the table between FILE's
markers "goals.py". Medians of seven frames of a run, without its first, and
(largest - smallest) / median. What GEGL is faster or slower by: perf/scripts/gegl.py.
"""
import json
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

from table import Table, options



class Figure:
    """A median and its spread."""

    def __init__(self, values):
        self.median = statistics.median(values)
        self.spread = (max(values) - min(values)) / self.median

    def over(self, other):
        ratio = Figure([1])
        ratio.median = self.median / other.median
        ratio.spread = self.spread + other.spread
        return ratio


class Bench:
    def __init__(self, defray, folder, width, height, frames):
        self.defray, self.folder, self.frame_count = defray, folder, frames
        self.run("scene", "spheres", "-o", folder, "--width", width, "--height", height,
                 "--truth-samples", 1, "--focus-setting", "f2")
        for i in range(1, self.frame_count + 1):
            shutil.copy(folder / "pinhole.exr", folder / f"in.{i:04}.exr")
        report = json.loads(self.run(
            "render", folder / "pinhole.exr", "-o", folder / "one.exr", *self.camera(), "--literal",
            "--json"))
        largest = max(abs(report["nearest_coc_px"]), abs(report["farthest_coc_px"]))
        self.mm_a_pixel = report["aperture_diameter_mm"] / largest

    def run(self, *arguments):
        command = [str(a) for a in (self.defray, *arguments)]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            sys.exit(done.stderr.strip())
        return done.stdout

    def camera(self):
        return "--camera", self.folder / "camera.json", "--focus-setting", "f2"

    def frames(self, largest_px, *options):
        """Reports of a sequence whose largest CoC radius is so many pixels."""
        lines = self.run("render", self.folder / "in.####.exr", "-o", self.folder / "out.####.exr",
                         *self.camera(), "--aperture-diameter", self.mm_a_pixel * largest_px, "--json",
                         *options)
        return [json.loads(line) for line in lines.splitlines()][1:]

    def seconds(self, largest_px, *options):
        return Figure([f["render_s"] for f in self.frames(largest_px, "--no-overlap", *options)])

    def frame_of_sequence(self):
        """Seconds that each further frame takes, reading and writing beside it."""
        def seconds(frames):
            start = time.monotonic()
            self.run("render", self.folder / "in.####.exr", "-o", self.folder / "out.####.exr",
                     *self.camera(), "--aperture-diameter", self.mm_a_pixel * 32, "--quality",
                     "draft", "--frames", frames, "--quiet")
            return time.monotonic() - start

        return Figure([(seconds(f"1-{self.frame_count}") - seconds("1")) / (self.frame_count - 1) for _ in range(3)])

    def command(self, *options):
        """What a command of one frame takes beyond its filter."""
        beyond = []
        for _ in range(self.frame_count):
            start = time.monotonic()
            report = json.loads(self.run(
                "render", self.folder / "pinhole.exr", "-o", self.folder / "one.exr", *self.camera(),
                "--json", *options))
            beyond.append(time.monotonic() - start - report["render_s"])
        return Figure(beyond[1:])


class Goals:
    """The table's rows."""

    def __init__(self):
        self.table = Table("work", "measured", "goal", "")

    def row(self, work, figure, unit, goal, is_least=False):
        reached = figure.median >= goal if is_least else figure.median <= goal
        bound = "at least" if is_least else "at most"
        self.table.row(work, f"{figure.median:.3g}{unit} ± {100 * figure.spread:.0f} %",
                       f"{bound} {goal}{unit}", "reached" if reached else "falls short")


def measure(hd, uhd):
    goals = Goals()
    row = goals.row
    literal = ("--literal", "--rdb", 13)
    for radius, goal in [(8, 60), (32, 35), (128, 20)]:
        scatter = hd.seconds(radius, *literal, "--rays", "scatter")
        gather = hd.seconds(radius, *literal, "--rays", "gather")
        row(f"`--rays scatter` ÷ `gather`, radius {radius} px", scatter.over(gather), "", goal, True)
    for quality, least in [("normal", (0.15, 0.25)), ("draft", (0.07, 0.12)), ("high", (1.5, None))]:
        for radius, goal in zip((32, 128), least):
            if goal:
                figure = hd.seconds(radius, "--quality", quality)
                row(f"`--quality {quality}`, up to {radius} px", figure, " s", goal)
    ratio = uhd.seconds(64, "--quality", "normal").over(hd.seconds(32, "--quality", "normal"))
    row("3840×2160 ÷ 1920×1080, same relative blur", ratio, "", 4.2)
    row("whole command beyond the filter", hd.command("--quality", "draft"), " s", 0.25)
    parts = hd.frames(32, "--quality", "draft", "--no-overlap")
    longest = Figure([max(f["read_s"], f["render_s"], f["write_s"]) for f in parts])
    row("a sequence's frame ÷ its longest part", hd.frame_of_sequence().over(longest), "", 1.1)
    return goals.table


def main():
    parser = options(__doc__)
    parser.add_argument("--quick", action="store_true")
    given = parser.parse_args()
    small, frames = (8, 3) if given.quick else (1, 8)
    with tempfile.TemporaryDirectory() as name:
        hd, uhd = (pathlib.Path(name) / size for size in ("hd", "uhd"))
        table = measure(Bench(given.defray, hd, 1920 // small, 1080 // small, frames),
                        Bench(given.defray, uhd, 3840 // small, 2160 // small, frames))
    if given.update:
        table.update(given.update, "goals.py")


if __name__ == "__main__":
    main()
