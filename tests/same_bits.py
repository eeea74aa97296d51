"""Compares what two programs wrote (tests/same_bits.sh): every value, but for a written list of allowed differences.

Every file becomes a table place → value; a place is "case/file:/key/of/json", "case/file.h5:/dataset", "…:/dataset@attribute"
or "case/deck.inp:line 17". Equal means equal as numbers and texts: NaN equals NaN, 0 equals -0, and a text is the same in
any string type of HDF5. TOML (files, and texts within results) is compared by key, so that its comments may change.
"""
import argparse
import fnmatch
import json
import math
import pathlib
import re
import sys
import tomllib

import h5py
import numpy

HDF5 = {".h5", ".hdf5", ".vtkhdf"}


def is_toml(text):
    """A gear or study file within a result."""
    return isinstance(text, str) and "\n" in text and re.search(r"^\[", text, re.M) is not None


def from_toml(place, text, table):
    try:
        parsed = tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        table[place] = text
        return
    from_tree(place + "#", parsed, table)


def from_tree(place, node, table):
    """Flattens JSON or TOML; a list of numbers stays one value."""
    if isinstance(node, dict):
        for key, value in node.items():
            from_tree(f"{place}/{key}", value, table)
    elif isinstance(node, list) and any(isinstance(item, (dict, list, str)) for item in node):
        table[f"{place}/length"] = len(node)
        for index, item in enumerate(node):
            from_tree(f"{place}/{index}", item, table)
    elif is_toml(node):
        from_toml(place, node, table)
    else:
        table[place] = node


def text_of(value):
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else value


def from_array(place, value, table):
    array = numpy.asarray(value)
    if array.dtype.kind in "SUO":
        if any(isinstance(item, (h5py.Reference, numpy.void, numpy.ndarray)) for item in array.ravel()):
            table[place] = "references"  # of dimension scales; what they refer to is compared by itself
            return
        texts = [text_of(item) for item in array.ravel().tolist()]
        from_tree(place, texts[0] if array.ndim == 0 else texts, table)
    elif array.dtype.names:
        for name in array.dtype.names:
            from_array(f"{place}.{name}", array[name], table)
    else:
        table[place] = array


def from_hdf5(place, file, table):
    def attributes(name, node):
        for key in node.attrs:
            from_array(f"{place}:/{name}@{key}", node.attrs[key], table)

    def visit(name, node):
        attributes(name, node)
        if isinstance(node, h5py.Dataset):
            empty = node.shape is None or node.size == 0
            from_array(f"{place}:/{name}", numpy.zeros(node.shape or 0) if empty else node[()], table)

    with h5py.File(file) as opened:
        attributes("", opened)
        opened.visititems(visit)


def read_table(case, folder):
    table = {}
    here = str(folder)
    for file in sorted(path for path in folder.rglob("*") if path.is_file()):
        place = f"{case}/{file.relative_to(folder)}"
        if file.suffix in HDF5:
            from_hdf5(place, file, table)
            continue
        text = file.read_text(errors="replace")
        if file.suffix == ".json":
            try:
                from_tree(f"{place}:", json.loads(text), table)
            except json.JSONDecodeError:
                table[place] = text
        elif file.suffix == ".toml":
            from_toml(place, text, table)
        else:
            for number, line in enumerate(text.splitlines(), 1):
                table[f"{place}:line {number}"] = line
    # Absolute names of the folder of a run, and of the gallery in it, say nothing.
    run = re.compile(r"/[^\s\"']*/run\.[A-Za-z0-9]{6}/?")
    for key, value in table.items():
        if isinstance(value, str):
            table[key] = run.sub("", value.replace(here + "/", ""))
    return table


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def as_numbers(value):
    """A float array, or nothing if this is not numbers. null among numbers of JSON is NaN."""
    if isinstance(value, numpy.ndarray):
        return value
    if is_number(value):
        return numpy.asarray(value)
    if isinstance(value, list) and all(item is None or is_number(item) for item in value):
        return numpy.asarray([math.nan if item is None else item for item in value])
    return None


def difference(old, new):
    """Nothing if they are equal; else a sentence, and the largest relative difference (infinite if not numbers)."""
    left, right = as_numbers(old), as_numbers(new)
    if left is None or right is None:
        same = type(old) is type(new) and old == new
        return None if same else (f"{shown(old)} → {shown(new)}", math.inf)
    if left.shape != right.shape:
        return f"shape {left.shape} → {right.shape}", math.inf
    left, right = left.astype(float).ravel(), right.astype(float).ravel()
    with numpy.errstate(invalid="ignore"):
        apart = ~((left == right) | (numpy.isnan(left) & numpy.isnan(right)))
    if not apart.any():
        return None
    with numpy.errstate(invalid="ignore", divide="ignore"):
        scale = max(numpy.nanmax(numpy.abs(numpy.where(numpy.isfinite(left), left, 0)), initial=0), 1e-300)
        far = numpy.where(apart, numpy.nan_to_num(numpy.abs(left - right), nan=math.inf), 0) / scale
    worst = int(numpy.argmax(far))
    where = "" if left.size == 1 else f"{int(apart.sum())} of {left.size} values; worst at {worst}: "
    return f"{where}{left[worst]!r} → {right[worst]!r}, relative to the largest {far[worst]:.2g}", float(far[worst])


def shown(value):
    text = repr(value.tolist() if isinstance(value, numpy.ndarray) else value)
    return text if len(text) <= 110 else text[:80] + " … " + text[-25:]


class Allowed:
    """One line of the list: which places, what kind of difference, up to which size, and why."""

    def __init__(self, entry):
        unknown = set(entry) - {"where", "what", "to", "tolerance", "reason"}
        if unknown or not entry.get("reason") or entry.get("what") not in ("value", "new", "gone", "renamed"):
            sys.exit(f"same_bits.allowed: {entry}: wanted are where, what (value, new, gone, renamed), reason, to, tolerance")
        self.where = entry["where"] if isinstance(entry["where"], list) else [entry["where"]]
        self.what, self.to, self.tolerance = entry["what"], entry.get("to", ""), entry.get("tolerance", math.inf)
        self.reason, self.count = entry["reason"], 0

    def covers(self, what, place, size):
        # [ and ] are meant literally: keys of studies hold them.
        hit = self.what == what and size <= self.tolerance and any(
            fnmatch.fnmatchcase(place, pattern.replace("[", "[[]")) for pattern in self.where)
        self.count += hit
        return hit


def rename(table, allowed):
    """Old places under their new names. where is a regular expression here, and to what takes its place."""
    for entry in allowed:
        if entry.what == "renamed":
            for pattern in entry.where:
                for place in list(table):
                    name = re.sub(pattern, entry.to, place)
                    if name != place and name not in table:
                        table[name] = table.pop(place)
                        entry.count += 1


def compare(old, new, allowed):
    """Differences that the list does not allow, as (place, sentence)."""
    rename(old, allowed)
    found = []
    for place in dict.fromkeys([*old, *new]):
        if place not in new:
            what, text, size = "gone", shown(old[place]), 0.0
        elif place not in old:
            what, text, size = "new", shown(new[place]), 0.0
        else:
            apart = difference(old[place], new[place])
            if apart is None:
                continue
            what, (text, size) = "value", apart
        if not any(entry.covers(what, place, size) for entry in allowed):
            found.append((place, text if what == "value" else f"only in the {'old' if what == 'gone' else 'new'} program: {text}"))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--allowed", required=True)
    parser.add_argument("--show", type=int, default=20)
    parser.add_argument("triples", nargs="+", help="CASE OLD_FOLDER NEW_FOLDER …")
    arguments = parser.parse_args()
    allowed = [Allowed(entry) for entry in tomllib.loads(pathlib.Path(arguments.allowed).read_text())["allowed"]]
    values, shown_count, cases, differing = 0, 0, 0, {}
    for case, old, new in zip(*[iter(arguments.triples)] * 3):
        left, right = read_table(case, pathlib.Path(old)), read_table(case, pathlib.Path(new))
        values, cases = values + len(left), cases + 1
        for place, text in compare(left, right, allowed):
            differing[case] = differing.get(case, 0) + 1
            shown_count += 1
            if shown_count <= arguments.show:
                print(f"{place}\n    {text}")
    if shown_count > arguments.show:
        print(f"… and {shown_count - arguments.show} more")
    for entry in allowed:
        if entry.count:
            print(f"allowed {entry.count} × {entry.what}: {entry.reason}")
    print(f"{values} places compared in {cases} cases")
    for case, count in differing.items():
        print(f"DIFFERENT: {case}: {count} places")
    print("not the same" if differing else "the same")
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
