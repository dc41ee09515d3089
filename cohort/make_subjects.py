#!/usr/bin/python3
"""Makes a BIDS dataset of small synthetic scans, for tests and for trying things out.

  make_subjects.py FOLDER COUNT [--side N] [--corrupt N] [--hopeless N]

Subject 03, say, is an ellipsoid with a lump whose axes follow from its number: the same in every run. The last ones are bad: corrupt scans
are cut off in the middle, hopeless ones are empty, so that no level has an inside."""
import argparse
import gzip
import json
import pathlib
import struct

import numpy as np


def voxels(number: int, side: int) -> np.ndarray:
    """Values (z, y, x): 100 inside, falling through 60 at the surface."""
    chance = np.random.default_rng(number)
    axes = chance.uniform(0.24, 0.40, 3) * side
    lump = chance.uniform(-0.5, 0.5, 3) * axes
    z, y, x = np.meshgrid(*[np.arange(side) - (side - 1) / 2] * 3, indexing="ij")
    body = 1 - np.sqrt((x / axes[0]) ** 2 + (y / axes[1]) ** 2 + (z / axes[2]) ** 2)
    ball = 1 - np.sqrt((x - lump[0]) ** 2 + (y - lump[1]) ** 2 + (z - lump[2]) ** 2) / (0.3 * side)
    return np.clip(60 + 100 * np.maximum(body, ball), 0, 120)


def nifti(values: np.ndarray) -> bytes:
    """An image of 16-bit voxels of 1 mm, centred on the origin."""
    side = values.shape[0]
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, side, side, side, 1, 1, 1, 1)
    struct.pack_into("<hh", header, 70, 4, 16)
    struct.pack_into("<8f", header, 76, 1, 1, 1, 1, 1, 1, 1, 1)
    struct.pack_into("<f", header, 108, 352)
    struct.pack_into("<B", header, 123, 2)
    struct.pack_into("<hh", header, 252, 0, 1)
    for row in range(3):
        struct.pack_into("<4f", header, 280 + 16 * row, *(float(row == column) for column in range(3)), -(side - 1) / 2)
    header[344:348] = b"n+1\0"
    return gzip.compress(bytes(header) + np.round(values).astype("<i2").tobytes(), compresslevel=1, mtime=0)


def make_dataset(folder: pathlib.Path, count: int, side: int, corrupt: int = 0, hopeless: int = 0) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "dataset_description.json").write_text(json.dumps({"Name": "Synthetic", "BIDSVersion": "1.8.0"}) + "\n")
    for number in range(1, count + 1):
        anat = folder / f"sub-{number:02d}" / "anat"
        anat.mkdir(parents=True, exist_ok=True)
        empty = count - corrupt - hopeless < number <= count - corrupt
        data = nifti(np.zeros((side,) * 3) if empty else voxels(number, side))
        cut = len(data) // 2 if number > count - corrupt else len(data)
        (anat / f"sub-{number:02d}_T1w.nii.gz").write_bytes(data[:cut])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("count", type=int)
    parser.add_argument("--side", type=int, default=32)
    parser.add_argument("--corrupt", type=int, default=0)
    parser.add_argument("--hopeless", type=int, default=0)
    arguments = parser.parse_args()
    make_dataset(arguments.folder, arguments.count, arguments.side, arguments.corrupt, arguments.hopeless)


if __name__ == "__main__":
    main()
