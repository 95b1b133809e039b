"""The scorer of the benchmark: each solution scores zero against itself, a known error is found as it is."""

from __future__ import annotations

import csv
import math
from pathlib import Path

import pytest

from railcrack import benchmark

FOLDER = Path(__file__).parents[2] / "benchmark"


def written(path: Path, name: str, **factors: float) -> Path:
    """The solution of a problem as a result, with some columns times a factor."""
    rows = benchmark.read_rows(FOLDER / name / "solution.csv")[1]
    with open(path, "w", newline="") as file:
        file.write(f"# problem: {name.split('-')[0]}\n")
        out = csv.DictWriter(file, list(rows[0]))
        out.writeheader()
        for row in rows:
            out.writerow({k: float(v) * factors[k] if k in factors and v else v for k, v in row.items()})
    return path


def test_fifteen_problems() -> None:
    names = benchmark.problems(FOLDER)
    assert [name[:2] for name in names] == [f"{i:02}" for i in range(1, 16)]
    for name in names:
        assert {path.name for path in (FOLDER / name).iterdir()} >= {
            "README.md",
            "geometry.svg",
            "problem.toml",
            "solution.csv",
        }


@pytest.mark.parametrize("name", benchmark.problems(FOLDER))
def test_a_solution_is_itself(name: str, tmp_path: Path) -> None:
    the, found = benchmark.read_result(written(tmp_path / "result.csv", name), FOLDER)
    assert {part["name"] for part in the.data["part"]} == {key[0] for key, _ in the.solution}
    for row in benchmark.score(the, found):
        assert row.missing == 0
        assert math.isnan(row.by_position) or row.by_position < 1e-9
        # Every column has an error bar, but what is derived or not judged.
        assert row.column.startswith(("g_", "ep_")) or row.error_bar >= 0.0 or row.peak == 0.0


def test_a_known_error_is_found(tmp_path: Path) -> None:
    path = written(tmp_path / "result.csv", "03-inclined-friction", kii_mpa_sqrt_m=1.01)
    the, found = benchmark.read_result(path, FOLDER)
    rows = [row for row in benchmark.score(the, found) if row.column == "kii_mpa_sqrt_m"]
    # Of the largest |K|, which in all parts but one is that of K_II.
    assert sum(abs(row.by_position - 1.0) < 1e-6 for row in rows) == 6
    assert all(0.0 < row.of_peak <= 1.0 + 1e-6 for row in rows)


def test_a_shift_of_a_steep_fall_is_forgiven(tmp_path: Path) -> None:
    name = "03-inclined-friction"
    rows = benchmark.read_rows(FOLDER / name / "solution.csv")[1]
    with open(tmp_path / "shifted.csv", "w") as file:
        file.write("part,xc_over_a,kii_mpa_sqrt_m\n")
        for row in rows:
            file.write(f"{row['part']},{float(row['xc_over_a']) + 0.004},{row['kii_mpa_sqrt_m']}\n")
    the, found = benchmark.read_result(tmp_path / "shifted.csv", FOLDER, "3")
    for row in benchmark.score(the, found):
        assert row.missing == 1 and row.shifted < 0.01 < row.by_position


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    result = written(tmp_path / "result.csv", "01-edge-crack", ki_mpa_sqrt_m=1.02)
    options = ["--benchmark", str(FOLDER), "--table", str(tmp_path / "table.csv")]
    assert benchmark.main(["score", str(result), *options]) == 0
    assert "largest difference: 2.000 % of the peak" in capsys.readouterr().out
    assert (tmp_path / "result.svg").read_text().startswith("<svg")
    assert len((tmp_path / "table.csv").read_text().splitlines()) == 22
    # A result of one part that names neither problem nor part.
    (tmp_path / "bare.csv").write_text("xc_over_a,ki_mpa_sqrt_m\n0,15.4\n")
    assert benchmark.main(["score", str(tmp_path / "bare.csv"), *options]) == 2
    assert "does not say its problem" in capsys.readouterr().err
    assert benchmark.main(["score", str(tmp_path / "bare.csv"), "--problem", "1", *options]) == 2
    assert "needs a column `part`" in capsys.readouterr().err
    (tmp_path / "bare.csv").write_text("# problem: 1\n# part: tension-90\nxc_over_a,ki_mpa_sqrt_m\n0,15.4\n")
    assert benchmark.main(["score", str(tmp_path / "bare.csv"), *options]) == 0
