#!/usr/bin/env python3
"""The program's commands as one page of Markdown, from what they say of themselves: commands_page.py GONIO > commands.md.
Called by tools/site.sh."""

import re
import subprocess
import sys


def main(program):
    print("# Commands\n")
    page(program, [], 2)


def page(program, words, level):
    """The section of a command and of those below it."""
    said = subprocess.run([program, *words, "--help"], check=True, capture_output=True, text=True).stdout
    about, _, rest = said.partition("Usage: ")
    usage, _, rest = rest.partition("\n\n")
    name = " ".join(["gonio", *words])
    print(f"{'#' * level} `{name}`\n\n{escaped(about.strip())}\n\n```text\n{usage}\n```\n")
    below = []
    for block in sections(rest):
        title, _, body = block.partition("\n")
        if title == "Commands:":
            below = [line.split()[0] for line in body.splitlines() if re.match(r"  \S", line)]
        elif title in ("Options:", "Arguments:"):
            table(title.rstrip(":").lower(), body)
        else:
            print(f"```text\n{block}\n```\n")
    for command in below:
        if command != "help":
            page(program, [*words, command], level + 1)


def sections(text):
    """What stands between headings: lines that are not indented, after an empty one."""
    return [part.rstrip() for part in re.split(r"\n\n(?=\S)", text.strip("\n"))]


def table(title, body):
    """Flags and their meaning; each begins where a line is indented little."""
    rows = []
    for line in body.splitlines():
        if start := re.match(r"\s{2,6}([-<\[]\S.*?)(?:\s{2,}(\S.*))?$", line):
            rows.append([start[1], start[2] or ""])
        elif rows and line.strip():
            rows[-1][1] += " " + line.strip()
    print(f"| {title} | meaning |\n|---|---|")
    for flag, words in rows:
        print(f"| `{flag.replace('|', chr(92) + '|')}` | {escaped(words.strip())} |")
    print()


def escaped(text):
    """Text as Markdown that shows it."""
    return re.sub(r"([\\`*_<>|\[\]{}$#~])", r"\\\1", text)


if __name__ == "__main__":
    main(sys.argv[1])
