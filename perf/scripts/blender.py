#!/usr/bin/env python3
"""Cycles' own depth of field beside defray's: PSNR, three frames, a wide frame and an upright one.

perf/scripts/blender.py DEFRAY [--quick] [--update FILE]: the commands of cli/README.md on
tests/command/render/blender_scene.py; --quick takes one small size, a rehearsal whose figures mean
nothing; --update puts the table between FILE's markers "blender.py". Needs Blender (apt-get install
blender); without it it says so and is done.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

from table import Table, options

PROJECT = pathlib.Path(__file__).resolve().parents[2]
SCENE = PROJECT / "tests/command/render/blender_scene.py"
CAMERA = PROJECT / "cli/blender/defray_camera.py"


def run(folder, *command):
    # Blender takes relative names from PWD.
    done = subprocess.run([str(c) for c in command], cwd=folder, env={**os.environ, "PWD": folder},
                          capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{command[0]}: {done.stderr.strip() or done.stdout.strip()}")
    return done.stdout


def psnrs(defray, folder, width, height):
    """Of each frame: the pinhole picture's, and defray's."""
    blender = ["blender", "-noaudio", "-b"]
    run(folder, *blender, "--factory-startup", "-P", SCENE, "--", "scene.blend", width, height)
    run(folder, *blender, "scene.blend", "-P", CAMERA, "--", "-o", "shot", "--render")
    run(folder, *blender, "scene.blend", "-P", SCENE, "--", "truth", "shot")
    run(folder, defray, "render", "shot/####.exr", "-o", "shot/lens.####.exr", "--camera",
        "shot/camera.####.json")

    def psnr(picture, frame):
        return json.loads(run(folder, defray, "compare", f"shot/{picture}{frame:04}.exr",
                              f"shot/truth.{frame:04}.exr", "--json"))["psnr_srgb_db"]

    return [(psnr("", frame), psnr("lens.", frame)) for frame in (1, 2, 3)]


def main():
    parser = options(__doc__)
    parser.add_argument("--quick", action="store_true")
    given = parser.parse_args()
    if not shutil.which("blender"):
        print("Blender is not installed (apt-get install blender): nothing to compare with.")
        return
    sizes = [(32, 24)] if given.quick else [(160, 90), (64, 96)]
    columns = []
    for width, height in sizes:
        with tempfile.TemporaryDirectory() as folder:
            columns.append(psnrs(given.defray, folder, width, height))
    table = Table("frame", *[f"{w}×{h}, {what}" for w, h in sizes for what in ("pinhole", "defray")])
    for i in range(3):
        table.row(str(i + 1), *[f"{db:.2f}" for column in columns for db in column[i]])
    if given.update:
        table.update(given.update, "blender.py")


if __name__ == "__main__":
    main()
