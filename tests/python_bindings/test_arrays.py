# SPDX-License-Identifier: MPL-2.0
"""Numbers into and out of the library."""
import array
import ctypes

import numpy
import pytest

from npfem._arrays import Output, read_in


def address(pointer):
    return ctypes.cast(pointer, ctypes.c_void_p).value


def test_a_contiguous_array_is_not_copied():
    values = numpy.arange(6.0).reshape(2, 3)
    pointer, length = read_in(values, "d")
    assert (address(pointer), length) == (values.ctypes.data, 6)


def test_an_array_array_is_not_copied():
    values = array.array("d", [1.0, 2.0, 3.0])
    pointer, length = read_in(values, "d")
    assert (address(pointer), length) == (values.buffer_info()[0], 3)


@pytest.mark.parametrize("values", [[[1, 2], [3, 4]], (1.0, 2.0, 3.0, 4.0), numpy.array([[1, 2], [3, 4]], dtype="i2"),
                                    numpy.array([[1, 3], [2, 4]]).T, array.array("f", [1, 2, 3, 4])])
def test_other_sequences_are_converted(values):
    pointer, length = read_in(values, "d")
    assert [pointer[index] for index in range(length)] == [1.0, 2.0, 3.0, 4.0]


def test_a_read_only_array_is_accepted():
    values = numpy.arange(3.0)
    values.flags.writeable = False
    assert read_in(values, "d")[1] == 3


@pytest.mark.parametrize("values, code", [(["a"], "d"), ([1 + 2j], "d"), ([0.5, 1.0], "i")])
def test_what_is_not_a_number_of_the_kind_is_refused(values, code):
    with pytest.raises(TypeError):
        read_in(values, code)


def test_output_has_the_shape_asked_for():
    out = Output("d", 2, 5, 3)
    out.pointer[29] = 7.0
    assert out.values.shape == (2, 5, 3)
    assert out.values[1, 4, 2] == 7.0
