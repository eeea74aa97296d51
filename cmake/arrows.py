#!/usr/bin/env python3
"""The arrows between rooms: what the sources include, held against what their CMakeLists.txt says (strainwave_room).

    cmake/arrows.py            check; exit code 1 with one line for each thing that is wrong
    cmake/arrows.py --table    print the table of docs/architecture.md
    cmake/arrows.py --write    put the table into docs/architecture.md
    cmake/arrows.py --units    also find circles between the units of a room: x.hpp together with x.cpp

Wanted: no circle between rooms; none between the headers of a room; every included room is in USES and every
room in USES is included; a private header is included in its own room only; the table in docs/architecture.md is this one.
Python's standard library only.
"""
import argparse
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ("common", "model", "optimize", "surrogates", "studies")
KEYWORDS = ("USES", "LIBRARIES", "PRIVATE", "PRIVATE_HEADERS", "EXCEPT", "ALONE")
# Written by CMake, with their rooms.
GENERATED = {"version.hpp": "common/core"}
BEGIN, END = "<!-- arrows.py: begin -->", "<!-- arrows.py: end -->"
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*["<]strainwave/([^">]+)[">]', re.M)


def room_of(include):
    """model/gear/gear.hpp → its room and its name."""
    room, _, header = include.rpartition("/")
    return GENERATED.get(include, room), header


class Room:
    """What a CMakeLists.txt says about its folder."""

    def __init__(self, name, text):
        self.name = name
        comment = re.match(r"((?:#.*\n)+)", text)
        words = " ".join(line.lstrip("# ") for line in comment.group(1).splitlines()) if comment else ""
        sentence = re.match(r"[^:]*: (.*?[.])(?= |$)", words)
        self.sentence = sentence.group(1) if sentence else ""
        self.lists = {keyword: set() for keyword in KEYWORDS}
        body = re.sub(r"#.*", "", re.search(r"strainwave_room\(([^)]*)\)", text).group(1))
        keyword = None
        for word in body.split():
            if word in KEYWORDS:
                keyword = word
            else:
                self.lists[keyword].add(word)
        folder = ROOT / name
        self.files = sorted([*folder.glob("*.hpp"), *folder.glob("*.cpp")])

    @property
    def uses(self):
        return self.lists["USES"]


def read_rooms():
    rooms = {}
    for folder in FOLDERS:
        for file in sorted((ROOT / folder).rglob("CMakeLists.txt")):
            text = file.read_text()
            if re.search(r"^strainwave_room\(", text, re.M):
                name = file.parent.relative_to(ROOT).as_posix()
                rooms[name] = Room(name, text)
    return rooms


def outside_files():
    """Sources that are no room's: they may use any public header."""
    for folder in ("app", "bench", "examples", "tests"):
        for file in sorted((ROOT / folder).rglob("*.[ch]pp")):
            yield file


def circle_in(arrows):
    """A circle as a list of names, or nothing. arrows: name → names."""
    state, path = {}, []

    def visit(name):
        state[name] = "open"
        path.append(name)
        for other in sorted(arrows.get(name, ())):
            if state.get(other) == "open":
                return path[path.index(other):] + [other]
            if other not in state:
                found = visit(other)
                if found:
                    return found
        path.pop()
        state[name] = "done"
        return None

    for name in sorted(arrows):
        if name not in state:
            found = visit(name)
            if found:
                return found
    return None


def check_rooms(rooms, with_sources):
    """The rooms' own includes; with_sources: circles through sources too. Gives the arrows found as room → rooms."""
    wrong, arrows = [], {name: set() for name in rooms}
    for name, room in rooms.items():
        units, where = {}, {}
        for file in room.files:
            here = file.relative_to(ROOT)
            for include in INCLUDE.findall(file.read_text()):
                target, header = room_of(include)
                if target not in rooms:
                    wrong.append(f"{here}: includes strainwave/{include}, which is in no room")
                elif target == name:
                    if pathlib.Path(header).stem != file.stem and (with_sources or file.suffix == ".hpp"):
                        units.setdefault(file.stem, set()).add(pathlib.Path(header).stem)
                else:
                    arrows[name].add(target)
                    where.setdefault(target, here)
                    if header in rooms[target].lists["PRIVATE_HEADERS"]:
                        wrong.append(f"{here}: includes {header}, which is private in {target}")
        for target in sorted(arrows[name] - room.uses):
            wrong.append(f"{where[target]}: includes {target}, which is not in USES of {name}/CMakeLists.txt")
        for target in sorted(room.uses - arrows[name]):
            wrong.append(f"{name}/CMakeLists.txt: USES {target}, of which nothing is included")
        for header in sorted(room.lists["PRIVATE_HEADERS"]):
            if not (ROOT / name / header).exists():
                wrong.append(f"{name}/CMakeLists.txt: there is no {header}")
        circle = circle_in(units)
        if circle:
            wrong.append(f"{name}: a circle of files: {' → '.join(circle)}")
    circle = circle_in(arrows)
    if circle:
        wrong.append(f"a circle of rooms: {' → '.join(circle)}")
    return wrong, arrows


def check_outside(rooms):
    wrong = []
    for file in outside_files():
        here = file.relative_to(ROOT)
        for include in INCLUDE.findall(file.read_text()):
            target, header = room_of(include)
            if target not in rooms:
                wrong.append(f"{here}: includes strainwave/{include}, which is in no room")
            # A room's own tests reach into it.
            elif header in rooms[target].lists["PRIVATE_HEADERS"] and not here.as_posix().startswith(f"tests/{target}/"):
                wrong.append(f"{here}: includes {header}, which is private in {target}")
    return wrong


def floors_of(arrows):
    floors = {}

    def floor(name):
        if name not in floors:
            floors[name] = 0
            floors[name] = 1 + max((floor(other) for other in arrows[name]), default=0)
        return floors[name]

    for name in arrows:
        floor(name)
    return floors


def table_of(rooms, arrows):
    floors = floors_of(arrows)
    lines = ["| floor | room | what it is | uses |", "|---|---|---|---|"]
    for name in sorted(rooms, key=lambda name: (floors[name], FOLDERS.index(name.split("/")[0]), name)):
        uses = ", ".join(sorted(arrows[name], key=lambda other: (FOLDERS.index(other.split("/")[0]), other))) or "–"
        lines.append(f"| {floors[name]} | `{name}` | {rooms[name].sentence} | {uses} |")
    lines.append("")
    lines.append(f"{len(rooms)} rooms, {sum(map(len, arrows.values()))} arrows, {max(floors.values())} floors.")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--table", action="store_true", help="print the table of docs/architecture.md")
    parser.add_argument("--write", action="store_true", help="put the table into docs/architecture.md")
    parser.add_argument("--units", action="store_true", help="also find circles between the units of a room")
    arguments = parser.parse_args()
    rooms = read_rooms()
    wrong, arrows = check_rooms(rooms, arguments.units)
    if circle_in(arrows):
        print("\n".join(wrong))
        return 1
    table = table_of(rooms, arrows)
    if arguments.table:
        print(table)
        return 0
    page = ROOT / "docs" / "architecture.md"
    text = page.read_text()
    begin, end = text.index(BEGIN) + len(BEGIN), text.index(END)
    if arguments.write:
        page.write_text(text[:begin] + "\n" + table + "\n" + text[end:])
        return 0
    wrong += check_outside(rooms)
    for name, room in rooms.items():
        if not room.sentence:
            wrong.append(f"{name}/CMakeLists.txt: its first line says what the room is: \"# Name: sentence.\"")
    if text[begin:end].strip() != table.strip():
        wrong.append("docs/architecture.md: the table of rooms is not that of the tree; cmake/arrows.py --write puts it there")
    print("\n".join(wrong) if wrong else f"{len(rooms)} rooms, {sum(map(len, arrows.values()))} arrows, no circle")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
