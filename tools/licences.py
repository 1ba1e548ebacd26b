#!/usr/bin/env python3
"""Are the licences of all dependencies among those that deny.toml accepts? Says which are not; needs cargo alone."""

import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# a text of its own is said to be another thing than these
WORD = re.compile(r"\(|\)|\bAND\b|\bOR\b|[A-Za-z0-9.+-]+(?: WITH [A-Za-z0-9.-]+)?")


def accepted(expression: str, allowed: set[str]) -> bool:
    """Whether an SPDX expression can be met by accepted licences."""
    words = WORD.findall(expression.replace("/", " OR "))
    place = 0

    def one() -> bool:
        nonlocal place
        word = words[place]
        place += 1
        if word == "(":
            value = either()
            place += 1
            return value
        return word in allowed

    def all_of() -> bool:
        nonlocal place
        value = one()
        while place < len(words) and words[place] == "AND":
            place += 1
            value = one() and value
        return value

    def either() -> bool:
        nonlocal place
        value = all_of()
        while place < len(words) and words[place] == "OR":
            place += 1
            value = all_of() or value
        return value

    return bool(words) and either()


def main() -> int:
    rules = tomllib.loads((ROOT / "deny.toml").read_text(encoding="utf-8"))["licenses"]
    allowed = set(rules["allow"])
    told = {rule["crate"]: rule["expression"] for rule in rules.get("clarify", [])}
    refused, seen = [], set()
    for manifest in ("Cargo.toml", "bindings/python/Cargo.toml", "bindings/web/engine/Cargo.toml"):
        command = ["cargo", "metadata", "--format-version", "1", "--locked", "--manifest-path", manifest]
        answer = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout
        for package in json.loads(answer)["packages"]:
            name, licence = package["name"], told.get(package["name"]) or package["license"] or ""
            if name not in seen and not accepted(licence, allowed):
                refused.append(f"{name} {package['version']}: {licence or 'no licence is named'}")
            seen.add(name)
    # what the page is bundled of and with: npm's lock file has the licences
    lock = json.loads((ROOT / "bindings/web/package-lock.json").read_text(encoding="utf-8"))
    for place, package in lock["packages"].items():
        licence = package.get("license", "")
        if place and not accepted(licence, allowed):
            refused.append(f"{place} {package['version']}: {licence or 'no licence is named'}")
        seen.add(place or "the page")
    assert accepted("MIT OR X", {"MIT"}) and not accepted("MIT AND X", {"MIT"}) and accepted("(X OR MIT) AND ISC", {"MIT", "ISC"})
    print("\n".join(refused) or f"licences: all of {len(seen)} packages are accepted")
    return 1 if refused else 0


if __name__ == "__main__":
    sys.exit(main())
