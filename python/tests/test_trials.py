"""Tables of sweeps in Python are those of trials.csv."""

import csv
import subprocess
import sys

import pytest

import slalom
from sweeps import STUDY, study, sweep

pa = pytest.importorskip("pyarrow")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    where = tmp_path_factory.mktemp("sweep")
    sweep(study(where, STUDY.replace("[0.25, 0.5, 9]", "[0.25, 9]") +
                "  - {key: planner.scheme, values: [trapezoidal]}\n"
                "  - {key: planner.X0_tol, values: [[.5, .5, .5, .005, .5, .25, .5, .5]]}\n"
                "  - {key: title, values: ['2020-01-01']}\n"), where / "out")
    return where / "out"


def test_a_table_has_the_columns_and_rows_of_the_file(folder):
    table = slalom.read_trials(folder)
    with open(folder / "trials.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert table.column_names == list(rows[0])
    assert table.num_rows == len(rows) == 8
    assert [table["trial"].type, table["cycles"].type, table["loop.tex"].type, table["time_s"].type] == [
        pa.int64(), pa.int64(), pa.float64(), pa.float64()]
    # Words stay words, whatever they look like.
    for name in ("planner.scheme", "planner.X0_tol", "title", "scenario", "marks", "identity", "message"):
        assert table[name].type == pa.string(), name
    for name, column in zip(table.column_names, table.columns):
        for value, row in zip(column.to_pylist(), rows):
            assert value == (None if row[name] == "" else type(value)(row[name])), (name, row)
    assert table["time_s"].null_count == 4 and table["outcome"].to_pylist().count("invalid") == 4
    frame = table.to_pandas()
    assert set(frame[frame["outcome"] == "timeout"]["scenario"]) == {"E_A", "E_B"}


def test_parquet_is_the_same_table(folder, tmp_path):
    file = tmp_path / "trials.parquet"
    slalom.write_parquet(folder, file)
    import pyarrow.parquet
    assert pyarrow.parquet.read_table(file).equals(slalom.read_trials(folder))
    assert [path.name for path in tmp_path.iterdir()] == ["trials.parquet"]
    with pytest.raises(OSError):
        slalom.write_parquet(folder, tmp_path / "none" / "trials.parquet")


def test_parquet_is_written_through_no_link(folder, tmp_path, monkeypatch):
    victim, aside = tmp_path / "victim", tmp_path / ".trials.parquet.foreseen.aside"
    victim.write_text("precious")
    aside.symlink_to(victim)
    monkeypatch.setattr("secrets.token_hex", lambda size: "foreseen")
    with pytest.raises(FileExistsError):
        slalom.write_parquet(folder, tmp_path / "trials.parquet")
    assert victim.read_text() == "precious" and aside.is_symlink()
    assert not (tmp_path / "trials.parquet").exists()


def test_a_folder_without_a_sweep_is_refused(tmp_path):
    with pytest.raises(slalom.Error, match="no results of a sweep"):
        slalom.read_trials(tmp_path)
    with pytest.raises(slalom.Error, match="no results of a sweep"):
        slalom.write_parquet(tmp_path, tmp_path / "t.parquet")
    assert list(tmp_path.iterdir()) == []


def test_a_sweep_at_work_can_be_read(tmp_path):
    from slalom._core import OpenSweep
    work = OpenSweep(str(study(tmp_path)), tmp_path / "out")
    trial, _ = work.next()
    work.record_failed(trial, 'said "no", twice\nthen died')
    table = slalom.read_trials(tmp_path / "out")
    assert table["outcome"].to_pylist() == ["failed"]
    assert table["message"].to_pylist() == ['said "no", twice\nthen died']
    assert table["time_s"].to_pylist() == [None]


def test_without_pyarrow_it_is_said(folder):
    script = ("import sys; sys.modules['pyarrow'] = None\nimport slalom\n"
              f"slalom.read_trials({str(folder)!r})")
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.stderr.splitlines()[-1] == (
        "ImportError: read_trials needs pyarrow: pip install 'slalom[sweep]'")
