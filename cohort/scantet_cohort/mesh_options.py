"""The options for `scantet mesh` that all scans of a cohort share."""
import json
import pathlib
import re
import shlex
from typing import Any, Dict, List, Sequence, Tuple

from scantet_cohort import option_files
from scantet_cohort.errors import CohortError

# What the cohort itself decides, for each scan.
OWN = {"--output", "-o", "--report", "--certificate", "--threads", "--plan", "--quiet", "--config"}


def _groups(words: Sequence[str]) -> List[Tuple[str, ...]]:
    """Each option with the words that follow it; a negative number is a value."""
    groups: List[List[str]] = []
    for word in words:
        is_option = word.startswith("-") and not re.match(r"-[\d.]", word)
        if is_option:
            name, sign, value = word.partition("=")
            groups.append([name, value] if sign else [name])
        elif not groups:
            raise CohortError(f"mesh options begin with an option, not with \"{word}\"", "as in: -- --level 60 --size 3")
        else:
            groups[-1].append(word)
    return [tuple(group) for group in groups]


def _words_of_config(path: pathlib.Path) -> List[str]:
    """The options of a JSON file as `scantet mesh --config` takes them, as words."""
    try:
        values: Dict[str, Any] = json.loads(path.read_text())
    except OSError as error:
        raise CohortError(f"{path} cannot be read: {error.strerror}", "give a JSON file with options") from error
    except ValueError as error:
        raise CohortError(f"{path} is no JSON: {error}", "it must look like {\"level\": 60, \"size\": 3}") from error
    if not isinstance(values, dict):
        raise CohortError(f"{path} holds no JSON object", "it must look like {\"level\": 60, \"size\": 3}")
    words: List[str] = []
    for name, value in values.items():
        for item in value if isinstance(value, list) else [value]:
            if item is False or item is None:
                continue
            words += [f"--{name}"] if item is True else [f"--{name}", str(item)]
    return words


def collect(text: str, words: Sequence[str], config: "pathlib.Path | None") -> List[str]:
    """The options of the configuration file, then of --mesh-options, then those after `--`; in an order that does not
    depend on how they were typed. Files that options name become absolute paths, as jobs run elsewhere."""
    groups = _groups(_words_of_config(config) if config else [])
    typed = _groups([*shlex.split(text), *words])
    names = {group[0] for group in typed}
    groups = [group for group in groups if group[0] not in names] + typed
    for group in groups:
        if group[0] in OWN:
            raise CohortError(f"{group[0]} is no option for the scans of a cohort, which decides it for each of them",
                              "scantet cohort --help lists what can be chosen")
    ordered = sorted(groups, key=lambda group: group[0])
    return [word for name, *values in ordered for word in (name, *(option_files.absolute(name, value) for value in values))]


def identity(words: Sequence[str]) -> List[str]:
    """The options as they count for the key: files by what they hold, not by their names."""
    return [word for name, *values in _groups(words)
            for word in (name, *(option_files.by_content(name, value) for value in values))]
