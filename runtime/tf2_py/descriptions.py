"""The tree of frames as text: for people, as YAML, and for Graphviz."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rclpy.constants import S_TO_NS
from tf2_py.frame_history import FrameHistory

NO_PARENT = "NO_PARENT"


def as_string(frames: Mapping[str, FrameHistory]) -> str:
    """Return a line for each frame that has, or had, a parent."""
    parents = {name: history.latest() for name, history in frames.items()}
    return "".join(
        f"Frame {name} exists with parent {each[1] if each else NO_PARENT}.\n" for name, each in parents.items()
    )


def as_yaml(frames: Mapping[str, FrameHistory]) -> str:
    """Return parent, broadcaster, rate (Hz) and times (s) of each frame."""
    texts: list[str] = []
    for name, history in frames.items():
        if (latest := history.latest()) is None:
            continue
        newest, oldest = span(history)
        texts.append(
            f"{name}: \n"
            f"  parent: '{latest[1]}'\n"
            f"  broadcaster: '{history.entries[-1][3]}'\n"
            f"  rate: {rate(history):.3f}\n"
            f"  most_recent_transform: {newest / S_TO_NS:.6f}\n"
            f"  oldest_transform: {oldest / S_TO_NS:.6f}\n"
            f"  buffer_length: {(newest - oldest) / S_TO_NS:.3f}\n"
        )
    return "".join(texts) if frames else "[]"


def span(history: FrameHistory) -> tuple[int, int]:
    """Return the newest and the oldest time (ns) of a frame that has transforms; 0 for a static frame."""
    return (0, 0) if history.is_static else (history.entries[-1][0], history.entries[history.first][0])


def rate(history: FrameHistory) -> float:
    """Return the rate of transforms (Hz); 10000 for a static frame, as upstream."""
    if history.is_static:
        return 10000.0
    entries = history.entries[history.first :]
    span = (entries[-1][0] - entries[0][0]) / S_TO_NS
    return len(entries) / max(span, 0.0001)


def as_dot(frames: Mapping[str, FrameHistory], names: Sequence[str] = (), now: int = 0) -> str:
    """Return a Graphviz graph with an arrow from each parent and, given a time (ns), the ages of transforms."""
    lines = [] if names or frames else ['"no tf data recieved"']
    roots: list[str] = []
    for name in names or frames:
        history = frames.get(name)
        latest = None if history is None else history.latest()
        if history is None or latest is None:
            if history is not None or now:
                roots.append(_legend(name, now))
            continue
        newest, oldest = span(history)
        age = f"( {(now - newest) / S_TO_NS:.3f} sec old)" if now else ""
        label = (
            f"Broadcaster: {history.entries[-1][3]}\\nAverage rate: {rate(history):.3f} Hz\\n"
            f"Most recent transform: {newest / S_TO_NS:.6f} {age}\\n"
            f"Buffer length: {(newest - oldest) / S_TO_NS:.3f} sec\\n"
        )
        lines.append(f'"{latest[1]}" -> "{name}"[label="{label}"];\n')
    return "digraph G {\n" + "".join(lines + roots) + "}"


def _legend(root: str, now: int) -> str:
    recorded = f'"Recorded at time: {now / S_TO_NS:.6f}"[ shape=plaintext ] ;\n ' if now else ""
    style = 'style=bold; color=black; label ="view_frames Result"'
    return f'edge [style=invis];\n subgraph cluster_legend {{ {style};\n{recorded}}}->"{root}";\n'
