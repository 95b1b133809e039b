"""The `railcrack` command of the package."""

import sys

from . import _railcrack


def main() -> None:
    """Does what the command line asks for, and ends with its exit code."""
    sys.exit(_railcrack.command(["railcrack", *sys.argv[1:]]))
