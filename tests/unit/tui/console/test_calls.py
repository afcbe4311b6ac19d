"""How long the console waits for a response."""

import pytest
from bot_console.tui.console.calls import ANSWER_TIMEOUT_S, MIN_POLLS, Calls, NoAnswer
from rclpy.task import Future
from std_srvs.srv import Trigger


class StubNode:
    """A node whose client never gets a response, and whose timer fires when the test says so."""

    def __init__(self):
        self.answer, self.ready = Future(), True

    def create_client(self, kind, service):
        return self

    def service_is_ready(self):
        return self.ready

    def call_async(self, request):
        return self.answer

    def remove_pending_request(self, answer):
        pass

    def create_timer(self, period, fire):
        self.period, self.fire = period, fire

    def destroy_timer(self, timer):
        pass


def test_time_lost_by_the_console_itself_does_not_count_towards_the_timeout():
    node = StubNode()
    asking = Calls(node, None).ask(Trigger, "/wait", Trigger.Request())
    asking.send(None)
    assert node.period * MIN_POLLS == ANSWER_TIMEOUT_S
    for _ in range(MIN_POLLS - 1):
        node.fire()  # each may be arbitrarily late
        assert not node.answer.done()
    node.fire()
    with pytest.raises(NoAnswer, match=r"/wait did not answer within 5 s"):
        asking.send(None)


def test_request_without_an_answer_may_still_be_carried_out():
    node = StubNode()
    asking = Calls(node, None).ask(Trigger, "/slow", Trigger.Request())
    asking.send(None)
    for _ in range(MIN_POLLS):
        node.fire()
    with pytest.raises(NoAnswer, match=r"may still carry out the request$"):
        asking.send(None)


def test_slow_link_gets_more_time_even_if_it_became_slow_after_the_request():
    node, delays_s = StubNode(), [0.02, 4.6, *[0.02] * 17]
    asking = Calls(node, None, iter(delays_s).__next__).ask(Trigger, "/far", Trigger.Request())
    asking.send(None)
    for _ in delays_s[1:]:
        node.fire()
        assert not node.answer.done()
    node.fire()
    with pytest.raises(NoAnswer, match=r"/far did not answer within 19 s"):
        asking.send(None)


def test_a_server_that_disappears_is_reported_before_the_timeout():
    node = StubNode()
    asking = Calls(node, None).ask(Trigger, "/home", Trigger.Request(), 30.0)
    asking.send(None)
    assert node.period == 1.0
    for ready in (False, True, False):
        node.ready = ready
        node.fire()
        assert not node.answer.done(), "missing in a single poll, it may be restarting"
    node.fire()
    with pytest.raises(NoAnswer, match="/home went away before it answered; has its node ended"):
        asking.send(None)
