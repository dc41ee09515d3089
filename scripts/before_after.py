"""Times of two builds of the program on the same inputs, in turns.

    scripts/before_after.py OLD NEW [--runs N] [--volumes DIR] [--whole] [CASE...]

Prints new over old, run by run: the sum of the stages of refinement (sampling to extraction), of one thread and of two.
With --whole what the whole command takes, with all attempts at a mesh.
For a quiet machine; `benchmarks/` sets us beside other meshers.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def seconds_of(program, arguments, whole, folder):
    """Seconds of the stages of refinement, or of all, and the vertices."""
    report = pathlib.Path(folder) / "report.json"
    command = [program, "mesh", *arguments, "--quiet", "--report", report, "-o", pathlib.Path(folder) / "mesh.vtu"]
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=600)
    if done.returncode not in (0, 4):
        raise SystemExit(f"{' '.join(map(str, command))}\nended with status {done.returncode}:\n{done.stderr}")
    told = json.loads(report.read_text())
    seconds = told["timing_s"]["total"] if whole else sum(stage["seconds"] for stage in told["stages"])
    return seconds, told["mesh"]["vertices"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("cases", nargs="*", metavar="CASE", help="some of those that it prints; default all")
    parser.add_argument("--volumes", default=str(ROOT.parent / "shared/volumes"))
    parser.add_argument("--whole", action="store_true", help="of the whole command")
    options = parser.parse_intermixed_args()  # cases may follow options
    rough = [] if options.whole else ["--optimize", "none"]  # one mesh of each, not all attempts at one
    templates = "/usr/share/mricron/templates"
    written = tempfile.TemporaryDirectory()
    scans = pathlib.Path(written.name)
    cases = {
        "skull 2 mm": [f"{options.volumes}/skull.nrrd", "--level", "2.9", "--outside", "0", "--size", "2"],
        "skull 1 mm": [f"{options.volumes}/skull.nrrd", "--level", "2.9", "--outside", "0", "--size", "1"],
        "brain 4 mm": [f"{templates}/ch2bet.nii.gz", "--level", "20", "--size", "4"],
        "brain 2 mm": [f"{templates}/ch2bet.nii.gz", "--level", "20", "--size", "2"],
        "brain 20 3 mm": [f"{templates}/ch2bet.nii.gz", "--level", "20", "--size", "3", *rough],
        "brain 60 3 mm": [f"{templates}/ch2bet.nii.gz", "--level", "60", "--size", "3", *rough],
        "half a brain": [f"{templates}/ch2bet.nii.gz", "--level", "20", "--size", "3", "--border", "cap", "--crop-voxels",
                         "0:90,:,:", *rough],
        "inia19 1 mm": [f"{templates}/inia19-t1-brain.nii.gz", "--level", "100", "--size", "1", *rough],
        "head CT 4 mm": [scans / "head_ct.nrrd", "--level", "226", "--size", "4", *rough],
        "aal": [f"{templates}/aal.nii.gz", "--labels", "all", "--size", "2", *rough],
        "AICHA": [f"{templates}/AICHAmc.nii.gz", "--labels", "all", "--size", "4", *rough],
        "natbrainlab": [f"{templates}/natbrainlab.nii.gz", "--labels", "all", "--size", "2", *rough],
        "tanglecube": ["implicit:x^4-5*x^2+y^4-5*y^2+z^4-5*z^2+11.8", "--bounds=-3,-3,-3,3,3,3", "--size", "0.08"],
    }
    if not options.cases or "head CT 4 mm" in options.cases:
        subprocess.run(["python3", ROOT / "scripts/head_ct.py", scans / "head_ct.nrrd"], check=True)
    print("case, threads: vertices old -> new; seconds, median old -> new; new over old: least, median, worst")
    for name, source in cases.items():
        if options.cases and name not in options.cases:
            continue
        for threads in (1, 2):
            arguments = [*source, "--threads", threads]
            pairs = []
            with tempfile.TemporaryDirectory() as folder:
                for _ in range(options.runs):
                    pairs.append([seconds_of(build, arguments, options.whole, folder)
                                  for build in (options.old, options.new)])
            ratios = sorted(new[0] / old[0] for old, new in pairs)
            middle = [sorted(run[side][0] for run in pairs)[len(pairs) // 2] for side in (0, 1)]
            print(f"{name}, {threads}: {pairs[0][0][1]:,} -> {pairs[0][1][1]:,}; {middle[0]:.2f} -> {middle[1]:.2f} s; "
                  f"{ratios[0]:.2f}, {ratios[len(ratios) // 2]:.2f}, {ratios[-1]:.2f}", flush=True)


if __name__ == "__main__":
    main()
