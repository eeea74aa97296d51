"""The numbers that README.md and docs/ state of the seed gear are those of the program, to the digits that are printed.

usage: sentences_test.py PROGRAM

Each rule reads its numbers from the page, by a pattern whose groups are the numbers, and what they must be from
`analyze --json`. A row of the README's table with numbers that no rule reads is an error, and so is a rule that finds
nothing: a sentence that is reworded takes its rule along.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
GALLERY = SOURCE / "studies" / "gallery"


class Program:
    def __init__(self, path):
        self.path = path
        self.known = {}

    def analyze(self, gear, **keys):
        """The JSON result of a gallery gear with some keys of its file changed."""
        case = (gear, tuple(sorted(keys.items())))
        if case not in self.known:
            text = (GALLERY / gear).read_text()
            for key, value in keys.items():
                text, count = re.subn(rf"^{key} *=[^#\n]*", f"{key} = {value} ", text, flags=re.M)
                if count == 0 and key == "phases":
                    text, count = re.subn(r"^\[load\].*$", rf"\g<0>\n{key} = {value}", text, flags=re.M)
                if count != 1:
                    raise SystemExit(f"{gear}: {count} lines set {key}")
            with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
                file.write(text)
                file.flush()
                done = subprocess.run([self.path, "analyze", file.name, "--json"], capture_output=True, text=True)
            if done.returncode != 0:
                raise SystemExit(f"{gear} {keys}: exit code {done.returncode}: {done.stderr}")
            self.known[case] = json.loads(done.stdout)
        return self.known[case]


def load_at(result, torque):
    return next(load for load in result["load"] if abs(load["torque_nm"] - torque) < 1e-9)


def rules(program):
    seed = program.analyze("seed.toml")
    four = program.analyze("seed.toml", phases=4)
    coned = program.analyze("seed_coned.toml", phases=4)
    seven = load_at(seed, 7.0)
    one = load_at(seed, 1.0)
    first = one["phi_deg"][one["force_n"].index(max(one["force_n"]))]  # the tooth that carries most of a small load
    readme = "README.md"
    yield readme, r"\| least initial backlash \| ([\d.]+) µm at φ = ([\d.]+)°", [seed["backlash"]["min_um"], seed["backlash"]["min_phi_deg"]]
    yield readme, r"\| force of each disc on the cup after assembly \| ([\d.]+) N", [seed["assembly"]["contact_force_n"]]
    yield readme, r"\| first tooth to engage \| φ = ([\d.]+)°", [first]
    yield (readme, r"\| at 7 N·m: peak meshing force, engaged teeth a lobe \| ([\d.]+) N, (\d+) \(a tooth on the major axis\); ([\d.]+) N",
           [seven["peak_force_n"], sum(1 for force in seven["force_n"] if force > 0), load_at(four, 7.0)["peak_force_n"]])
    yield (readme, r"\| torsional stiffness \(secant at 7 N·m\), lost motion \| (\d+) N·m/rad, ([\d.]+)′",
           [(seed["stiffness"]["secant_nm_per_rad"], 10.0), seed["stiffness"]["lost_motion_arcmin"]])
    yield readme, r"the coned cup carries ([\d.]+) N on its worst tooth at 7 N·m", [load_at(coned, 7.0)["peak_force_n"]]
    heights = [program.analyze("seed.toml", flank_points=points) for points in (1, 5, 9, 17)]
    for torque in (1, 7, 11.5):
        pattern = rf"\| {re.escape(str(torque))} \|" + r" ([\d.]+) N \|" * 4
        yield "docs/seed-gear.md", pattern, [load_at(result, torque)["peak_force_n"] for result in heights]
    page = "docs/seed-gear.md"
    yield page, r"toothed cup: force of a disc \| ≈ [\d.]+ N \| ([\d.]+) N", [seed["assembly"]["contact_force_n"]]


def main():
    program = Program(sys.argv[1])
    wrong = []
    read = {}
    for page, pattern, values in rules(program):
        text = (SOURCE / page).read_text()
        found = re.search(pattern, text)
        if not found:
            wrong.append(f"{page}: no sentence like {pattern}")
            continue
        read.setdefault(page, []).append(found.span())
        for stated, value in zip(found.groups(), values):
            digits = len(stated.partition(".")[2])
            value, step = value if isinstance(value, tuple) else (value, 10.0**-digits)
            if abs(float(stated) - value) > 0.5 * step * (1 + 1e-9):
                line = text.count("\n", 0, found.start()) + 1
                wrong.append(f"{page}:{line}: {stated} is stated, the program says {value:.{digits + 3}f}")
    text = (SOURCE / "README.md").read_text()
    table = re.search(r"\| quantity \| value \|\n\|[-|]+\|\n((?:\|.*\n)+)", text)
    start = table.start(1)
    for row in table.group(1).splitlines(keepends=True):
        if re.search(r"\d", row) and not any(a < start + len(row) and start < b for a, b in read.get("README.md", [])):
            wrong.append(f"README.md: no rule reads the row {row.strip()}")
        start += len(row)
    print("\n".join(wrong) if wrong else f"{sum(map(len, read.values()))} sentences hold")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
