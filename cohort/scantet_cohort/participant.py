"""The participant level: finds scans, meshes those that are not yet meshed, and says what has become of each."""
import collections
import pathlib
import shutil
from typing import Any, Dict, List, Sequence, Tuple

from scantet_cohort import files, hashing, mesh_files, mesh_options, results, workflow
from scantet_cohort.dataset import write_dataset
from scantet_cohort.errors import CohortError, one_line
from scantet_cohort.event_log import EventLog
from scantet_cohort.layout import Layout
from scantet_cohort.program import run_program
from scantet_cohort.results import Entry
from scantet_cohort.scans import Scan
from scantet_cohort.workflow import Machine

Settings = Dict[str, Any]


def entries_of(layout: Layout, scans: Sequence[Scan], settings: Settings, workers: int) -> List[Entry]:
    """The scans with their keys. One that cannot be read gets a key, too, and a verdict at once."""
    sums = hashing.Checksums(layout.hashes).of([scan.path for scan in scans], workers)
    options = mesh_options.identity(settings["options"])
    formats = [*settings["formats"], *(["page"] if settings["pages"] else [])]
    entries = []
    for scan, checksum in zip(scans, sums):
        unread = isinstance(checksum, OSError)
        told = f"unreadable:{scan.path}" if unread else str(checksum)
        base = mesh_files.base_name(scan.stem, settings["formats"], settings["options"])
        key = hashing.key_of(told, options, formats, settings["version"], base)
        entry = Entry(scan, "" if unread else str(checksum), key)
        layout.result(entry.key).parent.mkdir(parents=True, exist_ok=True)
        if unread:
            files.write_json(layout.result(entry.key), {
                "key": entry.key, "verdict": "quarantined", "input_sha256": None, "version": settings["version"],
                "options": settings["options"], "exit_status": 3, "stage": "checksum",
                "message": f"{scan.path} cannot be read: {checksum.strerror}"})  # type: ignore[union-attr]
        entries.append(entry)
    return entries


def pending_keys(layout: Layout, entries: Sequence[Entry], retry_quarantined: bool) -> List[str]:
    """Keys without a verdict, each once; what is left of half a verdict is removed."""
    pending: Dict[str, Entry] = {}
    for entry in entries:
        if entry.key in pending:
            continue
        verdict = results.verdict_on(layout, entry.key)
        again = retry_quarantined and entry.sha256 and verdict and verdict["verdict"] == "quarantined"
        if verdict is None or again:
            pending[entry.key] = entry
    return list(pending)


def _prepare(layout: Layout, entries: Sequence[Entry], pending: Sequence[str], settings: Settings) -> None:
    """Writes what jobs read."""
    files.write_json(layout.settings, settings)
    wanted = set(pending)
    for entry in entries:
        if entry.key not in wanted:
            continue
        wanted.discard(entry.key)
        layout.result(entry.key).unlink(missing_ok=True)
        store = layout.store(entry.key)
        kept = files.read_json(store / "result.json")
        if kept and not results.is_sound(kept, store):
            shutil.rmtree(store)
        base = mesh_files.base_name(entry.scan.stem, settings["formats"], settings["options"])
        job = {"key": entry.key, "path": str(entry.scan.path), "sha256": entry.sha256, "base": base}
        files.write_json(layout.job(entry.key), job)


def _finish(layout: Layout, entries: Sequence[Entry]) -> Tuple[Dict[str, int], List[Tuple[Entry, Dict[str, Any]]]]:
    """Gives meshes their names; counts verdicts and lists those that are not `meshed`."""
    counts: Dict[str, int] = collections.Counter()
    told = []
    for entry in entries:
        result = results.verdict_on(layout, entry.key) or {"verdict": "unfinished", "message": "no verdict yet"}
        counts[result["verdict"]] += 1
        if result["verdict"] != "unfinished":
            results.publish(layout, entry, result)
        if result["verdict"] != "meshed":
            told.append((entry, result))
    quarantined = [[entry.scan.name, str(entry.scan.path), str(result["exit_status"]), result["message"]]
                   for entry, result in told if result["verdict"] == "quarantined"]
    rows = [["scan", "path", "exit_status", "message"], *quarantined]
    files.write_whole(layout.output / "quarantine.tsv", "".join("\t".join(map(one_line, row)) + "\n" for row in rows))
    return counts, told


def run(bids_dir: pathlib.Path, layout: Layout, scans: Sequence[Scan], settings: Settings, machine: Machine,
        retry_quarantined: bool) -> int:
    """Returns the exit status: 0 all meshed, 4 some flagged or quarantined, 1 some unfinished."""
    _check_options(scans[0], settings)
    if machine.profile:
        workflow.find_profile(machine.profile)
    if machine.dry_run:
        return _dry_run(layout, scans, settings, machine, retry_quarantined)
    workflow.check_modules()
    with files.locked(layout.run_lock, wait=False) as held:
        if not held:
            raise CohortError(f"another scantet cohort works on {layout.output}", "wait for it, or choose another folder")
        log = EventLog(layout.log)
        write_dataset(layout, bids_dir, settings)
        entries = entries_of(layout, scans, settings, machine.cpus)
        results.save_manifest(layout, entries)
        pending = pending_keys(layout, entries, retry_quarantined)
        log.write("run_begins", scans=len(entries), keys=len({entry.key for entry in entries}), pending=len(pending),
                  options=settings["options"], version=settings["version"])
        print(f"{len(entries)} scans, {len(pending)} to be meshed", flush=True)
        status = 0
        if pending:
            _prepare(layout, entries, pending, settings)
            workflow.make_plans(layout, machine, pending)
            left = [key for key in pending if results.verdict_on(layout, key) is None]
            status = workflow.make_meshes(layout, machine, left) if left else 0
        counts, told = _finish(layout, entries)
        log.write("run_ends", snakemake_status=status, **counts)
    return _tell(layout, counts, told)


def _tell(layout: Layout, counts: Dict[str, int], told: Sequence[Tuple[Entry, Dict[str, Any]]]) -> int:
    for entry, result in told[:20]:
        print(one_line(f"{result['verdict']}: {entry.scan.name}: {result['message']}"))
    if len(told) > 20:
        print(f"and {len(told) - 20} more")
    print(", ".join(f"{count} {verdict}" for verdict, count in sorted(counts.items())) + f"; log: {layout.log}")
    if counts.get("unfinished"):
        print(f"run the same command again to go on; {layout.output}/logs/snakemake_mesh.log says what ended the jobs")
        return 1
    return 0 if set(counts) <= {"meshed"} else 4


def _check_options(scan: Scan, settings: Settings) -> None:
    """Raises CohortError for options and formats that no scan could be meshed with. A scan that is not there shows them: what is
    wrong with the options is said before."""
    nowhere = scan.path.parent / f"none.{scan.path.name}"
    outputs = [word for ending in settings["formats"] for word in ("-o", f"scan{ending}")]
    done = run_program([settings["program"], "mesh", str(nowhere), *settings["options"], *outputs, "--plan", "--quiet"])
    if done.status == 2:
        told = done.reason().split("; hint: ")
        if told[0].startswith("--output: "):
            raise CohortError(told[0].replace("--output: ", "--mesh-format: ", 1), "; ".join(told[1:]))
        raise CohortError(f"mesh options: {told[0]}", "scantet mesh --help explains them")


def _dry_run(layout: Layout, scans: Sequence[Scan], settings: Settings, machine: Machine, retry: bool) -> int:
    """Says what would be done, and writes nothing but checksums of inputs, which the run then needs not take."""
    entries = entries_of(layout, scans, settings, machine.cpus)
    pending = set(pending_keys(layout, entries, retry))
    for entry in entries:
        print("\t".join(map(one_line, ["mesh" if entry.key in pending else "done", entry.scan.name, str(entry.scan.path)])))
    print(f"{len(pending)} to be meshed; nothing was")
    return 0
