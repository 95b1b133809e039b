#!/usr/bin/env python3
"""Licences, sources and doubles of the libraries in Cargo.lock; exit code 1 where one is not accepted.

Advisories are not looked at: their database is fetched from the network.
"""

import collections
import json
import subprocess
import sys

# Permissive licences, with which railcrack can be passed on under MIT or Apache-2.0.
ACCEPTED = {
    "0BSD", "Apache-2.0", "Apache-2.0 WITH LLVM-exception", "BSD-2-Clause", "BSD-3-Clause", "BSL-1.0", "CC0-1.0",
    "ISC", "MIT", "MIT-0", "Unicode-3.0", "Unlicense", "Zlib",
}
SOURCE = "registry+https://github.com/rust-lang/crates.io-index"


def is_accepted(expression):
    """Whether one side of every `AND` has an accepted choice; `/` is the old way to write `OR`."""
    expression = expression.replace("/", " OR ").replace("(", " ( ").replace(")", " ) ")
    tokens = expression.split()

    def alternatives():
        value = parts()
        while tokens and tokens[0] == "OR":
            tokens.pop(0)
            value = parts() or value
        return value

    def parts():
        value = one()
        while tokens and tokens[0] == "AND":
            tokens.pop(0)
            value = one() and value
        return value

    def one():
        if not tokens:
            return False
        token = tokens.pop(0)
        if token == "(":
            value = alternatives()
            return bool(tokens) and tokens.pop(0) == ")" and value
        if tokens and tokens[0] == "WITH":
            tokens.pop(0)
            token = f"{token} WITH {tokens.pop(0) if tokens else ''}"
        return token in ACCEPTED

    value = alternatives()
    return value and not tokens


def main(arguments):
    command = ["cargo", "metadata", "--format-version", "1", "--locked", *arguments]
    packages = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)["packages"]
    wrong = []
    versions = collections.defaultdict(set)
    for package in packages:
        name = f"{package['name']} {package['version']}"
        versions[package["name"]].add(package["version"])
        if not is_accepted(package["license"] or ""):
            wrong.append(f"{name}: licence {package['license']} is not accepted")
        if package["source"] not in (None, SOURCE):
            wrong.append(f"{name}: comes from {package['source']}, not from crates.io")
    doubles = {name: sorted(found) for name, found in versions.items() if len(found) > 1}
    for name, found in sorted(doubles.items()):
        print(f"{name} in {len(found)} versions: {', '.join(found)}")
    for line in wrong:
        print(line, file=sys.stderr)
    print(f"{len(packages)} packages, {len(wrong)} not accepted, {len(doubles)} in several versions")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
