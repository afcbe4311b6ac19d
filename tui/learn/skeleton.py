"""The skeleton of a course, for `learn --new`."""

from __future__ import annotations

from pathlib import Path

INDEX = """\
# My course

What the course is about, for those who choose it. Names that texts use until the student's own are known:

package = my_robot
node = my_node
"""
CHAPTER = """\
# A first chapter

What the chapter is about, in a sentence or two.

## A node with a parameter

Why this step matters. Then what to do:

```console
bot-console run my_node.py
```

```step
saw-node * with speed as node
saw-set speed 2.0 -- type `ros2 param set /{node} speed 2.0` in a second terminal
```

```grade 2 The node has a parameter speed
run my_robot my_node
expect-node /my_node
set /my_node speed 2.0
```
"""


def write_skeleton(folder: Path) -> list[Path]:
    """Write the skeleton into a new folder, and return its files; raises `OSError`, also if the folder exists."""
    folder.mkdir(parents=True)
    made = [folder / "course.md", folder / "01-first-chapter.md"]
    for path, text in zip(made, (INDEX, CHAPTER), strict=True):
        path.write_text(text, encoding="utf-8")
    return made
