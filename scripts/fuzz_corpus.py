"""Sound files to begin with, for the libFuzzer targets (tests/fuzz) that read what the program does not write:

    fuzz_corpus.py FOLDER     writes FOLDER/KIND/FILE

Standard library only.
"""
import sys
from pathlib import Path

import fuzz_files as files

CORPORA = {
    "tif": {"a.tif": files.tiff(), "tiled.tif": files.tiled_tiff()},
    "dcm": {"image.dcm": files.dicom(), "slice.dcm": files.dicom_slice(0), "binary.dcm": files.dicom_segmentation(b"BINARY"),
            "shares.dcm": files.dicom_segmentation(b"FRACTIONAL")},
    "seg": {"a.seg.nrrd": files.segmentation()},
    "nii": files.probabilities(),
    "labels": {**files.LABEL_CHOICES, **files.LABEL_TABLES},
    "lines": {"a.obj": files.EDGE_LINES["a.obj"]},
    "polylines": {"a.polylines": files.EDGE_LINES["b.polylines"]},
    "formula": files.FORMULAS,
    "size": files.SIZE_FORMULAS,
    "place": files.PLACES,
    "cut": files.CUTS,
    "materials": files.materials("a.nrrd"),
    "certificate": {"a.json": files.certificate()},
}

for kind, seeds in CORPORA.items():
    folder = Path(sys.argv[1]) / kind
    folder.mkdir(parents=True, exist_ok=True)
    for name, data in seeds.items():
        (folder / name).write_bytes(data)
