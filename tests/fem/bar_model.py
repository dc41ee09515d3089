"""A bar of 8 by 8 by 16 mm with named sides, cut out of a synthetic scan: what the tests of decks solve."""
import struct
import subprocess

E, NU, RHO, K = 1000.0, 0.3, 1.0, 0.5


def run(*command, cwd):
    done = subprocess.run([str(c) for c in command], cwd=cwd, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, (command, done.stdout[-2000:], done.stderr[-2000:])
    return done.stdout + done.stderr


def write_scan(path):
    """A solid of bright voxels, 20 voxels of 1 mm a side, that reaches beyond the cuts."""
    side = 24
    values = [100.0 if max(abs(i - 11.5), abs(j - 11.5), abs(k - 11.5)) < 10.6 else 0.0
              for k in range(side) for j in range(side) for i in range(side)]
    header = (f"NRRD0005\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: {side} {side} {side}\n"
              "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (-11.5,-11.5,-11.5)\nendian: little\nencoding: raw\n\n")
    path.write_bytes(header.encode() + struct.pack(f"<{len(values)}f", *values))


def make(scantet, folder, deck, mesh, *arguments):
    """Meshes the bar, all six sides cut flat, and writes its deck; mesh: the name of the file."""
    sides = {"left": "x > -4", "right": "x < 4", "front": "y > -4", "back": "y < 4", "low": "z > -8", "high": "z < 8"}
    options = [x for name, plane in sides.items() for x in ("--cut", f"{name}: {plane}")]
    for name, plane in (("foot", "low"), ("tip", "high"), ("at_x", "left"), ("at_y", "front")):
        options += ["--set", f"{name}=patch({plane})"]
    run(scantet, "mesh", "scan.nrrd", "--level", "50", "--size", "3", *options, "--materials", "m.json", "--deck", deck,
        *arguments, "-o", mesh, cwd=folder)


def write_inputs(folder):
    write_scan(folder / "scan.nrrd")
    (folder / "m.json").write_text(f'{{"regions": {{"1": {{"youngs_modulus_mpa": {E}, "poissons_ratio": {NU}, '
                                   f'"density_g_per_cm3": {RHO}, "conductivity": {K}}}}}}}')
