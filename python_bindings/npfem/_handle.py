# SPDX-License-Identifier: MPL-2.0
"""What the objects of the library share: a handle that is released once, and parameters by key."""
import ctypes
import weakref

from ._library import call, call_for_text, library


def _release(handle):
    library().npfem_release(handle)


class Handle:
    """An object of the library. Use it in a `with` block, or call close(); else it goes with the last reference."""

    def __init__(self, handle):
        self.handle = handle
        self._finalizer = weakref.finalize(self, _release, handle)

    def close(self):
        """Releases the object; using it afterwards raises `npfem.Error` (a stale handle)."""
        self._finalizer()

    @property
    def closed(self):
        """True after close()."""
        return not self._finalizer.alive

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class Parameter:
    """One parameter, as the library describes it: name, unit, doc, kind ("number" or "word"), least, largest, default.

    least, largest and default are None for words; the words allowed stand in `doc`.
    """

    def __init__(self, name, unit, doc, kind, least=None, largest=None, default=None):
        self.name = name
        self.unit = unit
        self.doc = doc
        self.kind = kind
        self.least = least
        self.largest = largest
        self.default = default

    def __repr__(self):
        return "Parameter(%r, unit=%r, kind=%r, least=%r, largest=%r, default=%r)" % (
            self.name, self.unit, self.kind, self.least, self.largest, self.default)


def _describe(handle, index):
    name, unit, doc = (call_for_text("npfem_param_" + what, handle, index) for what in ("name", "unit", "doc"))
    if call("npfem_param_kind", handle, index) == 1:
        return Parameter(name, unit, doc, "word")
    limits = [ctypes.c_double() for _ in range(3)]
    call("npfem_param_range", handle, index, *[ctypes.byref(limit) for limit in limits])
    return Parameter(name, unit, doc, "number", *[limit.value for limit in limits])


class Parameterised(Handle):
    """An object with parameters by key: `thing["key"]`, `thing["key"] = value`, `dict(thing)`, `thing.parameters()`."""

    def __init__(self, handle):
        super().__init__(handle)
        self._kinds = {}

    def parameters(self):
        """List of `Parameter`, in the library's order: what a host needs to build sliders."""
        return [_describe(self.handle, index) for index in range(call("npfem_param_count", self.handle))]

    def keys(self):
        """Names of all parameters."""
        return [call_for_text("npfem_param_name", self.handle, index)
                for index in range(call("npfem_param_count", self.handle))]

    def _is_word(self, key):
        if not self._kinds:
            self._kinds = {name: call("npfem_param_kind", self.handle, index) for index, name in enumerate(self.keys())}
        return self._kinds.get(key) == 1

    def __getitem__(self, key):
        if self._is_word(key):
            return call_for_text("npfem_get_text", self.handle, key.encode())
        value = ctypes.c_double()
        call("npfem_get_f64", self.handle, key.encode(), ctypes.byref(value))
        return value.value

    def __setitem__(self, key, value):
        if isinstance(value, str):
            call("npfem_set_text", self.handle, key.encode(), value.encode())
        else:
            call("npfem_set_f64", self.handle, key.encode(), value)

    def __iter__(self):
        return iter(self.keys())

    def __contains__(self, key):
        return key in self.keys()

    def update(self, **values):
        """Sets several parameters: `material.update(shear_modulus=3.0, skalak_C=20)`."""
        for key, value in values.items():
            self[key] = value
