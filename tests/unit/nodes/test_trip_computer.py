import pytest
from bot_console_robot.trip_computer import Trip


def test_distance_and_stops_are_counted() -> None:
    trip = Trip()
    for i, speed in enumerate([0.0, 1.0, 1.0, 0.0, 0.0, -1.0, 0.0]):
        trip.update(i * 0.1, speed)
    assert trip.distance == pytest.approx(0.3)
    assert trip.stops == 2
    assert trip.speed == 0.0


def test_long_silence_adds_no_distance() -> None:
    trip = Trip()
    trip.update(0.0, 1.0)
    trip.update(10.0, 1.0)
    assert trip.distance == 0.0


def test_time_running_backwards_starts_again() -> None:
    trip = Trip()
    for time, speed in ((5.0, 1.0), (5.5, 1.0), (6.0, 0.0), (0.1, 0.5)):
        trip.update(time, speed)
    assert trip.distance == 0.0
    assert trip.stops == 0
    assert trip.speed == 0.5
