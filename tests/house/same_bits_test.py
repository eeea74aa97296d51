"""tests/same_bits.py must name a value that is off by a rounding, and what came or went."""
import json
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy

TOOL = pathlib.Path(__file__).resolve().parents[1] / "same_bits.py"
ALLOWED = """
[[allowed]]
where = "*:/seconds"
what = "value"
reason = "time"
[[allowed]]
where = "*.h5:/x@*"
what = "new"
reason = "an attribute that is new"
[[allowed]]
where = "/engaged$"
what = "renamed"
to = "/engaged_count"
reason = "another name"
[[allowed]]
where = "*:/roughly"
what = "value"
tolerance = 1e-9
reason = "last digits"
"""


def write(folder, tree, matrix, text, attribute):
    folder.mkdir()
    (folder / "result.json").write_text(json.dumps(tree))
    (folder / "deck.inp").write_text(text)
    with h5py.File(folder / "result.h5", "w") as file:
        file["x"] = matrix
        file["word"] = numpy.bytes_("unilateral") if attribute else "unilateral"
        if attribute:
            file["x"].attrs["format"] = 2


def compare(folder, old, new):
    (folder / "allowed").write_text(ALLOWED)
    done = subprocess.run([sys.executable, str(TOOL), "--allowed", str(folder / "allowed"), "case", str(folder / old),
                           str(folder / new)], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def main():
    matrix = numpy.array([[1.0, numpy.nan], [0.0, 3.0]])
    tree = {"seconds": 1.0, "force": [1.0, None, 2.5], "engaged": 6, "roughly": 1.0}
    renamed = {"seconds": 2.0, "force": [1.0, None, 2.5], "engaged_count": 6, "roughly": 1.0 + 1e-12}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write(folder / "old", tree, matrix, "a\nb\n", False)
        write(folder / "same", renamed, -0.0 + matrix, "a\nb\n", True)
        code, text = compare(folder, "old", "same")
        assert code == 0, text

        off = matrix.copy()
        off[1, 1] = numpy.nextafter(3.0, 4.0)
        poisoned = dict(renamed, force=[1.0, 0.0, 2.5], roughly=1.0 + 1e-6, extra=1)
        del poisoned["engaged_count"]
        write(folder / "off", poisoned, off, "a\nc\n", True)
        code, text = compare(folder, "old", "off")
        assert code == 1, text
        for place in ("case/result.h5:/x\n", "case/result.json:/force\n", "case/result.json:/roughly\n", "case/deck.inp:line 2\n",
                      "case/result.json:/extra\n    only in the new", "case/result.json:/engaged_count\n    only in the old"):
            assert place in text, f"{place!r} is not named in {text}"
        assert "case/result.h5:/word" not in text and "/seconds" not in text, text
    print("every poisoned place is named")


if __name__ == "__main__":
    main()
