"""What makes the output folder a BIDS derivative."""
import os
import pathlib
from typing import Any, Dict

from scantet_cohort import files
from scantet_cohort.errors import CohortError
from scantet_cohort.layout import Layout

DESCRIPTION = "dataset_description.json"


def _description(folder: pathlib.Path) -> Dict[str, Any]:
    """Of a dataset; empty if it has none that can be read."""
    found = files.read_json(folder / DESCRIPTION)
    return found if isinstance(found, dict) else {}


def _is_of_a_cohort(folder: pathlib.Path) -> bool:
    makers = _description(folder).get("GeneratedBy")
    return isinstance(makers, list) and any(isinstance(maker, dict) and maker.get("Description") == "scantet cohort" for maker in makers)


def check_output(output: pathlib.Path) -> None:
    """An output folder has a description of its own. One that says what another dataset is, the input's first of all, is not replaced."""
    if os.path.lexists(output / DESCRIPTION) and not _is_of_a_cohort(output):
        raise CohortError(f"{output} is a dataset of its own: its {DESCRIPTION} is not of a cohort, and would be replaced",
                          "name a folder for the meshes alone, such as BIDS_DIR/derivatives/scantet")


def write_dataset(layout: Layout, bids_dir: pathlib.Path, settings: Dict[str, Any]) -> None:
    source = _description(bids_dir)
    name, _, version = settings["version"].partition(" ")
    files.write_json(layout.output / DESCRIPTION, {
        "Name": f"Tetrahedral meshes of {source.get('Name', bids_dir.resolve().name)}",
        "BIDSVersion": source.get("BIDSVersion", "1.8.0"),
        "DatasetType": "derivative",
        "GeneratedBy": [{"Name": name, "Version": version, "Description": "scantet cohort",
                         "Options": settings["options"]}],
        "SourceDatasets": [{"URL": bids_dir.resolve().as_uri()}],
    })
    files.write_whole(layout.output / ".bidsignore", "*_mesh.*\n*_mesh_*\n*_report.*\nquarantine.tsv\ngroup.*\nlogs/\n.scantet/\n.snakemake/\n")
