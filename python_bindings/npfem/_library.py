# SPDX-License-Identifier: MPL-2.0
"""The shared library behind the package: where it is found, what it exports, how its errors become exceptions.

`SIGNATURES` mirrors npfem.h, one line per function; every function returns one int32, negative for an error. Nothing
else in the package names an argument type.
"""
import ctypes
import ctypes.util
import os
import sys

ABI_VERSION = 1

_I32 = ctypes.c_int32
_F64 = ctypes.c_double
_TEXT = ctypes.c_char_p                    # const char*
_BUFFER = ctypes.POINTER(ctypes.c_char)    # char*, written by the library
_I32S = ctypes.POINTER(ctypes.c_int32)
_I64S = ctypes.POINTER(ctypes.c_int64)
_F32S = ctypes.POINTER(ctypes.c_float)
_F64S = ctypes.POINTER(ctypes.c_double)

SIGNATURES = {
    "npfem_abi_version": (),
    "npfem_version": (_BUFFER, _I32),
    "npfem_build_info": (_BUFFER, _I32),
    "npfem_last_error": (_BUFFER, _I32),
    "npfem_status_name": (_I32, _BUFFER, _I32),
    "npfem_release": (_I32,),
    # parameters by key
    "npfem_param_count": (_I32,),
    "npfem_param_name": (_I32, _I32, _BUFFER, _I32),
    "npfem_param_unit": (_I32, _I32, _BUFFER, _I32),
    "npfem_param_doc": (_I32, _I32, _BUFFER, _I32),
    "npfem_param_kind": (_I32, _I32),
    "npfem_param_range": (_I32, _I32, _F64S, _F64S, _F64S),
    "npfem_set_f64": (_I32, _TEXT, _F64),
    "npfem_get_f64": (_I32, _TEXT, _F64S),
    "npfem_set_text": (_I32, _TEXT, _TEXT),
    "npfem_get_text": (_I32, _TEXT, _BUFFER, _I32),
    # mesh
    "npfem_mesh_create": (_F64S, _I32, _I32S, _I32),
    "npfem_mesh_generate": (_TEXT, _I32, _F64),
    "npfem_mesh_load": (_TEXT,),
    "npfem_mesh_save": (_I32, _TEXT),
    "npfem_mesh_vertex_count": (_I32,),
    "npfem_mesh_triangle_count": (_I32,),
    "npfem_mesh_get_positions": (_I32, _F64S, _I32),
    "npfem_mesh_get_triangles": (_I32, _I32S, _I32),
    "npfem_mesh_measure": (_I32, _TEXT, _F64S),
    # material
    "npfem_material_preset_count": (),
    "npfem_material_preset_name": (_I32, _BUFFER, _I32),
    "npfem_material_preset": (_TEXT,),
    "npfem_material_load": (_TEXT,),
    "npfem_material_parse": (_TEXT,),
    "npfem_material_to_text": (_I32, _BUFFER, _I32),
    "npfem_material_mesh": (_I32, _I32),
    # model
    "npfem_model_create": (_I32, _I32),
    "npfem_model_load_lineage": (_TEXT, _F64, _F64),
    "npfem_model_vertex_count": (_I32,),
    "npfem_model_triangle_count": (_I32,),
    "npfem_model_get_triangles": (_I32, _I32S, _I32),
    "npfem_model_get": (_I32, _TEXT, _F64S, _I32),
    "npfem_model_measure": (_I32, _TEXT, _F64S),
    "npfem_model_energy_count": (_I32,),
    "npfem_model_energy_name": (_I32, _I32, _BUFFER, _I32),
    # batch
    "npfem_batch_create": (_I32, _TEXT, _I32),
    "npfem_batch_cell_count": (_I32,),
    "npfem_batch_add": (_I32, _I32),
    "npfem_batch_remove": (_I32, _I32),
    "npfem_batch_set": (_I32, _TEXT, _I32, _I32, _F64S, _I32),
    "npfem_batch_get": (_I32, _TEXT, _I32, _I32, _F64S, _I32),
    "npfem_batch_get_f32": (_I32, _TEXT, _I32, _I32, _F32S, _I32),
    "npfem_batch_step": (_I32, _I32),
    "npfem_batch_step_for_ms": (_I32, _F64, _I32S),
    "npfem_batch_relax": (_I32,),
    "npfem_batch_evaluate": (_I32,),
    "npfem_batch_add_patch": (_I32, _I32S, _I32, _F64),
    "npfem_batch_clear_patches": (_I32,),
    "npfem_batch_get_status": (_I32, _I32, _I32, _I32S, _I32),
    "npfem_batch_get_iterations": (_I32, _I32, _I32, _I32S, _I32),
    "npfem_batch_get_residual": (_I32, _I32, _I32, _F64S, _I32),
    "npfem_batch_status_text": (_I32, _I32, _BUFFER, _I32),
    "npfem_batch_measure": (_I32, _TEXT, _I32, _I32, _F64S, _I32),
    "npfem_batch_state_hash": (_I32, _I32, _I32, _I64S, _I32),
    "npfem_batch_pack_length": (_I32,),
    "npfem_batch_pack": (_I32, _I32, _F64S, _I32),
    "npfem_batch_unpack": (_I32, _I32, _F64S, _I32),
    "npfem_request_stop": (_I32,),
}

_FILE_NAMES = {"win32": "npfem.dll", "darwin": "libnpfem.dylib"}
_loaded = {}


class Error(Exception):
    """A call that the library refused: `status` (negative), `name` of the status, and the library's own message."""

    def __init__(self, status, name, message):
        super().__init__(message)
        self.status = status
        self.name = name


def candidates():
    """Paths where the library is looked for, in order. NPFEM_LIBRARY, when set, is the only one."""
    named = os.environ.get("NPFEM_LIBRARY")
    if named:
        return [named]
    file_name = _FILE_NAMES.get(sys.platform, "libnpfem.so")
    package = os.path.dirname(os.path.abspath(__file__))
    source_tree = os.path.dirname(os.path.dirname(package))
    paths = [
        os.path.join(package, file_name),
        os.path.join(source_tree, "build", "release", "lib", file_name),
        os.path.join(source_tree, file_name),  # installed: <lib>/npfem-python/npfem beside <lib>/libnpfem.so
        os.path.join(sys.prefix, "lib", file_name),
    ]
    system = ctypes.util.find_library("npfem")
    return paths + ([system] if system else [])


def _open():
    """The first library found, as a CDLL; a library that is found but cannot be loaded is an error, not skipped."""
    tried = candidates()
    for path in tried:
        if os.path.isabs(path) and not os.path.exists(path):
            continue
        try:
            return ctypes.CDLL(path), path
        except OSError as error:
            raise ImportError("the npfem library %s cannot be loaded: %s" % (path, error)) from None
    raise ImportError("the npfem library was not found; looked at: %s. Build it, or set NPFEM_LIBRARY to its full path"
                      % ", ".join(tried))


def _declare(library, path):
    """Gives every function its types, after checking that the library is of the version this package needs."""
    missing = [name for name in SIGNATURES if not hasattr(library, name)]
    if "npfem_abi_version" in missing:
        raise ImportError("%s is not the npfem library: it has no npfem_abi_version()" % path)
    version = library.npfem_abi_version()
    if version != ABI_VERSION:
        raise ImportError("%s has version %d of the interface, this package needs version %d; install the two together"
                          % (path, version, ABI_VERSION))
    if missing:
        raise ImportError("%s is older than this package: it lacks %s" % (path, ", ".join(missing)))
    for name, argument_types in SIGNATURES.items():
        function = getattr(library, name)
        function.restype = ctypes.c_int32
        function.argtypes = argument_types


def library():
    """The loaded library; loaded at the first call, so that importing the package needs no library."""
    if "library" not in _loaded:
        opened, path = _open()
        _declare(opened, path)
        _loaded["library"] = opened
        _loaded["path"] = path
    return _loaded["library"]


def library_path():
    """Path of the library in use."""
    library()
    return _loaded["path"]


def call(name, *arguments):
    """Calls a function of the library; returns its result, raises `Error` where that is negative."""
    status = getattr(library(), name)(*arguments)
    if status < 0:
        raise Error(status, _text("npfem_status_name", status), _text("npfem_last_error"))
    return status


def _text(name, *arguments):
    """Text of a function that must not fail itself: status names and messages."""
    buffer = ctypes.create_string_buffer(4096)
    getattr(library(), name)(*(arguments + (buffer, len(buffer))))
    return buffer.value.decode("utf-8", "replace")


def call_for_text(name, *arguments):
    """Calls a function whose last two arguments are (char* buffer, int32_t capacity); returns the whole text."""
    capacity = 256
    while True:
        buffer = ctypes.create_string_buffer(capacity)
        length = call(name, *(arguments + (buffer, capacity)))
        if length < capacity:
            return buffer.value.decode("utf-8")
        capacity = length + 1


def version():
    """Version of the library, for example "0.1.0"."""
    return call_for_text("npfem_version")


def build_info():
    """What the library is, as JSON text: version, compiler, back ends."""
    return call_for_text("npfem_build_info")
