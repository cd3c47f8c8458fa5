"""A scene for blender_test: blender -b --factory-startup -P blender_scene.py -- FILE.blend WIDTH HEIGHT,
three frames of a camera that moves and whose focus moves; and blender -b FILE.blend -P
blender_scene.py -- truth FOLDER renders them through Cycles' own lens."""
import math
import os
import sys

import bpy


def material(name, colour, scale):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    surface = tree.nodes["Principled BSDF"]
    surface.inputs["Roughness"].default_value = 1
    checker = tree.nodes.new("ShaderNodeTexChecker")
    checker.inputs[1].default_value = (*colour, 1)
    checker.inputs[2].default_value = (0.8, 0.8, 0.8, 1)
    checker.inputs[3].default_value = scale
    place = tree.nodes.new("ShaderNodeTexCoord")
    tree.links.new(place.outputs["Object"], checker.inputs[0])
    tree.links.new(checker.outputs[0], surface.inputs["Base Color"])
    return made


def build(path, width, height):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 64
    scene.cycles.use_denoising = False
    scene.cycles.use_adaptive_sampling = False
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.frame_start, scene.frame_end = 1, 3
    scene.world = bpy.data.worlds.new("sky")
    scene.world.color = (0.3, 0.4, 0.6)
    bpy.ops.mesh.primitive_plane_add(size=40)
    bpy.context.object.data.materials.append(material("floor", (0.1, 0.3, 0.1), 2))
    balls = [(-0.5, -1, 0.4, (0.8, 0.1, 0.1)), (0.5, 1.5, 0.6, (0.1, 0.1, 0.8)),
             (-0.9, 5, 1.0, (0.8, 0.6, 0.1))]
    for x, y, radius, colour in balls:
        bpy.ops.mesh.primitive_uv_sphere_add(radius=radius, location=(x, y, radius))
        bpy.context.object.data.materials.append(material("ball", colour, 6))
    bpy.ops.object.light_add(type="SUN", rotation=(0.6, 0.3, 0))
    bpy.context.object.data.energy = 3
    data = bpy.data.cameras.new("camera")
    camera = bpy.data.objects.new("camera", data)
    scene.collection.objects.link(camera)
    scene.camera = camera
    camera.rotation_euler = (math.radians(80), 0, 0)
    target = bpy.data.objects.new("target", None)
    scene.collection.objects.link(target)
    for frame in (1, 3):
        camera.location = (0.1 * (frame - 2), -4 + 0.1 * frame, 1)
        camera.keyframe_insert("location", frame=frame)
        target.location = (0.3, -1 + 1.25 * (frame - 1), 0.5)
        target.keyframe_insert("location", frame=frame)
    data.dof.use_dof = True
    data.dof.focus_object = target
    data.dof.aperture_fstop = 0.4
    bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(path))


def truth(folder):
    scene = bpy.context.scene
    scene.cycles.samples = 256
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    for frame in range(1, 4):
        scene.frame_set(frame)
        scene.render.filepath = os.path.join(os.path.abspath(folder), "truth.%04d" % frame)
        bpy.ops.render.render(write_still=True)


arguments = sys.argv[sys.argv.index("--") + 1:]
if arguments[0] == "truth":
    truth(arguments[1])
else:
    build(arguments[0], int(arguments[1]), int(arguments[2]))
