"""The images pane: a camera's picture in half-blocks or characters, at a rate that the terminal can take."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from bot_console.tui import keymap
from bot_console.tui.console.model import ConsoleSnapshot, GraphInfo
from bot_console.tui.console.sensors.camera_image import COMPRESSED, IMAGE
from bot_console.tui.console.sensors.camera_image import Picture as Seen
from bot_console.tui.panes.images import drawing
from bot_console.tui.panes.images.frame_limit import FrameLimit
from bot_console.tui.panes.pane import Pane
from bot_console.tui.text.figures import age_text
from bot_console.tui.widgets.picture import Picture
from bot_console.tui.widgets.placeholder import NO_PLACEHOLDER, Placeholder
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Choice, Option, matching_options
from bot_console.tui.widgets.static_text import StaticText
from textual.app import ComposeResult
from textual.events import Click

EMPTY = Placeholder(
    "Images show what cameras see; no topic of sensor_msgs/msg/Image or CompressedImage is published.",
    (("9", "See the topics"), ("8", "Start nodes"), ("?", "Help")),
)


class ImageView(Picture, can_focus=True):
    """Shows the picture; has the keyboard focus of the pane."""

    def on_click(self, event: Click) -> None:
        """Take the focus."""
        self.focus()


SILENT_AFTER_S = 5.0
"""Seconds without an image after which the one shown is marked as old."""
MAX_HEAD_ROWS = 4
"""Maximum rows of the line above the image, which also says why there is none."""


class ImagesPane(Pane):
    """Images of one topic."""

    TITLE = "Images"
    HELP = (
        "The newest image of a topic, scaled to the pane: two pixels per cell as half-blocks, or greys as letters\n"
        "(g), which take a fortieth of the bytes. At most 2 pictures per second (+ and - change that), and 5 kB per\n"
        "second on average: a picture that changes a lot is drawn less often. On a slow link the picture freezes, and\n"
        "Space fetches one. Depth and other 16- or 32-bit images range from black (the smallest value) to white."
    )
    SCOPES = ()
    BINDINGS = keymap.bindings("images")

    clock: Callable[[], float] = staticmethod(time.monotonic)
    """A monotonic clock (s); tests replace it with one that they step."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._graph = GraphInfo()
        self._problem = ""
        self._topic = ""
        self._asked: tuple[str, int, int] = ("", 0, 0)
        self._seen = Seen()
        self._shown: drawing.Pixels | None = None
        self._drawn: object = None
        self._frame_limit = FrameLimit()
        self._arrived: tuple[str, int, float] = ("", 0, float("-inf"))
        """The topic and number of the newest image, and when it arrived (s)."""
        self._live = True
        self._frozen = self._once = self._as_characters = False

    def compose(self) -> ComposeResult:
        """A line that describes the picture, the picture, and a prompt."""
        yield StaticText(id="images-head")
        yield ImageView(id="images-view")
        yield Prompt(id="images-prompt")

    @property
    def _view(self) -> ImageView:
        return self.query_one(ImageView)

    def focus_target(self) -> None:
        """Focus the picture."""
        self._view.focus()

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Show the first image topic until the user chooses another one."""
        self._graph, self._problem = snapshot.graph, snapshot.problem
        self._live = not snapshot.capabilities.live
        if not self._topic:
            self._topic = next(iter(self._topics()), "")
        self._poll()

    def _topics(self) -> list[str]:
        return [each.name for each in self._graph.topics if IMAGE in each.types or COMPRESSED in each.types]

    def tick(self) -> None:
        """Draw a new picture when the limit allows it; while hidden, receive nothing."""
        if self.display:
            self._poll()
        elif self._asked[0]:
            self._ask_for("", 0, 0)

    def _ask_for(self, topic: str, columns: int, rows: int) -> None:
        if self._asked != (topic, columns, rows):
            self._asked = (topic, columns, rows)
            self._arrived = topic, -1, self.clock()
            self.console.sensors.watch_image(topic, columns, rows)

    @property
    def _slow(self) -> bool:
        """Whether the terminal has not caught up with what was drawn before."""
        gate = getattr(self.host, "gate", None)
        return bool(gate is not None and gate.held_back)

    @property
    def _characters(self) -> bool:
        """Whether the picture is drawn as grey-scale characters."""
        return self._as_characters or self.host.no_color or bool(getattr(self.host, "plain", False))

    def _poll(self) -> None:
        size = self._view.size
        if not size.area:
            return
        if self._topic:
            self._ask_for(self._topic, size.width, size.height * 2)
        now, seen = self.clock(), self.console.sensors.picture()
        if (seen.topic, seen.count) != self._arrived[:2]:
            self._arrived = seen.topic, seen.count, now
        held = (self._frozen or self._slow) and not self._once
        if self._topic and seen.topic == self._topic and not held and (self._once or self._frame_limit.due(now)):
            self._draw(seen, now)
        self._show_text()

    def _draw(self, seen: Seen, now: float) -> None:
        view, as_characters = self._view, self._characters
        key = (seen, view.size, as_characters)
        if not seen.pixels or key == self._drawn:
            self._seen = seen
            if not seen.pixels:
                view.set_lines(())
            return
        self._once = False
        self._seen, self._drawn, before = seen, key, self._shown
        self._shown = drawing.steady(drawing.pixels_of(seen), before)
        draw = drawing.characters if as_characters else drawing.half_blocks
        self._frame_limit.drawn(now, drawing.cost(self._shown, before, coloured=not as_characters))
        view.set_lines(draw(self._shown, view.size.width, view.size.height))

    def _show_text(self) -> None:
        seen, topic = self._seen, self._topic
        self._view.show_placeholder(NO_PLACEHOLDER if topic else EMPTY)
        if not topic:
            text = self._problem
        elif seen.problem and seen.topic == topic:
            text = f"{topic}  {seen.problem}"
        elif not seen.count or seen.topic != topic:
            text = f"{topic}  no image yet"
        else:
            parts = [topic, f"{seen.width}x{seen.height} {seen.encoding}", *([seen.message] if seen.message else [])]
            text = "  ".join([*parts, self._state()])
        head = self.query_one("#images-head", StaticText)
        head.display = bool(text)
        head.show_whole(text, MAX_HEAD_ROWS)

    def _state(self) -> str:
        newer = self.console.sensors.picture().count - self._seen.count
        new = f", +{newer} new" if newer > 0 else ""
        silence = self.clock() - self._arrived[2]
        if self._live and silence >= SILENT_AFTER_S:
            return f"no new image for {age_text(silence)}"
        if self._slow:
            return f"slow link: frozen{new}; space fetches one picture"
        if self._frozen:
            return f"frozen{new}; space resumes"
        wait = self._frame_limit.wait(self.clock())
        if newer > 0 and wait > 2.0 / self._frame_limit.rate:
            return f"next picture in {wait:.0f} s (5 kB/s); g shows letters, which cost less"
        return f"at most {self._frame_limit.rate:g} a second"

    def on_picture_resized(self, event: Picture.Resized) -> None:
        """Request the picture in the new size."""
        event.stop()
        self._shown = self._drawn = None
        if self.display:
            self._poll()

    def go_to(self, name: str) -> None:
        """Show a topic."""
        self._choose(name)

    def _choose(self, topic: str) -> None:
        self._topic, self._shown, self._drawn, self._seen = topic, None, None, Seen()
        self._frame_limit = FrameLimit(self._frame_limit.rate)
        self._view.set_lines(())
        self._poll()

    def action_topic(self) -> None:
        """Choose a topic."""

        def find(typed: str) -> list[Option]:
            return matching_options(map(Option, self._topics()), typed)

        self.ask(Choice("Images of", self._choose, find=find, hint="type part of a topic", empty=EMPTY.sentence))

    def action_next(self) -> None:
        """Show the next topic."""
        topics = self._topics()
        if topics:
            at = topics.index(self._topic) if self._topic in topics else -1
            self._choose(topics[(at + 1) % len(topics)])

    def action_freeze(self) -> None:
        """Freeze or resume; on a slow link, fetch one picture."""
        if self._slow:
            self._once = True
        else:
            self._frozen = not self._frozen
        self._poll()

    def action_letters(self) -> None:
        """Switch between grey-scale characters and colours."""
        self._as_characters = not self._as_characters
        self._shown = None
        self._once = True
        self._poll()

    def action_rate(self, factor: float) -> None:
        """Multiply the maximum number of pictures per second by a factor."""
        self._frame_limit.change(factor)
        self._show_text()

    def action_copy(self) -> None:
        """Copy the `ros2` command that measures the rate of the images."""
        if self._topic:
            text = f"ros2 topic hz {self._topic}"
            self.host.copy_to_clipboard(text)
            self.notify(text, title="Copied")

    def detach(self) -> None:
        """Stop receiving images."""
        self.console.sensors.watch_image("", 0, 0)
