"""The bytes of small sound files, for fuzz_kinds.py and fuzz_corpus.py: formats that the program does not write, and texts
of options. Standard library only."""
import base64
import json
import math
import struct
import zlib

CUBE = [(x, y, z) for z in (0, 8) for y in (0, 8) for x in (0, 8)]
SIDES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
TRIANGLES = [t for a, b, c, d in SIDES for t in ((a, b, c), (a, c, d))]


def lines(rows):
    return "".join(" ".join(map(str, row)) + "\n" for row in rows).encode()


LABEL_CHOICES = {"a.txt": b"1 One\n2 Two\n", "b.lut": b"1-2 4 Both\n", "c.lut": b"1 One 255 0 0 0\n2 Two 0 255 0 0\n"}
LABEL_TABLES = {"a.lut": b"1 One 255 0 0 0\n2 Two 0 255 0 0\n",
                "b.tsv": b"index\tname\tcolor\n1\tOne\t#ff0000\n2\tTwo\t#00ff00\n",
                "c.label": b"1 255 0 0 1 1 1 \"One\"\n2-3 4 \"Two\"\n"}
EDGE_LINES = {"a.obj": lines(("v", *p) for p in CUBE) + b"l 1 2 4 3 1\nl -1 5\n",
              "b.polylines": b"5 0 0 0 8 0 0 8 8 0 0 8 0 0 0 0\n2 0 0 0 0 0 8\n"}
FORMULAS = {"a.txt": b"x^4-5*x^2+y^4-5*y^2+z^4-5*z^2+11.8", "b.txt": b"(1.5-sqrt(x^2+y^2))^2+z^2-0.25"}
SIZE_FORMULAS = {"a.txt": b"1.5 + 0.2*d", "b.txt": b"max(2, abs(x)/3)"}
PLACES = {"a.txt": b"tip=ball(0, 0, 10, 6) and normal(0, 0, 1, 60)",
          "b.txt": b"near=nodes: nearest(3, 0, 0, 10) or -10 < y < 10 minus not box(-9, -9, -9, 9, 9, 9)",
          "c.txt": b"rest=cylinder(0, 0, -20, 0, 0, 20, 4) and patch(boundary_1_0)",
          "d.txt": b'seen=scan("labels.seg.nrrd") > 0.5 and region(1)'}
SIZE_PLACES = {"a.txt": b"ball(0, 0, 10, 6) and not z < 2 = 2.5", "b.txt": b"x + 2z > -3.5=3"}
HOLDS = {"a.txt": b"foot", "b.txt": b"foot=xz"}
LOADS = {"a.txt": b"tip=0.5", "b.txt": b"tip=0,-3.5,-100"}
DECK_TEMPLATE = (b"** {{provenance}}\n*INCLUDE, INPUT={{mesh}}\n*STEP\n*STATIC\n*BOUNDARY\n{{hold}}\n*CLOAD\n{{load}}\n"
                 b"*NODE FILE\nU\n** {{name}}\n*END STEP\n")
CUTS = {"a.txt": b"sole: z > -8", "b.txt": b"x + 2y - 0.5z < 4"}
CONFIG = b'{"seeding": "bulk", "output": ["out.vtu"], "seed": 3}'


def materials(scan):
    """scan: the file that the law is of."""
    law = {"file": scan, "density": {"a": 0.1, "b": 0.001}, "ash": [{"a": 0.08, "b": 0.88}],
           "modulus": [{"below": 0.27, "b": 33900, "c": 2.2}, {"a": 469, "b": 5307}], "integrate": "hu",
           "least_modulus_mpa": 1, "poissons_ratio": 0.3, "bins": {"width_mpa": 50, "modulus": "max"}}
    places = [{"name": "cement", "where": "ball(0, 0, 6, 6) and x > -2", "youngs_modulus_mpa": 2500, "poissons_ratio": 0.35}]
    regions = {"1": {"youngs_modulus_mpa": 110000, "poissons_ratio": 0.3, "density_g_per_cm3": 4.4, "conductivity": 0.007}}
    return {"a.json": json.dumps({"places": places, "scan": law}).encode(), "b.json": json.dumps({"regions": regions}).encode()}


def certificate():
    """As much of one as is read, of files that are not there."""
    checksum = "0123456789abcdef" * 4
    return json.dumps({"scantet": "0.1.0", "kind": "certificate", "grade": "certified",
                       "mesh_file": {"name": "a.vtu", "sha256": checksum}, "scan": {"name": "a.nrrd", "sha256": checksum},
                       "options": {"level": ["127.5"], "inside": ["above"], "border": ["close"], "median": ["0"]}}).encode()


def surfaces():
    off = b"OFF\n8 12 0\n" + lines(CUBE) + lines((3, *t) for t in TRIANGLES)
    obj = lines(("v", *p) for p in CUBE) + lines(("f", *(i + 1 for i in t)) for t in TRIANGLES)
    ply = (b"ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
           b"element face 12\nproperty list uchar int vertex_indices\nend_header\n" + off.split(b"\n", 2)[2])
    stl = b"cube".ljust(80) + struct.pack("<I", len(TRIANGLES))
    for t in TRIANGLES:
        stl += struct.pack("<12fH", 0, 0, 0, *(c for i in t for c in CUBE[i]), 0)
    return {"a.off": off, "a.obj": obj, "a.ply": ply, "a.stl": stl}


def points():
    golden = 2.399963
    rows = []
    for k in range(200):
        z = 1 - (2 * k + 1) / 200
        r = (1 - z * z) ** 0.5
        rows.append((10 * r * math.cos(golden * k), 10 * r * math.sin(golden * k), 10 * z))
    xyz = lines(rows)
    ply = (b"ply\nformat ascii 1.0\nelement vertex 200\nproperty float x\nproperty float y\nproperty float z\n"
           b"end_header\n" + xyz)
    numbers = b"".join(struct.pack("<6d", *row, *(c / 10 for c in row)) for row in rows)
    binary = (b"ply\nformat binary_little_endian 1.0\nelement vertex 200\n" +
              b"".join(b"property double %s\n" % name for name in (b"x", b"y", b"z", b"nx", b"ny", b"nz")) + b"end_header\n")
    return {"a.xyz": xyz, "b.ply": ply, "c.ply": binary + numbers}


def packed(values):
    """Numbers as VTK writes them: in one zlib block, in base64."""
    block = zlib.compress(values)
    return base64.b64encode(struct.pack("<4I", 1, len(values), len(values), len(block))) + base64.b64encode(block)


def packed_mesh():
    """Six tets of a cube around its diagonal, in a .vtu whose arrays are compressed one by one."""
    ways = [(1, 3), (3, 2), (2, 6), (6, 4), (4, 5), (5, 1)]
    arrays = {b"p": struct.pack("<24d", *(c for p in CUBE for c in p)),
              b"connectivity": struct.pack("<24q", *(i for a, b in ways for i in (0, a, b, 7))),
              b"offsets": struct.pack("<6q", *range(4, 28, 4)), b"types": bytes([10] * 6), b"region": bytes([1] * 6)}
    kinds = {b"p": b'Float64" NumberOfComponents="3', b"connectivity": b"Int64", b"offsets": b"Int64", b"types": b"UInt8",
             b"region": b"UInt8"}
    array = {name: b'<DataArray type="%s" Name="%s" format="binary">%s</DataArray>' % (kinds[name], name, packed(values))
             for name, values in arrays.items()}
    return (b'<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" '
            b'compressor="vtkZLibDataCompressor">\n<UnstructuredGrid><Piece NumberOfPoints="8" NumberOfCells="6">\n<CellData>' +
            array[b"region"] + b"</CellData>\n<Points>" + array[b"p"] + b"</Points>\n<Cells>" +
            array[b"connectivity"] + array[b"offsets"] + array[b"types"] + b"</Cells>\n</Piece></UnstructuredGrid></VTKFile>\n")


def tiff_of(side, tags_of, pixels_of):
    """Three pages of side x side bytes. tags_of(place of the pixels, their count): those beside the common ones."""
    pages = 3
    data = bytearray(struct.pack("<2sHI", b"II", 42, 8))
    for page in range(pages):
        common = [(256, 4, side), (257, 4, side), (258, 3, 8), (259, 3, 1), (262, 3, 1), (277, 3, 1)]
        at = len(data) + 2 + 12 * (len(common) + len(tags_of(0, 0))) + 4
        tags = sorted(common + tags_of(at, side * side))
        data += struct.pack("<H", len(tags))
        for tag, kind, value in tags:
            data += struct.pack("<HHII", tag, kind, 1, value)
        end = len(data) + 4 + side * side
        data += struct.pack("<I", end if page + 1 < pages else 0)
        data += pixels_of(page)
    return bytes(data)


def tiff():
    return tiff_of(8, lambda at, count: [(273, 4, at), (278, 4, 8), (279, 4, count)],
                   lambda page: bytes((200 if 2 < i % 8 < 6 and 2 < i // 8 < 6 and page == 1 else 10) for i in range(64)))


def tiled_tiff():
    return tiff_of(16, lambda at, count: [(322, 4, 16), (323, 4, 16), (324, 4, at), (325, 4, count)],
                   lambda page: bytes((200 if 4 < i % 16 < 12 and 4 < i // 16 < 12 and page == 1 else 10) for i in range(256)))


def element(group, number, kind, value):
    value += (b"\0" if kind in (b"UI", b"OB") else b" ") * (len(value) % 2)
    long = kind in (b"OB", b"OW", b"SQ")
    head = struct.pack("<HH2s", group, number, kind)
    return head + (struct.pack("<HI", 0, len(value)) if long else struct.pack("<H", len(value))) + value


def sequence(group, number, items):
    return element(group, number, b"SQ", b"".join(struct.pack("<HHI", 0xfffe, 0xe000, len(item)) + item
                                                  for item in items))


def short(value):
    return struct.pack("<H", value)


def dicom_file(kind, body):
    meta = (element(2, 2, b"UI", kind) + element(2, 3, b"UI", b"1.2.3") +
            element(2, 0x10, b"UI", b"1.2.840.10008.1.2.1"))
    meta = element(2, 0, b"UL", struct.pack("<I", len(meta))) + meta
    return b"\0" * 128 + b"DICM" + meta + element(8, 0x16, b"UI", kind) + element(8, 0x18, b"UI", b"1.2.3") + body


def dicom():
    body = (element(0x28, 2, b"US", short(1)) + element(0x28, 4, b"CS", b"MONOCHROME2") + element(0x28, 8, b"IS", b"3") +
            element(0x28, 0x10, b"US", short(8)) + element(0x28, 0x11, b"US", short(8)) +
            element(0x28, 0x30, b"DS", b"1\\1") + element(0x28, 0x100, b"US", short(8)) +
            element(0x28, 0x101, b"US", short(8)) + element(0x28, 0x102, b"US", short(7)) +
            element(0x28, 0x103, b"US", short(0)) +
            element(0x7fe0, 0x10, b"OB", bytes((200 if i % 8 in (3, 4) and 83 < i < 110 else 10) for i in range(192))))
    return dicom_file(b"1.2.840.10008.5.1.4.1.1.7.2", body)


def dicom_slice(n):
    """One of a series of 8 x 8 pixels, 2 mm above the one before."""
    body = (element(8, 0x60, b"CS", b"CT") + element(0x20, 0xd, b"UI", b"1.2.4") + element(0x20, 0xe, b"UI", b"1.2.5") +
            element(0x20, 0x13, b"IS", str(n + 1).encode()) + element(0x20, 0x32, b"DS", b"0\\0\\%d" % (2 * n)) +
            element(0x20, 0x37, b"DS", b"1\\0\\0\\0\\1\\0") + element(0x28, 2, b"US", short(1)) +
            element(0x28, 4, b"CS", b"MONOCHROME2") + element(0x28, 0x10, b"US", short(8)) +
            element(0x28, 0x11, b"US", short(8)) + element(0x28, 0x30, b"DS", b"1\\1") +
            element(0x28, 0x100, b"US", short(16)) + element(0x28, 0x101, b"US", short(16)) +
            element(0x28, 0x102, b"US", short(15)) + element(0x28, 0x103, b"US", short(1)) +
            element(0x28, 0x1052, b"DS", b"-24") + element(0x28, 0x1053, b"DS", b"2") +
            element(0x7fe0, 0x10, b"OW", struct.pack("<64h", *(100 if 1 < i % 8 < 6 and 1 < i // 8 < 6 and 0 < n < 3 else 5
                                                               for i in range(64)))))
    return dicom_file(b"1.2.840.10008.5.1.4.1.1.2", body)


def dicom_segmentation(kind):
    """Two segments of 8 x 8 pixels in four slices, of which the first segment has three."""
    places = [(1, 0), (1, 1), (1, 2), (2, 1), (2, 2), (2, 3)]
    binary = kind == b"BINARY"
    pixels = [1 if 1 < i % 8 < 6 and 1 < i // 8 < 6 and (i % 8 < 4) == (segment == 1) else 0
              for segment, _ in places for i in range(64)]
    data = (bytes(sum(pixels[n + bit] << bit for bit in range(8)) for n in range(0, len(pixels), 8)) if binary
            else bytes(255 * pixel for pixel in pixels))
    body = (element(0x28, 2, b"US", short(1)) + element(0x28, 8, b"IS", str(len(places)).encode()) +
            element(0x28, 0x10, b"US", short(8)) + element(0x28, 0x11, b"US", short(8)) +
            element(0x28, 0x100, b"US", short(1 if binary else 8)) + element(0x62, 1, b"CS", kind) +
            sequence(0x62, 2, [element(0x62, 4, b"US", short(n)) + element(0x62, 5, b"LO", b"part") +
                               element(0x62, 0xd, b"US", struct.pack("<3H", 40000, 30000, 20000)) for n in (1, 2)]) +
            element(0x62, 0xe, b"US", short(255)) +
            sequence(0x5200, 0x9229, [sequence(0x20, 0x9116, [element(0x20, 0x37, b"DS", b"1\\0\\0\\0\\1\\0")]) +
                                      sequence(0x28, 0x9110, [element(0x28, 0x30, b"DS", b"1\\1")])]) +
            sequence(0x5200, 0x9230, [sequence(0x20, 0x9113, [element(0x20, 0x32, b"DS", b"0\\0\\%d" % (2 * k))]) +
                                      sequence(0x62, 0xa, [element(0x62, 0xb, b"US", short(segment))])
                                      for segment, k in places]) +
            element(0x7fe0, 0x10, b"OB", data))
    return dicom_file(b"1.2.840.10008.5.1.4.1.1.66.4", body)


def in_box(i):
    return all(1 < n < 6 for n in (i % 8, i // 8 % 8, i // 64))


def segmentation():
    """Of 3D Slicer: two layers, with two segments and one."""
    keys = b"".join(b"Segment%d_ID:=s\nSegment%d_Name:=part\nSegment%d_Color:=0.5 1 0\nSegment%d_Layer:=%d\n"
                    b"Segment%d_LabelValue:=%d\n" % (n, n, n, n, layer, n, label)
                    for n, (layer, label) in enumerate([(0, 1), (0, 2), (1, 1)]))
    return (b"NRRD0004\ntype: unsigned char\ndimension: 4\nspace: left-posterior-superior\nsizes: 2 8 8 8\n"
            b"space directions: none (1,0,0) (0,1,0) (0,0,1)\nkinds: list domain domain domain\nencoding: raw\n"
            b"space origin: (0,0,0)\n" + keys + b"\n" +
            bytes(value for i in range(512)
                  for value in ((1 + (i % 8) // 4 if in_box(i) else 0), (1 if in_box(i) and i // 64 == 3 else 0))))


def probabilities():
    """Two maps in one NIfTI file of either version."""
    values = struct.pack("<1024f", *(float(in_box(i % 512) and (i % 8 < 4) == (i < 512)) for i in range(1024)))
    first = bytearray(352)
    struct.pack_into("<i", first, 0, 348)
    struct.pack_into("<8h", first, 40, 4, 8, 8, 8, 2, 1, 1, 1)
    struct.pack_into("<2h", first, 70, 16, 32)
    struct.pack_into("<8f", first, 76, *[1.0] * 8)
    struct.pack_into("<f", first, 108, 352)
    first[344:347] = b"n+1"
    second = bytearray(544)
    struct.pack_into("<i8s2h8q", second, 0, 540, b"n+2\0\r\n\x1a\n", 16, 32, 4, 8, 8, 8, 2, 1, 1, 1)
    struct.pack_into("<8d", second, 104, *[1.0] * 8)
    struct.pack_into("<q", second, 168, 544)
    return {"a.nii": bytes(first) + values, "b.nii": bytes(second) + values}


def nifti_pair():
    """Header and voxels, in files of their own."""
    head = bytearray(352)
    struct.pack_into("<i", head, 0, 348)
    struct.pack_into("<8h", head, 40, 3, 8, 8, 8, 1, 1, 1, 1)
    struct.pack_into("<2h", head, 70, 2, 8)
    struct.pack_into("<8f", head, 76, *[1.0] * 8)
    head[344:347] = b"ni1"
    return bytes(head), bytes(200 if in_box(i) else 10 for i in range(512))


def gipl():
    """8 x 8 x 8 bytes: the header of 256 bytes, big-endian, as ITK's GIPL reader takes it."""
    head = struct.pack(">4HH4f", 8, 8, 8, 1, 8, 1, 1, 1, 1).ljust(252, b"\0") + struct.pack(">I", 719555000)
    return head + bytes(200 if in_box(i) else 10 for i in range(512))


def inr():
    """8 x 8 x 8 bytes in the format of CGAL's examples: a head of 256 bytes."""
    head = b"#INRIMAGE-4#{\nXDIM=8\nYDIM=8\nZDIM=8\nVDIM=1\nTYPE=unsigned fixed\nPIXSIZE=8 bits\nCPU=decm\nVX=1\nVY=1\nVZ=1\n"
    return head.ljust(252, b"\n") + b"##}\n" + bytes(200 if in_box(i) else 10 for i in range(512))


def size_image():
    """Sizes of 2 to 6 mm around the samples."""
    return (b"NRRD0004\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 4 4\n"
            b"space directions: (12,0,0) (0,12,0) (0,0,12)\nkinds: domain domain domain\nendian: little\nencoding: raw\n"
            b"space origin: (-18,-18,-18)\n\n" + struct.pack("<64f", *(2 + i % 5 for i in range(64))))


def vtk_image():
    values = lines([[200 if i % 6 in (2, 3) and 60 < i < 150 else 1] for i in range(216)])
    return (b"# vtk DataFile Version 3.0\nimage\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 6 6 6\nSPACING 1 1 1\n"
            b"ORIGIN 0 0 0\nPOINT_DATA 216\nSCALARS v float 1\nLOOKUP_TABLE default\n" + values)
