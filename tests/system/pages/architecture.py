#!/usr/bin/env python3
"""Draws the topics of lib/ with their files, and which topic includes which, from the #include lines: doc/architecture.svg. Arrows that
follow from others are left out; a topic stands above all that it includes.

    architecture.py

Arrows to lower floors pass between the boxes of those in between.
"""

import html
import os
import re

from scenes import TOP

PATH = os.path.join(TOP, "doc", "architecture.svg")
LETTER, LINE, GAP = 5.7, 13, 60


def includes(path):
    """The topics that a file includes."""
    with open(path, encoding="utf-8") as file:
        return re.findall(r'^#\s*include\s+"([a-z_]+)/', file.read(), re.MULTILINE)


def topics():
    """Names of the files of each topic without suffix, and the topics it includes."""
    lib, files, uses = os.path.join(TOP, "lib"), {}, {}
    for topic in sorted(name for name in os.listdir(lib) if os.path.isdir(os.path.join(lib, name))):
        for folder, _, names in os.walk(os.path.join(lib, topic)):
            for name in names:
                stem, suffix = os.path.splitext(name)
                if suffix in (".h", ".cc"):
                    files.setdefault(topic, set()).add(os.path.join(os.path.relpath(folder, os.path.join(lib, topic)), stem).removeprefix("./"))
                    uses.setdefault(topic, set()).update(includes(os.path.join(folder, name)))
    return files, {topic: {used for used in uses[topic] if used in files and used != topic} for topic in files}


def below(topic, uses):
    """All topics that it needs."""
    found = set(uses[topic])
    for used in uses[topic]:
        found |= below(used, uses)
    return found


def floors(files, uses):
    """The topics of each floor, the lowest first."""
    level = {}

    def level_of(topic):
        if topic not in level:
            level[topic] = 1 + max((level_of(used) for used in uses[topic]), default=-1)
        return level[topic]

    for topic in files:
        level_of(topic)
    return [sorted(topic for topic in files if level[topic] == k) for k in range(max(level.values()) + 1)]


class Box:
    def __init__(self, topic, files, x, bottom):
        self.topic, self.files, self.x = topic, sorted(files), x
        self.columns = 1 if len(files) < 8 else 2 if len(files) < 20 else 3
        self.rows = -(-len(files) // self.columns)
        self.column = 16 + round(LETTER * max(map(len, files)))
        self.width, self.height = self.columns * self.column + 10, 24 + self.rows * LINE
        self.y = bottom - self.height

    def svg(self):
        lines = [f'<rect x="{self.x}" y="{self.y}" width="{self.width}" height="{self.height}" rx="5" fill="#f3f6fa" stroke="#4a6a8a"/>',
                 f'<text x="{self.x + 8}" y="{self.y + 16}" class="topic">{self.topic}</text>']
        for k, name in enumerate(self.files):
            lines.append(f'<text x="{self.x + 8 + k // self.rows * self.column}" y="{self.y + 31 + k % self.rows * LINE}">{html.escape(name)}</text>')
        return lines


def placed(files, levels):
    """{topic: Box}, floor above floor, and the width of the drawing."""
    boxes, bottom, widest = {}, 0, 0
    for floor in levels:
        x, highest = 10, 0
        for topic in floor:
            boxes[topic] = Box(topic, files[topic], x, bottom)
            x += boxes[topic].width + GAP
            highest = max(highest, boxes[topic].height)
        widest = max(widest, x - GAP + 10)
        bottom -= highest + GAP
    widest += 2 * GAP  # for arrows that pass beside the widest floor
    for floor in levels:  # in the middle
        shift = (widest - 10 - boxes[floor[-1]].x - boxes[floor[-1]].width) // 2
        for topic in floor:
            boxes[topic].x += shift
    return boxes, widest


class Gaps:
    """Places between the boxes of each floor and beside them, each of which an arrow takes once."""

    def __init__(self, levels, boxes):
        self.floors, self.taken = [[boxes[topic] for topic in floor] for floor in levels], set()

    def through(self, k, x):
        """The free place on floor k that is nearest to x, and the top and the bottom of the floor."""
        floor = self.floors[k]
        middles = [box.x - GAP // 2 for box in floor] + [floor[-1].x + floor[-1].width + GAP // 2]
        places = [middle + 6 * side for middle in middles for side in (0, 1, -1, 2, -2, 3, -3, 4, -4) if (k, middle + 6 * side) not in self.taken]
        place = min(places, key=lambda place: abs(place - x))
        self.taken.add((k, place))
        return place, min(box.y for box in floor), max(box.y + box.height for box in floor)


def arrow(a, b, passed, gaps):
    """The path from box a down to box b through the floors `passed`, from above."""
    x, y = a.x + a.width // 2, a.y + a.height
    end_x, end_y = b.x + b.width // 2, b.y
    path, start_x, start_y = f"M{x} {y}", x, y
    curve = lambda x1, y1, x2, y2: f" C{x1} {y1 + (y2 - y1) // 2} {x2} {y2 - (y2 - y1) // 2} {x2} {y2}"
    for k in passed:
        share = (gaps.floors[k][0].y - start_y) / (end_y - start_y)
        place, top, low = gaps.through(k, start_x + share * (end_x - start_x))
        path += curve(x, y, place, top) + f" L{place} {low}"
        x, y = place, low
    top = min(box.y for floor in gaps.floors if b in floor for box in floor)  # not across taller boxes beside b
    path += curve(x, y, end_x, top) + (f" L{end_x} {end_y}" if top < end_y else "")
    return f'<path d="{path}" fill="none" stroke="#b06030" marker-end="url(#head)"/>'


def draw():
    files, uses = topics()
    levels = floors(files, uses)
    boxes, widest = placed(files, levels)
    level, gaps = {topic: k for k, floor in enumerate(levels) for topic in floor}, Gaps(levels, boxes)
    top = min(box.y for box in boxes.values()) - 10
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{widest}" height="{10 - top}" viewBox="0 {top} {widest} {10 - top}">',
             "<style>text {font: 10px sans-serif} .topic {font: bold 13px sans-serif}</style>",
             '<defs><marker id="head" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
             '<path d="M0 0 L8 4 L0 8 z" fill="#b06030"/></marker></defs>',
             f'<rect x="0" y="{top}" width="{widest}" height="{10 - top}" fill="white"/>']
    for topic, used in uses.items():
        for other in sorted(other for other in used if not any(other in below(third, uses) for third in used)):
            lines.append(arrow(boxes[topic], boxes[other], range(level[topic] - 1, level[other], -1), gaps))
    for box in boxes.values():
        lines += box.svg()
    return "\n".join(lines + ["</svg>", ""])


def is_drawn():
    with open(PATH, encoding="utf-8") as file:
        return file.read() == draw()


if __name__ == "__main__":
    with open(PATH, "w", encoding="utf-8") as drawing:
        drawing.write(draw())
