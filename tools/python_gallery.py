"""Pictures of docs/python/gallery.md, by the code on that page.

    python_gallery.py

Needs the package with `railcrack[all]`. Writes docs/figures/python/*.png.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/python/gallery.md"
PICTURES = ROOT / "docs/figures/python"
SETTINGS = "backend: Agg\nsavefig.dpi: 72\n"


def main():
    PICTURES.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        shutil.copytree(ROOT / "cases", place / "cases")
        (place / "matplotlibrc").write_text(SETTINGS)
        for block in re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.S):
            code = block.replace('.png")', '.png", metadata={"Software": None})')
            subprocess.run([sys.executable, "-c", code], cwd=place, check=True)
        for picture in sorted(place.glob("*.png")):
            shutil.copy(picture, PICTURES)
            print(f"{picture.name}: {picture.stat().st_size} bytes")


if __name__ == "__main__":
    main()
