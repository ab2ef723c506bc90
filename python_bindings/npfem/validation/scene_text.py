# SPDX-License-Identifier: MPL-2.0
"""Scenes and materials as Python dictionaries, written as TOML."""
import json


def _value(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(item) for item in value) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join("%s = %s" % (key, _value(item)) for key, item in value.items()) + " }"
    return repr(value)


def quantity(value, unit):
    """"2.5 um": a number with its unit, every digit kept."""
    return "%r %s" % (float(value), unit)


def quantities(values, unit):
    """A list of them."""
    return [quantity(value, unit) for value in values]


def toml(tables):
    """The text of {"key": value, "table": {...}, "list of tables": [{...}, ...]}; tables within tables are inline."""
    lines, sections = [], []
    for key, value in tables.items():
        if isinstance(value, dict):
            sections.append(("[%s]" % key, value))
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            sections += [("[[%s]]" % key, item) for item in value]
        else:
            lines.append("%s = %s" % (key, _value(value)))
    for header, table in sections:
        lines += ["", header] + ["%s = %s" % (key, _value(value)) for key, value in table.items()]
    return "\n".join(lines) + "\n"
