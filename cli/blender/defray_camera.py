"""Prepares a Blender scene for defray: blender -b SHOT.blend -P defray_camera.py -- -o FOLDER [--render]

Writes FOLDER/camera.0001.json and so on, the lens of each frame of the scene (or of --frames 1-24,30),
and sets up the render that defray takes: passes Combined and Z, depth of field and motion blur off,
OpenEXR multilayer in 32-bit floats at FOLDER/0001.exr and so on. --render renders it too. At the end
it prints the command that makes the pictures. In Blender's text editor it takes the folder of the
.blend file.

Lengths are Blender units, which Cycles takes for metres.
"""
import argparse
import json
import os
import re
import struct
import sys

import bpy

FITS = {"AUTO": "auto", "HORIZONTAL": "horizontal", "VERTICAL": "vertical"}


def focus_distance(camera):
    """Planar, along the view axis; of an object or a bone, the distance of its origin."""
    dof = camera.data.dof
    if dof.focus_object is None:
        return dof.focus_distance
    matrix = dof.focus_object.matrix_world
    if dof.focus_object.type == "ARMATURE" and getattr(dof, "focus_subtarget", ""):
        matrix = matrix @ dof.focus_object.pose.bones[dof.focus_subtarget].matrix
    return -(camera.matrix_world.normalized().inverted() @ matrix.translation).z


def camera_values(scene):
    """What camera.json says of the current frame."""
    camera = scene.camera
    data = camera.data
    values = {
        "frame": scene.frame_current,
        "camera": camera.name,
        "focal_length_mm": data.lens,
        "sensor_fit": FITS[data.sensor_fit],
        "focus_distance_m": focus_distance(camera),
        "f_stop": data.dof.aperture_fstop,
    }
    if data.sensor_fit == "VERTICAL":
        values["sensor_height_mm"] = data.sensor_height
    else:
        values["sensor_width_mm"] = data.sensor_width
    return values


def check(scene):
    """Ends with what defray has no lens for."""
    if scene.camera is None:
        sys.exit("defray_camera: the scene has no active camera")
    if scene.camera.data.type != "PERSP":
        sys.exit("defray_camera: camera '%s' is not a perspective one" % scene.camera.name)
    render = scene.render
    if render.pixel_aspect_x != render.pixel_aspect_y:
        sys.exit("defray_camera: pixels are not square (Output Properties, Aspect)")


def set_up(scene, folder):
    """A pinhole picture with depth, one sample of it at each pixel's centre."""
    for layer in scene.view_layers:
        layer.use_pass_combined = True
        layer.use_pass_z = True
    scene.camera.data.dof.use_dof = False
    scene.render.use_motion_blur = False
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = os.path.join(folder, "####")


def border_pixel(share, size):
    """Where Blender begins or ends a region: it multiplies in single precision and cuts off, so
    that 0.7 of 90 is 63."""
    return int(struct.unpack("f", struct.pack("f", share * size))[0])


def lens_options(scene):
    """What of the lens is an option: the aperture's shape, and a cut-out."""
    dof = scene.camera.data.dof
    options = ""
    if dof.aperture_blades >= 3:
        options += " --blades %d --blade-rotation %g" % (
            dof.aperture_blades, dof.aperture_rotation * 57.29577951308232)
    if dof.aperture_ratio != 1:
        options += " --squeeze %g" % dof.aperture_ratio
    render = scene.render
    if render.use_border and render.use_crop_to_border:
        width = render.resolution_x * render.resolution_percentage // 100
        height = render.resolution_y * render.resolution_percentage // 100
        options += " --full-size %dx%d+%d+%d" % (
            width, height, border_pixel(render.border_min_x, width),
            height - border_pixel(render.border_max_y, height))
    return options


def frames_of_range(part):
    """7, 1-8, 8-1, 1-10x2, 1-10y2 (what x leaves out), as 'defray render --frames' has them."""
    match = re.fullmatch(r"(-?\d{1,9})(?:-(-?\d{1,9})(?:([xy])(-?[1-9]\d{0,8}))?)?", part)
    if not match:
        raise argparse.ArgumentTypeError(
            "'%s' is not a frame range; allowed: 7, 1-8, 1-10x2, 1,5,9-12" % part)
    first, last = int(match[1]), int(match[2] or match[1])
    step = int(match[4] or 1)
    if step < 0 and first < last:
        first, last = last, first
    every = range(first, last + 1) if first <= last else range(first, last - 1, -1)
    kept = every[::abs(step)]
    return [frame for frame in every if frame not in kept] if match[3] == "y" else list(kept)


def frames_of(text):
    """Each once."""
    return list(dict.fromkeys(
        frame for part in text.split(",") for frame in frames_of_range(part)))


def main(arguments):
    parser = argparse.ArgumentParser(prog="defray_camera.py")
    parser.add_argument("-o", "--output", default=bpy.path.abspath("//"), help="folder")
    parser.add_argument("--frames", type=frames_of,
                        help="1-24, 1-10x2, 1,5,9-12; without it, the scene's")
    parser.add_argument("--render", action="store_true", help="render the frames, too")
    options = parser.parse_args(arguments)
    scene = bpy.context.scene
    folder = os.path.abspath(options.output)
    os.makedirs(folder, exist_ok=True)
    check(scene)
    extra = lens_options(scene)
    set_up(scene, folder)
    for frame in options.frames or range(scene.frame_start, scene.frame_end + 1):
        scene.frame_set(frame)
        check(scene)
        name = os.path.join(folder, "camera.%04d.json" % frame)
        with open(name, "w", encoding="utf-8") as file:
            json.dump(camera_values(scene), file, indent=2)
            file.write("\n")
        if options.render:
            scene.render.filepath = os.path.join(folder, "%04d" % frame)
            bpy.ops.render.render(write_still=True)
    print("defray render '%s/####.exr' -o '%s/lens.####.exr' --camera '%s/camera.####.json'%s"
          % (folder, folder, folder, extra))


if __name__ == "__main__":
    main(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
