"""Draws a grid in Blender: `blender -b --factory-startup -P cycles_scene.py -- SETTINGS.json`, from with_cycles.py.

Absorption and emission of equal strength give 1 - T at any step: white dust in a black world.
"""

import json
import sys

import bpy
import mathutils

with open(sys.argv[sys.argv.index("--") + 1]) as file:
    settings = json.load(file)

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene


def put(name, data):
    item = bpy.data.objects.new(name, data)
    scene.collection.objects.link(item)
    return item


def material(name):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    made.node_tree.nodes.clear()
    return made, made.node_tree.nodes, made.node_tree.links


fog, nodes, links = material("fog")
density, absorption, emission, both, output = (nodes.new("ShaderNode" + kind) for kind in (
    "VolumeInfo", "VolumeAbsorption", "Emission", "AddShader", "OutputMaterial"))
absorption.inputs["Color"].default_value = (0, 0, 0, 1)  # absorbs all light
emission.inputs["Color"].default_value = (1, 1, 1, 1)
links.new(density.outputs["Density"], absorption.inputs["Density"])
links.new(density.outputs["Density"], emission.inputs["Strength"])
links.new(absorption.outputs[0], both.inputs[0])
links.new(emission.outputs[0], both.inputs[1])
links.new(both.outputs[0], output.inputs["Volume"])

volume = bpy.data.volumes.new("cloud")
volume.filepath = settings["grid"]
volume.render.space = "WORLD"
volume.render.step_size = settings["step"]
volume.render.precision = "FULL"
volume.materials.append(fog)
put("cloud", volume)

if settings["ground"]:
    black, nodes, links = material("black")
    links.new(nodes.new("ShaderNodeHoldout").outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    plane = bpy.data.meshes.new("ground")
    far = 1000
    plane.from_pydata([(-far, 0, -far), (-far, 0, far), (far, 0, far), (far, 0, -far)], [], [(0, 1, 2, 3)])
    plane.materials.append(black)
    put("ground", plane)

camera = bpy.data.cameras.new("camera")
camera.sensor_fit = "VERTICAL"
camera.angle_y = settings["angle"]
camera.clip_start, camera.clip_end = 1e-4, 1000
scene.camera = put("camera", camera)
right, up, ahead = settings["axes"]
scene.camera.matrix_world = mathutils.Matrix([[right[i], up[i], -ahead[i], settings["eye"][i]] for i in range(3)] + [[0, 0, 0, 1]])

scene.render.engine = "CYCLES"
scene.cycles.device = "CPU"
scene.cycles.samples = settings["samples"]
scene.cycles.use_adaptive_sampling = False
scene.cycles.use_denoising = False
scene.cycles.pixel_filter_type = "BLACKMAN_HARRIS"
scene.cycles.filter_width = 0.01
scene.cycles.volume_step_rate = 1
scene.cycles.volume_max_steps = 65536
scene.cycles.max_bounces = 64
scene.cycles.volume_bounces = 0
scene.render.threads_mode, scene.render.threads = "FIXED", 2
scene.render.resolution_x, scene.render.resolution_y = settings["size"]
scene.render.resolution_percentage = 100
scene.render.use_compositing = scene.render.use_sequencer = False
scene.view_settings.view_transform = "Raw"
image = scene.render.image_settings
image.file_format, image.color_mode, image.color_depth, image.exr_codec = "OPEN_EXR", "RGBA", "32", "NONE"
scene.render.filepath = settings["picture"]
bpy.ops.render.render(write_still=True)
