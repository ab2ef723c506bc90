# SPDX-License-Identifier: MPL-2.0
"""The table of signatures and npfem.h say the same."""
import os
import re

from conftest import ROOT
from npfem import _library, batch

HEADER = os.path.join(ROOT, "capi", "include", "npfem", "npfem.h")
TYPES = {
    "int32_t": _library._I32,
    "double": _library._F64,
    "const char*": _library._TEXT,
    "char*": _library._BUFFER,
    "int32_t*": _library._I32S,
    "int64_t*": _library._I64S,
    "float*": _library._F32S,
    "double*": _library._F64S,
}


def header_text():
    with open(HEADER, encoding="utf-8") as stream:
        return re.sub(r"/\*.*?\*/", "", stream.read(), flags=re.DOTALL)


def argument_type(declaration):
    """The ctypes type of "const double* xyz"; constness matters for text only."""
    c_type = re.sub(r"\s*\b\w+$", "", " ".join(declaration.split()))
    return TYPES[c_type if c_type in TYPES else c_type.replace("const ", "")]


def declared():
    functions = {}
    for result, name, arguments in re.findall(r"NPFEM_API\s+(\w+)\s+(npfem_\w+)\s*\(([^)]*)\)\s*;", header_text()):
        assert result == "int32_t", name
        listed = [] if arguments.strip() == "void" else arguments.split(",")
        functions[name] = tuple(argument_type(argument) for argument in listed)
    return functions


def test_every_function_of_the_header_is_in_the_table_and_no_other():
    assert set(declared()) == set(_library.SIGNATURES)


def test_argument_types_agree():
    for name, types in declared().items():
        assert types == _library.SIGNATURES[name], name


def test_no_declaration_escapes_the_parser():
    # Once in the macro's definition per platform, once per function.
    macros = len(re.findall(r"#define\s+NPFEM_API\b", header_text()))
    assert len(re.findall(r"\bNPFEM_API\b", header_text())) == macros + len(_library.SIGNATURES)


def test_cell_statuses_agree():
    values = dict(re.findall(r"#define\s+NPFEM_CELL_(\w+)\s+(\d+)", header_text()))
    assert {name: int(value) for name, value in values.items()} == {
        name: getattr(batch, name)
        for name in ("CONVERGED", "ITERATION_CAP", "NOT_FINITE", "NO_DESCENT", "NOT_CONVERGED")}


def test_fields_agree():
    with open(HEADER, encoding="utf-8") as stream:
        block = re.search(r"Fields, per vertex.*?\*/", stream.read(), re.DOTALL).group(0)
    listed = {name: int(count) for name, count in re.findall(r"^ \*   (\w+)\s+(\d)\s", block, re.MULTILINE)}
    assert listed == batch.FIELDS
