"""Images: a topic is chosen, drawn within its limits, frozen, and drawn as characters where colours cost too much."""

from __future__ import annotations

from bot_console.tui.console.model import Capabilities
from bot_console.tui.console.sensors.camera_image import Picture
from bot_console.tui.panes.images.pane import SILENT_AFTER_S, ImagesPane, ImageView
from piloting import Session, run
from samples import empty, with_camera


def system():
    console, launcher = with_camera("front", "rear")
    console.sensors.shown = picture(200)
    return console, launcher


def picture(light: int, count: int = 1, topic: str = "/front/image") -> Picture:
    return Picture(topic, count, 640, 480, "mono8", 16, 12, bytes([light, light, light] * 16 * 12))


def drawn_lines(session: Session) -> str:
    return repr(session.pane(ImageView).lines)


async def pass_time(session: Session, seconds: float) -> None:
    pane = session.pane(ImagesPane)
    pane.clock.now += seconds
    pane.tick()
    await session.settle()


def test_first_topic_is_shown_in_half_blocks_and_n_shows_the_next() -> None:
    async def play(session: Session) -> None:
        await session.press("I")
        sensors = session.console.sensors
        width, height = session.pane(ImageView).size
        assert sensors.watching == ("/front/image", width, 2 * height)
        assert "/front/image  640x480 mono8" in session.text() and "on #cccccc" in drawn_lines(session)
        await session.press("n")
        assert sensors.watching[0] == "/rear/image" and "no image yet" in session.text()
        await session.press("t")
        await session.paste("front")
        await session.press("enter")
        assert sensors.watching[0] == "/front/image" and "640x480" in session.text()
        await session.press("1")
        session.pane(ImagesPane).tick()
        assert sensors.watching[0] == "", "hidden: nothing is received"

    run(system(), play)


def test_frame_rate_is_limited_and_freezing_stops_updates() -> None:
    async def play(session: Session) -> None:
        await session.press("I")
        session.console.sensors.shown = picture(40, 2)
        await pass_time(session, 0.3)
        assert "on #cccccc" in drawn_lines(session), "not before it is due"
        await pass_time(session, 0.3)
        assert "on #222222" in drawn_lines(session)
        await session.press("space")
        session.console.sensors.shown = picture(200, 5)
        await pass_time(session, 10.0)
        assert "on #222222" in drawn_lines(session) and "frozen, +3 new; space resumes" in session.text()
        await session.press("space")
        assert "on #cccccc" in drawn_lines(session)
        await session.press("minus", "minus")
        assert "at most 0.5 a second" in session.text()

    run(system(), play)


def test_picture_is_marked_as_old_when_no_more_images_arrive() -> None:
    async def play(session: Session) -> None:
        await session.press("I")
        await pass_time(session, SILENT_AFTER_S - 1.0)
        assert "no new image" not in session.text()
        await pass_time(session, 1.0)
        assert "no new image for 5 s" in session.text()
        session.console.sensors.shown = picture(40, 2)
        await pass_time(session, 1.0)
        assert "no new image" not in session.text() and "on #222222" in drawn_lines(session)
        session.console.change(capabilities=Capabilities(live="a bag"))
        await pass_time(session, 60.0)
        assert "no new image" not in session.text(), "the image of the moment that is inspected"

    run(system(), play)


def test_slow_link_freezes_the_image_and_space_fetches_one(monkeypatch) -> None:
    async def play(session: Session) -> None:
        await session.press("I")
        monkeypatch.setattr(type(session.app.gate), "held_back", 20)
        session.console.sensors.shown = picture(40, 3)
        await pass_time(session, 10.0)
        assert "on #cccccc" in drawn_lines(session) and "slow link: frozen, +2 new" in session.text()
        await session.press("space")
        assert "on #222222" in drawn_lines(session)

    run(system(), play)


def test_characters_are_used_on_request_and_on_plain_terminals() -> None:
    async def play(session: Session) -> None:
        await session.press("I", "g")
        assert "################" in session.text() and "#cccccc" not in drawn_lines(session)
        await session.press("g")
        assert "#cccccc" in drawn_lines(session)
        session.app.action_glyphs()
        session.console.sensors.shown = picture(200, 2)
        await pass_time(session, 1.0)
        assert "################" in session.text()

    run(system(), play)


def test_unsupported_image_explains_why() -> None:
    async def play(session: Session) -> None:
        session.console.sensors.shown = Picture("/front/image", count=1, problem="the encoding 'yuv' cannot be shown")
        await session.press("I")
        assert "/front/image  the encoding 'yuv' cannot be shown" in session.text()

    run(system(), play)


def test_long_explanation_is_whole_at_80_columns() -> None:
    why = "80 x 60 mono8 needs 80 bytes per row, 4800 in total; there are 10 and 4800"

    async def play(session: Session) -> None:
        session.console.sensors.shown = Picture("/front/image", count=1, problem=why)
        await session.press("I")
        await pass_time(session, 1.0)
        assert " ".join(session.text().replace("│", " ").split()).count(why) == 1

    run(system(), play, (80, 24))


def test_pane_explains_what_to_do_until_an_image_arrives() -> None:
    async def play(session: Session) -> None:
        await session.press("I")
        assert "8  Start nodes" in session.text()
        session.console.change(graph=system()[0].current.graph)
        await session.settle()
        assert "/front/image" in session.text() and "launch file" not in session.text()

    run(empty(), play)
