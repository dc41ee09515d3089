"""Makes docs/profile.md from the output of callgrind_annotate.

    profile_page.py FUNCTIONS COMMAND > docs/profile.md
"""
import re
import sys

ROWS = 30
LINE = re.compile(r"^\s*([\d,]+) \(\s*[\d.]+%\)\s+(?:\S*?:)?(.*?)(?: \[([^\]]*)\])?$")


def name_of(function):
    """The function without its parameters; what a loop on several threads runs gets the name of the loop's function."""
    function = function.replace("(anonymous namespace)::", "").replace("scantet::", "")
    loop = "::{lambda" in function
    handler = re.search(r"_Function_handler<.*?\), (.*)", function)
    if handler:
        function = handler[1]
    function = re.sub(r"<[^<>]*>", "", function)
    return function.split("(")[0].strip() + (" (loop)" if loop else "")


def main(path, command):
    total, sums = 0, {}
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            match = LINE.match(line)
            if not match or "PROGRAM TOTALS" in line:
                continue
            count = int(match[1].replace(",", ""))
            total += count
            name = name_of(match[2])
            library = (match[3] or "").rsplit("/", 1)[-1]
            if "scantet" not in library:
                name = library or "other"
            sums[name] = sums.get(name, 0) + count
    print("# Where the time goes\n")
    print("<!-- Made by scripts/profile.sh; do not edit. -->")
    print("Instructions of one run, from reading the scan to the audit, counted by callgrind; what is inlined counts for its")
    print("caller, system libraries are summed up by library. For seconds by stage and rule see `stages` in a report.\n")
    print(f"```sh\n{command}\n```\n")
    print(f"{total / 1e9:.2f} thousand million instructions.\n")
    print("| share | function |\n| ---: | --- |")
    for name, count in sorted(sums.items(), key=lambda item: -item[1])[:ROWS]:
        print(f"| {100 * count / total:.1f} % | `{name}` |")


if __name__ == "__main__":
    main(*sys.argv[1:])
