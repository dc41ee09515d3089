"""`scantet cohort`: a BIDS App."""
import argparse
import os
import pathlib
import sys
from typing import Any, Dict, List, Optional, Sequence

from scantet_cohort import dataset, group, mesh_options, participant
from scantet_cohort.errors import CohortError, one_line
from scantet_cohort.layout import Layout
from scantet_cohort.program import find_program, version_of
from scantet_cohort.scans import Choice, find_scans
from scantet_cohort.workflow import Machine

EXAMPLES = """\
examples:
  # every T1-weighted scan of a BIDS dataset, on two cores; then one page about all of them
  scantet cohort study meshes participant --suffix T1w --n-cpus 2 -- --level 60 --size 3
  scantet cohort study meshes group
  # a folder of scans that is no BIDS dataset
  scantet cohort scans meshes_of_scans participant --config job.json

on a cluster with Slurm, from a folder that all nodes see: add --profile slurm

exit status: 0 every scan is meshed; 1 some have no verdict yet: run the same command again; 2 wrong use; 3 no such
scans; 4 some meshes miss a bound, or some scans are in quarantine: quarantine.tsv says why; 5 the output cannot be
written; 130 cancelled
"""

# Each option's name, kind, value, group and help; the program makes manual pages and completions of them, too.
OPTIONS = pathlib.Path(__file__).resolve().parent.parent / "options.tsv"
KINDS: Dict[str, Dict[str, Any]] = {"list": {"nargs": "+", "default": []}, "file": {"type": pathlib.Path}, "text": {},
                                    "count": {"type": int}}


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> "NoReturn":  # type: ignore[name-defined,override]  # noqa: F821
        raise CohortError(message, "scantet cohort --help explains the options")


def make_parser() -> argparse.ArgumentParser:
    parser = _Parser("scantet cohort", allow_abbrev=False, epilog=EXAMPLES, formatter_class=argparse.RawDescriptionHelpFormatter,
                     usage="scantet cohort BIDS_DIR OUTPUT_DIR participant|group [options] [-- MESH-OPTIONS]",
                     description="Meshes every scan of a BIDS dataset or of a folder, one job each, here or on a cluster.")
    parser.add_argument("bids_dir", metavar="BIDS_DIR", type=pathlib.Path, help="the dataset, or a folder of scans")
    parser.add_argument("output_dir", metavar="OUTPUT_DIR", type=pathlib.Path, help="for meshes, reports and what runs remember")
    parser.add_argument("level", metavar="participant|group", choices=["participant", "group"],
                        help="participant meshes the scans; group makes one page and table about all of them")
    groups: Dict[str, Any] = {}
    for line in OPTIONS.read_text().splitlines():
        name, kind, metavar, title, text = line.split("\t")
        group = groups.get(title) or groups.setdefault(title, parser.add_argument_group(title))
        how = {"action": "store_true"} if kind == "flag" else {"metavar": metavar, **KINDS[kind]}
        group.add_argument(f"--{name}", *({f"--{name.replace('-', '_')}"} - {f"--{name}"}), help=text, **how)
    parser.set_defaults(mesh_options="", mesh_format=[".vtu"], n_cpus=os.cpu_count() or 1)
    parser.add_argument("--version", action="version", version=_version())
    return parser


def _version() -> str:
    try:
        return version_of(find_program())
    except CohortError:
        return "unknown"


def _bare(labels: Sequence[str], prefix: str) -> List[str]:
    return [label[len(prefix):] if label.startswith(prefix) else label for label in labels]


def _filters(words: Sequence[str]) -> Dict[str, str]:
    filters = {}
    for word in words:
        name, sign, value = word.partition("=")
        if not sign:
            raise CohortError(f"--bids-filter: \"{word}\" is no ENTITY=VALUE", "as in --bids-filter acq=mprage")
        filters[name] = value
    return filters


def _settings(arguments: argparse.Namespace, words: Sequence[str]) -> Dict[str, Any]:
    program = find_program()
    formats = sorted({ending if ending.startswith(".") else "." + ending for ending in arguments.mesh_format})
    return {"program": str(program), "version": version_of(program), "formats": formats, "pages": not arguments.no_pages,
            "folder": os.getcwd(), "options": mesh_options.collect(arguments.mesh_options, words, arguments.config)}


def _participant(arguments: argparse.Namespace, words: Sequence[str]) -> int:
    for name in ("n_cpus", "mem_mb", "threads"):
        value = getattr(arguments, name)
        if value is not None and value < 1:
            raise CohortError(f"--{name.replace('_', '-')} {value} is less than 1", "give a whole number from 1 on")
    choice = Choice(_bare(arguments.participant_label, "sub-"), _bare(arguments.session_label, "ses-"), arguments.suffix,
                    _filters(arguments.bids_filter))
    output = arguments.output_dir.resolve()
    dataset.check_output(output)
    scans = find_scans(arguments.bids_dir, output, choice)
    threads = arguments.threads or (8 if arguments.profile else arguments.n_cpus)
    machine = Machine(arguments.n_cpus, arguments.mem_mb, arguments.profile, threads, arguments.dry_run)
    return participant.run(arguments.bids_dir, Layout(output), scans, _settings(arguments, words), machine,
                           arguments.retry_quarantined)


def _run(words: Sequence[str]) -> int:
    split = words.index("--") if "--" in words else len(words)
    arguments = make_parser().parse_args(list(words[:split]))
    if arguments.level == "group":
        return group.run(Layout(arguments.output_dir.resolve()))
    return _participant(arguments, words[split + 1:])


def main(words: Optional[Sequence[str]] = None) -> int:
    try:
        return _run(list(sys.argv[1:] if words is None else words))
    except CohortError as error:
        print(one_line(f"scantet: error: {error}"), file=sys.stderr)
        if error.remedy:
            print(one_line(f"scantet: hint: {error.remedy}"), file=sys.stderr)
        return error.status
    except OSError as error:
        print(one_line(f"scantet: error: {error.filename or 'a file'}: {error.strerror}"), file=sys.stderr)
        print("scantet: hint: check the folder, its permissions and the free space", file=sys.stderr)
        return 5
    except KeyboardInterrupt:
        print("scantet: cancelled; run the same command again to go on", file=sys.stderr)
        return 130
