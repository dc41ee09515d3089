"""The files that the examples open, small: a head, a CT, sizes, points."""
import gzip
import math
import struct


def field(side, value_at):
    """Values on side^3 nodes, 1 mm apart around the origin, x fastest."""
    middle = (side - 1) / 2
    at = [i - middle for i in range(side)]
    return [value_at(math.sqrt(x * x + y * y + z * z)) for z in at for y in at for x in at]


def between(knots, r):
    """The value at r, linear between (r, value) knots, that of the last beyond it."""
    for (low, at_low), (high, at_high) in zip(knots, knots[1:]):
        if r <= high:
            return at_low + (at_high - at_low) * (r - low) / (high - low)
    return knots[-1][1]


def write_nifti(path, side, values, volumes=1, code="h"):
    """Voxels of 16 bits, or floats ("f"), of so many volumes one after the other; the frame is RAS, around the origin."""
    corner = -(side - 1) / 2
    header = bytearray(348)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3 if volumes == 1 else 4, side, side, side, volumes, 1, 1, 1)
    struct.pack_into("<hh", header, 70, *((4, 16) if code == "h" else (16, 32)))
    struct.pack_into("<8f", header, 76, 1, 1, 1, 1, 1, 1, 1, 1)
    struct.pack_into("<f", header, 108, 352)
    struct.pack_into("<B", header, 123, 2)  # mm
    struct.pack_into("<hh", header, 252, 0, 1)  # the affine map below
    for row in range(3):
        axes = [1 if column == row else 0 for column in range(3)]
        struct.pack_into("<4f", header, 280 + 16 * row, *axes, corner)
    header[344:348] = b"n+1\0"
    voxels = struct.pack(f"<{len(values)}{code}", *(round(v) if code == "h" else v for v in values))
    with gzip.open(path, "wb", compresslevel=1) as file:
        file.write(bytes(header) + bytes(4) + voxels)


def write_nrrd(path, side, step, values):
    corner = -step * (side - 1) / 2
    header = (f"NRRD0005\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: {side} {side} {side}\n"
              f"space directions: ({step},0,0) (0,{step},0) (0,0,{step})\nspace origin: ({corner},{corner},{corner})\n"
              "endian: little\nencoding: raw\n\n")
    path.write_bytes(header.encode() + struct.pack(f"<{len(values)}f", *values))


def sphere_points(count, radius):
    """Evenly spread, along a spiral."""
    points = []
    for i in range(count):
        z = 1 - (2 * i + 1) / count
        around = math.pi * (3 - math.sqrt(5)) * i
        flat = math.sqrt(1 - z * z)
        points.append((radius * flat * math.cos(around), radius * flat * math.sin(around), radius * z))
    return points


def write_ply(path, points):
    head = (f"ply\nformat ascii 1.0\nelement vertex {len(points)}\nproperty double x\nproperty double y\n"
            "property double z\nend_header\n")
    path.write_text(head + "".join("%.9g %.9g %.9g\n" % p for p in points))


def write_study(folder):
    """Two subjects as BIDS has them, and a folder of scans; the same small head, and a smaller one."""
    for number, scale in ((1, 1), (2, 0.9)):
        head = [(0, 900), (6 * scale, 300), (12 * scale, 60), (17 * scale, 20), (20 * scale, -300)]
        anat = folder / "study" / f"sub-0{number}" / "anat"
        anat.mkdir(parents=True)
        write_nifti(anat / f"sub-0{number}_T1w.nii.gz", 30, field(30, lambda r, head=head: between(head, r)))
    (folder / "study" / "dataset_description.json").write_text('{"Name": "Study", "BIDSVersion": "1.8.0"}\n')
    (folder / "scans").mkdir()
    write_nrrd(folder / "scans" / "first.nrrd", 24, 1, field(24, lambda r: between([(0, 900), (8, 60), (11, -300)], r)))


def write_inputs(folder):
    side = 46
    head = [(0, 900), (6, 300), (12, 60), (17, 20), (20, -300), (24, -1000)]
    write_nifti(folder / "head.nii.gz", side, field(side, lambda r: between(head, r)))
    inside = field(25, lambda r: 1 if r < 10 else 0)  # a ball in two halves
    write_nifti(folder / "atlas.nii.gz", 25, [1 + (i % 25) // 13 if ball else 0 for i, ball in enumerate(inside)])
    (folder / "atlas.nii.txt").write_text("1 Hippocampus_R\n2 Hippocampus_L\n")
    for name, low, high in (("csf", 8, 11), ("grey", 5, 8), ("white", 0, 5)):  # a ball and two shells around it
        write_nifti(folder / f"{name}.nii.gz", 25, field(25, lambda r: 1 if low <= r < high else 0))
    edges = (0, 3, 5, 7, 9, 11)  # five tissues around each other, and the air
    tissues = [field(25, lambda r, low=low, high=high: 0.9 if low <= r < high else 0.02)
               for low, high in zip(edges, (*edges[1:], math.inf))]
    write_nifti(folder / "tpm.nii.gz", 25, sum(tissues, []), volumes=len(tissues), code="f")
    write_nrrd(folder / "ct.nrrd", side, 1, field(side, lambda r: between([(0, 900), (10, 300), (20, -300)], r)))
    write_nrrd(folder / "cloud.nrrd", 24, 1, field(24, lambda r: max(0, 1 - r / 12)))
    write_nrrd(folder / "sizes.nrrd", 2, 60, [2, 3, 2, 3, 2, 3, 2, 3])
    points = sphere_points(2000, 0.25)
    (folder / "kitten.xyz").write_text("".join(
        "%.9g %.9g %.9g %.9g %.9g %.9g\n" % (p + tuple(4 * c for c in p)) for p in points))
    write_ply(folder / "scanner.ply", points)
    write_study(folder)
    (folder / "stiffness.json").write_text("""{"scan": {"file": "ct.nrrd", "density": {"a": 0.0, "b": 0.001},
        "modulus": [{"b": 6850, "c": 1.49}], "bins": {"number": 10}, "conductivity": 0.0005}}""")
    (folder / "job.json").write_text('{"level": 60, "size": 3}')
    (folder / "egg.ellipsoid").write_text("8 5 3\n")
