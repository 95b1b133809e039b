"""The `railcrack` command of the package."""

import sys

from . import _railcrack


def main() -> None:
    """Executes the command line and exits with its exit code."""
    sys.exit(_railcrack.command(["railcrack", *sys.argv[1:]]))
