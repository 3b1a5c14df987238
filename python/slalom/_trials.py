"""The table of a sweep, behind the extra `sweep`."""

from __future__ import annotations

import contextlib
import fcntl
import io
import os
import pathlib
import secrets
from typing import Any

from ._core import trials_csv

TEXT = {"scenario", "planner", "outcome", "hit", "least_clearance_obstacle", "marks", "identity", "message"}
COUNTS = {"trial", "repeat", "cycles", "failed_cycles", "iterations", "new_plans", "rests", "least_bads"}


def _arrow(caller: str) -> Any:
    try:
        import pyarrow.csv
        import pyarrow.parquet
    except ImportError as error:
        raise ImportError(f"{caller} needs pyarrow: pip install 'slalom[sweep]'") from error
    return pyarrow


def _typed(arrow: Any, name: str, column: Any) -> Any:
    """Counts as integers, other figures and axes of numbers as doubles, all else as text."""
    if name in TEXT:
        return column
    if name in COUNTS:
        return column.cast(arrow.int64())
    try:
        return column.cast(arrow.float64())
    except arrow.ArrowInvalid:  # an axis of words or lists
        return column


def _read(arrow: Any, folder: str | os.PathLike[str]) -> Any:
    text = trials_csv(pathlib.Path(folder)).encode()
    names = arrow.csv.read_csv(io.BytesIO(text)).column_names
    table = arrow.csv.read_csv(
        io.BytesIO(text),
        parse_options=arrow.csv.ParseOptions(newlines_in_values=True),
        convert_options=arrow.csv.ConvertOptions(
            column_types={name: arrow.string() for name in names}, strings_can_be_null=True,
            null_values=[""]))
    return arrow.table({name: _typed(arrow, name, table[name]) for name in names})


def read_trials(folder: str | os.PathLike[str]) -> Any:
    """The trials that stand in the folder of a sweep, of one that is at work too, as a pyarrow.Table:
    one row a trial and the columns of trials.csv (docs/studies.md); what does not exist is null.
    Raises Error when the folder holds no sweep, ImportError without the extra `sweep`."""
    return _read(_arrow("read_trials"), folder)


def write_parquet(folder: str | os.PathLike[str], file: str | os.PathLike[str]) -> None:
    """Writes the table of read_trials as a Parquet file, whole or not at all."""
    arrow = _arrow("write_parquet")
    table = _read(arrow, folder)
    target = pathlib.Path(file)
    # As the program writes files: under a name that nobody can foresee, in a folder that is in use.
    aside = target.with_name(f".{target.name[:150]}.{secrets.token_hex(8)}.aside")
    parent = os.open(target.parent, os.O_RDONLY | os.O_DIRECTORY)
    try:
        with contextlib.suppress(OSError):  # where there are no locks
            fcntl.flock(parent, fcntl.LOCK_SH)
        sink = open(aside, "xb")  # what stands there already stays
        try:
            with sink:
                arrow.parquet.write_table(table, sink)
            os.replace(aside, target)
        finally:
            aside.unlink(missing_ok=True)
    finally:
        os.close(parent)
