"""cmake/arrows.py must name what is wrong: each of its rules is broken once in a copy of the tree."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]


def answer(tree):
    done = subprocess.run([sys.executable, str(tree / "cmake" / "arrows.py")], capture_output=True, text=True)
    return done.returncode, done.stdout


def edit(file, pattern, replacement):
    text = file.read_text()
    changed = re.sub(pattern, replacement, text, count=1, flags=re.M)
    assert changed != text, f"{file}: nothing matches {pattern}"
    file.write_text(changed)


def include(file, header):
    edit(file, r"^#include", f'#include "strainwave/{header}"\n#include')


# What is broken, and what the script must say.
CASES = [
    (lambda tree: include(tree / "model/gear/gear.hpp", "common/threads/parallel.hpp"),
     "model/gear/gear.hpp: includes common/threads, which is not in USES of model/gear/CMakeLists.txt"),
    (lambda tree: edit(tree / "model/gear/CMakeLists.txt", "USES common/core", "USES common/core common/threads"),
     "model/gear/CMakeLists.txt: USES common/threads, of which nothing is included"),
    (lambda tree: (include(tree / "model/gear/gear.hpp", "model/tooth/backlash.hpp"),
                   edit(tree / "model/gear/CMakeLists.txt", "USES common/core", "USES common/core model/tooth")),
     "a circle of rooms: "),
    (lambda tree: include(tree / "model/gear/gear.hpp", "model/gear/fields.hpp"), "model/gear: a circle of files: "),
    (lambda tree: include(tree / "app/analyze.cpp", "model/flexspline/blas.hpp"),
     "app/analyze.cpp: includes blas.hpp, which is private in model/flexspline"),
    (lambda tree: include(tree / "app/analyze.cpp", "model/nowhere/gear.hpp"), "which is in no room"),
    (lambda tree: edit(tree / "docs/architecture.md", r"^\| 1 \|", "| 7 |"), "cmake/arrows.py --write puts it there"),
]


def main():
    with tempfile.TemporaryDirectory() as folder:
        for number, (spoil, sentence) in enumerate(CASES):
            tree = pathlib.Path(folder) / str(number)
            keep = shutil.ignore_patterns("build*", ".git", "*.toml", "reference", "pictures")
            for part in ("cmake", "common", "model", "optimize", "studies", "app", "docs"):
                shutil.copytree(SOURCE / part, tree / part, ignore=keep)
            spoil(tree)
            code, text = answer(tree)
            assert code == 1 and sentence in text, f"case {number}: wanted {sentence!r}, got {code}: {text}"
    print(f"{len(CASES)} broken trees named")


if __name__ == "__main__":
    main()
