"""What the released program is made of: a bill of materials, and the licences of its libraries.

    bill_of_materials.py TARGET BILL LICENCES

BILL is a file of CycloneDX 1.5 (JSON) with every library of Rust in the program for TARGET, features of released programs on, with
its checksum of Cargo.lock and what it depends on, and the libraries and fonts that the sources include. LICENCES is one text with
their licences, which those who pass the program on must pass on too. Both are the same for the same sources. Ends with 1 where a
library has neither a licence expression nor a text.
"""

import hashlib
import json
import os
import re
import subprocess
import sys
import tomllib
import uuid
from datetime import datetime, timezone
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PROGRAM = "railcrack-cli"
LICENCE_FILE = re.compile(r"^(licen[cs]e|copying|notice|unlicense|copyright|ofl)", re.IGNORECASE)
FONTS = ROOT / "crates/railcrack-cli/fonts"


def metadata(target):
    command = ["cargo", "metadata", "--format-version", "1", "--locked", "--filter-platform", target, "--features", f"{PROGRAM}/png"]
    return json.loads(subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout)


def compiled(target):
    """Names and versions of what `cargo tree` says is compiled into the program: no macros, no build scripts."""
    command = ["cargo", "tree", "--locked", "--package", PROGRAM, "--features", "png", "--target", target]
    command += ["--edges", "normal,no-proc-macro", "--prefix", "none", "--no-dedupe", "--format", "{p}"]
    lines = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.splitlines()
    return {(line.split()[0], line.split()[1].removeprefix("v")) for line in lines if line}


def in_the_program(found, compiled):
    """Packages whose code is in the program, by their identifiers, with what each depends on."""
    packages = {package["id"]: package for package in found["packages"]}
    nodes = {node["id"]: node for node in found["resolve"]["nodes"]}
    root = next(key for key, package in packages.items() if package["name"] == PROGRAM)
    needs, pending = {}, [root]
    while pending:
        key = pending.pop()
        if key in needs:
            continue
        own = [dep["pkg"] for dep in nodes[key]["deps"] if any(kind["kind"] is None for kind in dep["dep_kinds"])]
        own = [dep for dep in own if (packages[dep]["name"], packages[dep]["version"]) in compiled]
        needs[key] = sorted(own)
        pending.extend(own)
    return root, packages, needs


def url(package):
    return f"pkg:cargo/{package['name']}@{package['version']}"


def component(package, checksums):
    own = {"type": "library", "bom-ref": url(package), "name": package["name"], "version": package["version"], "purl": url(package)}
    if package.get("description"):
        own["description"] = " ".join(package["description"].split())
    if package.get("license"):
        # Older crates write "MIT/Apache-2.0".
        own["licenses"] = [{"expression": package["license"].replace("/", " OR ")}]
    checksum = checksums.get((package["name"], package["version"]))
    if checksum:
        own["hashes"] = [{"alg": "SHA-256", "content": checksum}]
    if package.get("repository"):
        own["externalReferences"] = [{"type": "vcs", "url": package["repository"]}]
    return own


def of_the_compilers():
    """The standard library of Rust, and what zig links: musl and its own functions for memory."""
    version = subprocess.run(["rustc", "--version"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split()[1]
    rust = {"type": "library", "bom-ref": f"rust-std@{version}", "name": "rust-std", "version": version, "licenses": [{"expression": "MIT OR Apache-2.0"}]}
    version = re.search(r"ziglang==(\S+)", (ROOT / "tools/release_tools.sh").read_text()).group(1)
    zig = {"type": "library", "bom-ref": f"zig-compiler-rt@{version}", "name": "zig-compiler-rt", "version": version, "licenses": [{"expression": "MIT"}]}
    musl = {"type": "library", "bom-ref": "musl", "name": "musl", "licenses": [{"expression": "MIT"}], "description": f"As it comes with zig {version}"}
    return [rust, zig, musl]


def included():
    """Files of others in the sources: the scripts of the reports and the fonts of the plots."""
    found = []
    for folder, licence, kind in [(SCRIPTS, "ISC", "library"), (FONTS, "OFL-1.1", "data")]:
        for line in (folder / "SHA256SUMS").read_text().splitlines():
            checksum, name = line.split()
            if LICENCE_FILE.match(name):
                continue
            head = (folder / name).read_bytes()[:300].decode(errors="replace")
            version = re.search(r"\bv(\d+\.\d+\.\d+)", head)
            own = {"type": kind, "bom-ref": f"file:{name}", "name": name, "licenses": [{"expression": licence}], "hashes": [{"alg": "SHA-256", "content": checksum}]}
            if version:
                own["version"] = version.group(1)
            found.append(own)
    return found


def licences(packages, needs):
    """Every text once, with the libraries under it."""
    texts, without = {}, []
    for key in needs:
        package = packages[key]
        folder = Path(package["manifest_path"]).parent
        if package["source"] is None:
            continue
        name = f"{package['name']} {package['version']}"
        files = sorted(path for path in folder.rglob("*") if path.is_file() and LICENCE_FILE.match(path.name) and path.suffix in ("", ".md", ".txt"))
        if not files and not package.get("license"):
            raise SystemExit(f"{name} has no licence")
        if not files:
            without.append(f"{name}: {package['license']}")
        for path in files:
            text = path.read_text(errors="replace").strip()
            texts.setdefault(text, set()).add(name)
    for path in sorted(FONTS.iterdir()):
        if LICENCE_FILE.match(path.name):
            texts.setdefault(path.read_text().strip(), set()).add("Liberation fonts")
    mit = (ROOT / "LICENSE-MIT").read_text()
    for name, holder in [("rust-std", "The Rust Project contributors"), ("musl", "2005-2020 Rich Felker, et al."), ("zig-compiler-rt", "Zig contributors")]:
        texts.setdefault(re.sub(r"Copyright \(c\).*", f"Copyright (c) {holder}", mit).strip(), set()).add(name)
    parts = [f"{', '.join(sorted(names))}\n\n{text}\n" for text, names in sorted(texts.items(), key=lambda item: sorted(item[1]))]
    if without:
        parts.append("Without a text of their own\n\n" + "\n".join(sorted(without)) + "\n")
    return f"\n{'=' * 80}\n\n".join(["Licences of the libraries in this program.\n", *parts])


def main():
    target, bill, notices = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    root, packages, needs = in_the_program(metadata(target), compiled(target))
    with open(ROOT / "Cargo.lock", "rb") as lock:
        checksums = {(one["name"], one["version"]): one.get("checksum") for one in tomllib.load(lock)["package"]}
    others = sorted((packages[key] for key in needs if key != root), key=url)
    program = {**component(packages[root], checksums), "type": "application"}
    files = of_the_compilers() + included()
    components = [component(package, checksums) for package in others] + files
    depends = [{"ref": url(packages[key]), "dependsOn": sorted(url(packages[own]) for own in own_needs)} for key, own_needs in needs.items()]
    depends.sort(key=lambda one: one["ref"])
    for one in depends:
        if one["ref"] == program["bom-ref"]:
            one["dependsOn"] += [own["bom-ref"] for own in files]
    content = hashlib.sha256(json.dumps([program, components, depends], sort_keys=True).encode()).hexdigest()
    # The time of the sources, so that the same sources give the same file.
    when = datetime.fromtimestamp(int(os.environ.get("SOURCE_DATE_EPOCH", "0")), timezone.utc)
    text = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "serialNumber": f"urn:uuid:{uuid.uuid5(uuid.NAMESPACE_URL, content)}",
        "version": 1,
        "metadata": {
            "timestamp": when.strftime("%Y-%m-%dT%H:%M:%SZ"),
            "component": program,
            "properties": [{"name": "railcrack:target", "value": target}, {"name": "railcrack:features", "value": "png"}],
        },
        "components": components,
        "dependencies": depends,
    }
    bill.write_text(json.dumps(text, indent=1, ensure_ascii=False) + "\n")
    notices.write_text(licences(packages, needs))
    print(f"{len(components)} components in {bill}")


if __name__ == "__main__":
    main()
