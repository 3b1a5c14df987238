"""Files as the importers read and write them: whole, with messages that name file and place."""

import contextlib
import os
import pathlib
import tempfile
from typing import Callable, Iterator

MOST_BYTES = 64_000_000


class BadFile(ValueError):
    """A file that cannot be imported. The message has file, line where one is known, what was found and
    what was expected, in one line."""

    def __init__(self, file: "str | os.PathLike[str]", found: str, expected: str, line: "int | None" = None) -> None:
        place = f"{file}:{line}" if line else f"{file}"
        super().__init__(" ".join(f"{place}: found {found}, expected {expected}".split()))


@contextlib.contextmanager
def readable(file: "str | os.PathLike[str]", expected: str) -> Iterator[None]:
    """An OSError of what reads within becomes a BadFile: it is the input's fault, as one of what writes is not."""
    try:
        yield
    except OSError as error:
        found = f"a file that cannot be read ({error.strerror or error})"
        raise BadFile(error.filename or file, found, expected) from None


def read(file: "str | os.PathLike[str]", expected: str) -> bytes:
    """The bytes of a regular file that holds more than white space and zeros."""
    path = pathlib.Path(file)
    with readable(file, expected):
        if not path.exists():
            raise BadFile(file, "no such file", expected)
        if not path.is_file():
            raise BadFile(file, "a folder" if path.is_dir() else "no regular file", expected)
        if path.stat().st_size > MOST_BYTES:
            raise BadFile(file, f"{path.stat().st_size} bytes", f"at most {MOST_BYTES}")
        content = path.read_bytes()
    if not content.strip(b"\0 \t\r\n"):
        raise BadFile(file, f"{len(content)} bytes without content", expected)
    return content


def write_whole(
    file: pathlib.Path, text: str, force: bool, check: Callable[[pathlib.Path], None] = lambda part: None
) -> None:
    """Writes a file whole or not at all: it takes its place once `check` has had it, under another name.

    Raises FileExistsError where one stands and `force` is not given.
    """
    if file.exists() and not force:
        raise FileExistsError(f"{file}: stands already; --force replaces it")
    handle, name = tempfile.mkstemp(dir=file.parent, prefix=f".{file.stem}.", suffix=file.suffix)
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as stream:
            stream.write(text)
        check(pathlib.Path(name))
        os.chmod(name, 0o666 & ~_umask())
        os.replace(name, file)
    except BaseException:
        with contextlib.suppress(FileNotFoundError):
            os.unlink(name)
        raise


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
