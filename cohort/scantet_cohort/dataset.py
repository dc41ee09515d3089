"""What makes the output folder a BIDS derivative."""
import pathlib
from typing import Any, Dict

from scantet_cohort import files
from scantet_cohort.layout import Layout


def write_dataset(layout: Layout, bids_dir: pathlib.Path, settings: Dict[str, Any]) -> None:
    source = files.read_json(bids_dir / "dataset_description.json") or {}
    name, _, version = settings["version"].partition(" ")
    files.write_json(layout.output / "dataset_description.json", {
        "Name": f"Tetrahedral meshes of {source.get('Name', bids_dir.resolve().name)}",
        "BIDSVersion": source.get("BIDSVersion", "1.8.0"),
        "DatasetType": "derivative",
        "GeneratedBy": [{"Name": name, "Version": version, "Description": "scantet cohort",
                         "Options": settings["options"]}],
        "SourceDatasets": [{"URL": bids_dir.resolve().as_uri()}],
    })
    files.write_whole(layout.output / ".bidsignore", "*_mesh.*\n*_report.*\nquarantine.tsv\ngroup.*\nlogs/\n.scantet/\n.snakemake/\n")
