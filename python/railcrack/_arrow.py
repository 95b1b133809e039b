"""Tables as streams of the Arrow C data interface, without an Arrow library and without copies.

Source: *The Arrow C data interface* and *The Arrow C stream interface* (Apache Arrow), and the
PyCapsule interface built on them.
"""

from __future__ import annotations

import ctypes
from collections.abc import Mapping, Sequence
from ctypes import CFUNCTYPE, POINTER, Structure, c_char_p, c_int, c_int64, c_void_p, cast, pointer, py_object
from typing import Any

import numpy as np
from numpy.typing import NDArray


class _Schema(Structure):
    pass


class _Array(Structure):
    pass


class _Stream(Structure):
    pass


# Any: ctypes has no types for callbacks.
_Release: Any = CFUNCTYPE(None, c_void_p)
_GetSchema: Any = CFUNCTYPE(c_int, c_void_p, POINTER(_Schema))
_GetNext: Any = CFUNCTYPE(c_int, c_void_p, POINTER(_Array))
_LastError: Any = CFUNCTYPE(c_void_p, c_void_p)

_Schema._fields_ = [
    ("format", c_char_p),
    ("name", c_char_p),
    ("metadata", c_char_p),
    ("flags", c_int64),
    ("n_children", c_int64),
    ("children", POINTER(POINTER(_Schema))),
    ("dictionary", POINTER(_Schema)),
    ("release", c_void_p),
    ("private_data", c_void_p),
]
_Array._fields_ = [
    ("length", c_int64),
    ("null_count", c_int64),
    ("offset", c_int64),
    ("n_buffers", c_int64),
    ("n_children", c_int64),
    ("buffers", POINTER(c_void_p)),
    ("children", POINTER(POINTER(_Array))),
    ("dictionary", POINTER(_Array)),
    ("release", c_void_p),
    ("private_data", c_void_p),
]
_Stream._fields_ = [
    ("get_schema", c_void_p),
    ("get_next", c_void_p),
    ("get_last_error", c_void_p),
    ("release", c_void_p),
    ("private_data", c_void_p),
]

_NULLABLE = 2

# Objects kept alive while a consumer holds an exported structure: its children and buffers, by the
# number in its private_data. The address cannot be the key, because the consumer may move the
# structure.
_kept: dict[int, tuple[list[Any], Any]] = {}
_count = iter(range(1, 2**62))


def _keep(below: list[Any], others: Any) -> int:
    number = next(_count)
    _kept[number] = (below, others)
    return number


def _let_go(structure: Any) -> None:
    """Releases a structure and those of its children that the consumer has not moved."""
    below, _ = _kept.pop(structure.private_data, ([], None))
    structure.release = None
    for part in below:
        if part.release:
            _let_go(part)


def _release_of(kind: Any) -> Any:
    return _Release(lambda address: _let_go(cast(address, POINTER(kind)).contents))


_release_schema, _release_array, _release_stream = map(_release_of, (_Schema, _Array, _Stream))


def _address(function: Any) -> int | None:
    return cast(function, c_void_p).value


def _children(children: Sequence[Any], kind: Any) -> Any:
    return (POINTER(kind) * len(children))(*(pointer(child) for child in children))


def _schema(format_: str, name: str = "", children: Sequence[Any] = (), dictionary: Any = None, flags: int = _NULLABLE) -> _Schema:
    below = [*children, *([] if dictionary is None else [dictionary])]
    kept = [format_.encode(), name.encode(), _children(children, _Schema)]
    schema = _Schema(kept[0], kept[1], None, flags, len(children), kept[2] if children else None)
    if dictionary is not None:
        schema.dictionary = pointer(dictionary)
    schema.release, schema.private_data = _address(_release_schema), _keep(below, kept)
    return schema


def _array(length: int, buffers: Sequence[Any], nulls: int = 0, children: Sequence[Any] = (), dictionary: Any = None) -> _Array:
    addresses = [None if buffer is None else buffer.ctypes.data for buffer in buffers]
    below = [*children, *([] if dictionary is None else [dictionary])]
    pointers, parts = (c_void_p * len(buffers))(*addresses), _children(children, _Array)
    kept = [buffers, pointers, parts]
    array = _Array(length, nulls, 0, len(buffers), len(children), pointers, parts if children else None)
    if dictionary is not None:
        array.dictionary = pointer(dictionary)
    array.release, array.private_data = _address(_release_array), _keep(below, kept)
    return array


def _texts(texts: Sequence[str]) -> tuple[str, _Array]:
    encoded = [text.encode() for text in texts]
    offsets = np.zeros(len(encoded) + 1, np.int64)
    np.cumsum([len(text) for text in encoded], out=offsets[1:])
    content = np.frombuffer(b"".join(encoded) or b"\0", np.uint8)
    return "U", _array(len(encoded), [None, offsets, content])


def _validity(valid: NDArray[np.bool_]) -> tuple[Any, int]:
    nulls = int(valid.size - np.count_nonzero(valid))
    return (np.packbits(valid, bitorder="little"), nulls) if nulls else (None, 0)


Column = tuple[NDArray[Any] | Sequence[str], Sequence[str] | None]
"""Numbers or strings; or codes, −1 for none, with the strings that they denote."""


def _column(name: str, column: Column, wanted: str) -> _Schema | _Array:
    """Schema or array of a column."""
    values, words = column
    if words is not None:
        codes = np.asarray(values, np.int32)
        if wanted == "schema":
            return _schema("i", name, dictionary=_schema("U"))
        validity, nulls = _validity(codes >= 0)
        return _array(len(codes), [validity, codes], nulls, dictionary=_texts(words)[1])
    if not isinstance(values, np.ndarray):
        return _schema("U", name) if wanted == "schema" else _texts(values)[1]
    if values.dtype == np.int64:
        return _schema("l", name) if wanted == "schema" else _array(len(values), [None, values])
    if wanted == "schema":
        return _schema("g", name)
    values = np.ascontiguousarray(values, np.float64)
    validity, nulls = _validity(~np.isnan(values))
    return _array(len(values), [validity, values], nulls)


def stream(columns: Mapping[str, Column]) -> Any:
    """A capsule `arrow_array_stream` with all rows in one batch. It shares memory with the arrays,
    which are kept alive as long as a consumer needs them; missing numbers are null."""
    length = max((len(values) for values, _ in columns.values()), default=0)
    given = False

    def get_schema(_stream: int, out: Any) -> int:
        children = [_column(name, column, "schema") for name, column in columns.items()]
        _hand_over(_schema("+s", children=children, flags=0), out)
        return 0

    def get_next(_stream: int, out: Any) -> int:
        nonlocal given
        if given:
            out.contents.release = None
        else:
            children = [_column(name, column, "array") for name, column in columns.items()]
            _hand_over(_array(length, [None], children=children), out)
        given = True
        return 0

    def get_last_error(_stream: int) -> None:
        return None

    calls = [_GetSchema(get_schema), _GetNext(get_next), _LastError(get_last_error)]
    made = _Stream(*map(_address, [*calls, _release_stream]))
    made.private_data = _keep([], [columns, calls])
    return _capsule(made)


def _hand_over(structure: Any, out: Any) -> None:
    """Moves a structure and the objects that it keeps alive to the memory of the consumer."""
    ctypes.memmove(out, ctypes.byref(structure), ctypes.sizeof(structure))


_NAME = b"arrow_array_stream"
_new_capsule = ctypes.pythonapi.PyCapsule_New
_new_capsule.restype = py_object
_new_capsule.argtypes = [c_void_p, c_char_p, c_void_p]
_pointer_of = ctypes.pythonapi.PyCapsule_GetPointer
_pointer_of.restype = c_void_p
_pointer_of.argtypes = [c_void_p, c_char_p]
# The streams of live capsules, by address.
_streams: dict[int, _Stream] = {}


def _destroy(capsule: int) -> None:
    address = _pointer_of(capsule, _NAME)
    made = _streams.pop(address, None)
    # A consumer that has taken over the stream has set release to null.
    if made is not None and made.release:
        _let_go(made)


_destructor: Any = CFUNCTYPE(None, c_void_p)(_destroy)


def _capsule(made: _Stream) -> Any:
    address = ctypes.addressof(made)
    _streams[address] = made
    return _new_capsule(address, _NAME, _address(_destructor))
