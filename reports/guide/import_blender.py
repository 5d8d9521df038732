"""Imports what `dustbench export --format vdb,vtp` wrote into Blender: volumes as a sequence, the first frame's particles.

    blender --python import_blender.py -- FOLDER       in Blender 3.6 or later
    python3 import_blender.py --check FOLDER           reads the files and says what is in them, without Blender

dustbench has +Y up and metres, Blender +Z: everything hangs below the empty 'dustbench', which is turned by 90° about X.
"""

import array
import math
import pathlib
import struct
import sys
import xml.etree.ElementTree

STEPS_PER_SECOND = 60
CODES = {"Float32": "f", "Float64": "d", "Int32": "i", "UInt32": "I", "Int64": "q", "UInt64": "Q", "UInt8": "B", "Int8": "b"}


def lz4_block(packed):
    """One block of LZ4 (https://github.com/lz4/lz4/blob/dev/doc/lz4_Block_format.md), for Blender's Python has none."""
    out = bytearray()
    at = 0

    def length(start):
        nonlocal at
        if start < 15:
            return start
        while True:
            more = packed[at]
            at += 1
            start += more
            if more < 255:
                return start

    while at < len(packed):
        token = packed[at]
        at += 1
        literals = length(token >> 4)
        out += packed[at:at + literals]
        at += literals
        if at >= len(packed):
            break
        offset = packed[at] | packed[at + 1] << 8
        at += 2
        count = length(token & 15) + 4
        start = len(out) - offset
        if offset >= count:
            out += out[start:start + count]
        else:  # it repeats what it writes
            for i in range(count):
                out.append(out[start + i])
    return bytes(out)


def appended(blob, offset, header):
    """The bytes of an array in a VTK XML file's appended data: numbers of blocks, then LZ4 blocks."""
    size = struct.calcsize(header)

    def numbers(at, count):
        return struct.unpack_from(f"<{count}{header}", blob, at)

    blocks, _, _ = numbers(offset, 3)
    sizes = numbers(offset + 3 * size, blocks)
    at = offset + (3 + blocks) * size
    data = bytearray()
    for packed in sizes:
        data += lz4_block(blob[at:at + packed])
        at += packed
    return bytes(data)


def read_vtp(path):
    """The points of a .vtp file and its point data: {name: (components, values)}; positions are 'Points'."""
    content = pathlib.Path(path).read_bytes()
    start = content.index(b"<AppendedData")
    mark = content.index(b"_", start) + 1
    root = xml.etree.ElementTree.fromstring(content[:start] + b"</VTKFile>")
    if root.get("compressor") != "vtkLZ4DataCompressor" or root.get("byte_order") != "LittleEndian":
        raise ValueError(f"{path}: not a file that dustbench exports")
    header = {"UInt32": "I", "UInt64": "Q"}[root.get("header_type", "UInt32")]
    found = {}
    for part in ("Points", "PointData"):
        for node in root.iter(part):
            for item in node.findall("DataArray"):
                values = array.array(CODES[item.get("type")])
                values.frombytes(appended(content[mark:], int(item.get("offset")), header))
                name = "Points" if part == "Points" else item.get("Name")
                found[name] = (int(item.get("NumberOfComponents", "1")), values)
    return found


def frame_of(path):
    return int(path.stem[1:])


def files_of(folder, extension):
    """Files that every method has, f000120.vdb; a method's own have another name behind the number."""
    return sorted(path for path in pathlib.Path(folder).glob(f"f*.{extension}") if path.stem[1:].isdigit())


def particles_of(folder):
    """The particles that the method shows, its own or the shared dust."""
    series = pathlib.Path(folder) / "particles.pvd"
    if not series.exists():
        return files_of(folder, "vtp")
    return [series.parent / step.get("file") for step in xml.etree.ElementTree.parse(series).getroot().iter("DataSet")]


def check(folder):
    volumes, points = files_of(folder, "vdb"), particles_of(folder)
    if not volumes and not points:
        sys.exit(f"{folder}: no .vdb and no .vtp files; export with --format vdb,vtp")
    print(f"{len(volumes)} volumes, {len(points)} files of particles")
    for path in points:
        arrays = read_vtp(path)
        count = len(arrays["Points"][1]) // 3
        for name, (components, values) in arrays.items():
            if len(values) != components * count:
                sys.exit(f"{path}: {name} has {len(values)} values, expected {components * count}")
        print(f"{path.name}: {count} particles with {', '.join(sorted(set(arrays) - {'Points'}))}")


def import_all(bpy, folder):
    root = bpy.data.objects.new("dustbench", None)
    root.rotation_euler = (math.pi / 2, 0, 0)
    bpy.context.scene.collection.objects.link(root)
    volumes, points = files_of(folder, "vdb"), particles_of(folder)
    scene = bpy.context.scene
    if volumes:
        scene.frame_start, scene.frame_end = 1, len(volumes)
        if len(volumes) > 1:
            scene.render.fps = max(1, STEPS_PER_SECOND // (frame_of(volumes[1]) - frame_of(volumes[0])))
    material = fog(bpy)
    for index, path in enumerate(volumes):
        add_volume(bpy, path, index + 1, root, material)
    if points:
        add_points(bpy, points[0], root)


def fog(bpy):
    """Density is extinction in 1/m, which is what Blender's volumes take at one unit for a metre."""
    material = bpy.data.materials.new("dustbench fog")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    volume, output = nodes.new("ShaderNodeVolumePrincipled"), nodes.new("ShaderNodeOutputMaterial")
    volume.inputs["Density"].default_value = 1.0
    material.node_tree.links.new(volume.outputs["Volume"], output.inputs["Volume"])
    return material


def add_volume(bpy, path, frame, root, material):
    """Shown in its own frame of the scene alone: exported frames may be any number of steps apart."""
    data = bpy.data.volumes.new(path.stem)
    data.filepath = str(path.resolve())
    data.materials.append(material)
    item = bpy.data.objects.new(path.stem, data)
    item.parent = root
    bpy.context.scene.collection.objects.link(item)
    for when, hidden in ((frame - 1, True), (frame, False), (frame + 1, True)):
        item.hide_viewport = item.hide_render = hidden
        item.keyframe_insert("hide_viewport", frame=when)
        item.keyframe_insert("hide_render", frame=when)


def add_points(bpy, path, root):
    """A mesh of vertices with attributes; Geometry Nodes' Mesh to Points shows them."""
    arrays = read_vtp(path)
    flat = arrays.pop("Points")[1]
    mesh = bpy.data.meshes.new("particles")
    mesh.from_pydata(list(zip(flat[0::3], flat[1::3], flat[2::3])), [], [])
    for name, (components, values) in arrays.items():
        if components == 1:
            mesh.attributes.new(name, "FLOAT", "POINT").data.foreach_set("value", [float(value) for value in values])
        elif components == 3:
            mesh.attributes.new(name, "FLOAT_VECTOR", "POINT").data.foreach_set("vector", list(values))
    item = bpy.data.objects.new("particles", mesh)
    item.parent = root
    bpy.context.scene.collection.objects.link(item)


def main(arguments):
    if len(arguments) == 2 and arguments[0] == "--check":
        check(arguments[1])
        return
    if len(arguments) != 1:
        sys.exit(__doc__)
    try:
        import bpy
    except ImportError:
        sys.exit("run it in Blender: blender --python import_blender.py -- FOLDER; without Blender: --check FOLDER")
    import_all(bpy, arguments[0])


if __name__ == "__main__":
    main(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else sys.argv[1:])
