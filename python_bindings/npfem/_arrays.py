# SPDX-License-Identifier: MPL-2.0
"""Numbers into and out of the library, with numpy where it is present and without it where it is not.

In: any sequence, nested or flat, array.array or numpy array; contiguous arrays of the right type are not copied.
Out: a numpy array of the shape stated, or, without numpy, a flat array.array.
"""
import array
import ctypes

try:
    import numpy
except ImportError:
    numpy = None

_C_TYPES = {"d": ctypes.c_double, "f": ctypes.c_float, "i": ctypes.c_int32, "q": ctypes.c_int64}
_NUMPY_TYPES = {"d": "f8", "f": "f4", "i": "i4", "q": "i8"}


def _flatten(values):
    for value in values:
        if hasattr(value, "__iter__") and not isinstance(value, str):
            yield from _flatten(value)
        else:
            yield value


def read_in(values, code):
    """(pointer, length) of `values` as C numbers of type `code`; the pointer keeps the numbers alive."""
    c_type = _C_TYPES[code]
    if numpy is not None and not isinstance(values, array.array):
        block = numpy.ascontiguousarray(values)
        if block.dtype.kind not in "iuf" and block.size:
            raise TypeError("numbers expected, found an array of %s" % block.dtype)
        if code == "i" and block.dtype.kind == "f" and block.size:
            raise TypeError("whole numbers expected, found an array of %s" % block.dtype)
        block = numpy.ascontiguousarray(block, dtype=_NUMPY_TYPES[code])
        return block.ctypes.data_as(ctypes.POINTER(c_type)), block.size
    if isinstance(values, array.array) and values.typecode == code and len(values):
        return (c_type * len(values)).from_buffer(values), len(values)
    flat = list(_flatten(values))
    return (c_type * len(flat))(*flat), len(flat)


class Output:
    """Room for `shape` numbers of type `code`: `pointer` and `length` go to the library, `values` to the caller."""

    def __init__(self, code, *shape):
        self.length = 1
        for count in shape:
            self.length *= count
        c_type = _C_TYPES[code]
        if numpy is not None:
            self.values = numpy.zeros(shape, dtype=_NUMPY_TYPES[code])
            self.pointer = self.values.ctypes.data_as(ctypes.POINTER(c_type))
        else:
            self.values = array.array(code, bytes(ctypes.sizeof(c_type) * self.length))
            self.pointer = (c_type * self.length).from_buffer(self.values) if self.length else None
