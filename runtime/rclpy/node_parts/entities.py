"""Creates and destroys a node's entities."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, Any

from bot_console.runtime.rmw.endpoints import (
    ClientEndpoint,
    Endpoint,
    Event,
    OnEvent,
    ServiceEndpoint,
    SubscriptionEndpoint,
    new_gid,
    queue_for,
)
from bot_console.runtime.rosidl.conversion import type_name
from rclpy._rclpy_pybind11 import RCLError
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.client import Client
from rclpy.constants import S_TO_NS
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.guard_condition import GuardCondition
from rclpy.node_parts.base import NodeBase
from rclpy.node_parts.topic_names import checked_name
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile, qos_profile_services_default
from rclpy.service import Service
from rclpy.subscription import Subscription
from rclpy.subscription_content_filter_options import ContentFilterOptions
from rclpy.timer import Rate, Timer
from rclpy.type_support import check_is_valid_msg_type, check_is_valid_srv_type

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import Message, ServiceType
    from rclpy.callback_groups import CallbackGroup
    from rclpy.clock import Clock
    from rclpy.impl.entity import Entity, EntityExecutor, EntityGroup
    from rclpy.impl.event_handlers import EventHandler
    from rclpy.node_parts.rosout import Rosout
    from rclpy.qos_overriding_options import QoSOverridingOptions
    from rclpy.waitable import Waitable


class NodeEntities(NodeBase):
    """The factory methods of `Node`."""

    _ros_publishers: dict[Publisher, None]
    _ros_waitables: dict[Waitable, None]
    _ros_rates: dict[Rate, Timer]
    _ros_rosout: Rosout | None

    def _ros_attach(self, executor: EntityExecutor, order: int) -> None:
        self._ros_sink, self._ros_order = executor, order
        for entity in [*self._ros_entities]:
            entity.attach(executor, order)

    def _ros_detach(self) -> None:
        self._ros_sink = None
        for entity in [*self._ros_entities]:
            entity.detach()

    def _ros_enter(self, entity: Entity, group: EntityGroup) -> None:
        """Register a new entity with this node, its callback group, and the node's executor."""
        self._ros_entities[entity] = None
        group.add_entity(entity)
        if self._ros_sink is not None:
            entity.attach(self._ros_sink, self._ros_order)

    def _ros_group(self, group: CallbackGroup | None) -> CallbackGroup:
        return self.default_callback_group if group is None else group

    def _ros_may_create(self, what: str) -> None:
        self._ros_use()
        if not self.context.ok():
            raise RCLError(f"Failed to create {what}: rcl node's context is invalid")

    @staticmethod
    def _ros_profile(qos: object) -> QoSProfile:
        if isinstance(qos, QoSProfile):
            return qos
        if isinstance(qos, int):
            if qos < 0:
                raise ValueError("history depth must be greater than or equal to zero")
            return QoSProfile(depth=qos)
        raise TypeError(f"Expected QoSProfile or int, but received {type(qos)!r}")

    def create_publisher(
        self,
        msg_type: type[Message],
        topic: str,
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: PublisherEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        publisher_class: type[Publisher] = Publisher,
    ) -> Publisher:
        """Create a publisher; an integer as QoS is a history depth."""
        qos = self._ros_profile(qos_profile)
        group = self._ros_group(callback_group)
        self._ros_may_create("publisher")
        name = checked_name(self, topic)
        check_is_valid_msg_type(msg_type)
        qos = self._ros_overridden(qos, name, qos_overriding_options, publisher=True)
        callbacks = event_callbacks or PublisherEventCallbacks()
        handlers = callbacks.create_event_handlers(group, self.get_logger, topic, qos)
        endpoint = Endpoint(self._ros_id, name, type_name(msg_type), qos, new_gid(), msg_type)
        made = self._ros_bus.create_publisher(endpoint, _event_reporter(handlers))
        made.on_publish = _listener(handlers)
        publisher = publisher_class(self, made, msg_type, topic, qos, handlers, group)
        self._ros_publishers[publisher] = None
        for handler in handlers:
            self._ros_enter(handler, group)
        return publisher

    def create_subscription(
        self,
        msg_type: type[Message],
        topic: str,
        callback: Callable[..., object],
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: SubscriptionEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: bool = False,
        content_filter_options: ContentFilterOptions | None = None,
    ) -> Subscription:
        """Create a subscription; the callback takes (message) or (message, info); with `raw`, the message is bytes.

        Messages that the content filter rejects are left out. Raises `RCLError` for an invalid filter.
        """
        qos = self._ros_profile(qos_profile)
        group = self._ros_group(callback_group)
        self._ros_may_create("subscription")
        name = checked_name(self, topic)
        check_is_valid_msg_type(msg_type)
        qos = self._ros_overridden(qos, name, qos_overriding_options, publisher=False)
        callbacks = event_callbacks or SubscriptionEventCallbacks()
        handlers = callbacks.create_event_handlers(group, self.get_logger, topic, qos)
        subscription = Subscription(self, msg_type, topic, callback, group, qos, raw, handlers)
        endpoint = Endpoint(self._ros_id, name, type_name(msg_type), qos, new_gid(), msg_type)
        subscription._join(
            SubscriptionEndpoint(
                endpoint, raw, queue_for(qos), _notifier(subscription, handlers), _event_reporter(handlers)
            )
        )
        if content_filter_options is not None:
            wanted = (content_filter_options.filter_expression, content_filter_options.expression_parameters)
            subscription._set_filter(ContentFilterOptions(*wanted), "create")
        for handler in handlers:
            self._ros_enter(handler, group)
        self._ros_enter(subscription, group)
        # Last, because messages arrive from now on, and the executor must know the subscription.
        self._ros_bus.create_subscription(subscription.endpoint)
        return subscription

    def _ros_overridden(
        self, qos: QoSProfile, name: str, options: QoSOverridingOptions | None, *, publisher: bool
    ) -> QoSProfile:
        if options is None:
            return qos
        from copy import copy

        from rclpy.qos_overriding_options import _declare_qos_parameters

        qos = copy(qos)
        _declare_qos_parameters(Publisher if publisher else Subscription, self, name, qos, options)
        return qos

    def create_service(
        self,
        srv_type: ServiceType,
        srv_name: str,
        callback: Callable[..., object],
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: CallbackGroup | None = None,
    ) -> Service:
        """Create a service server; the callback takes (request, response) and returns a response."""
        group = self._ros_group(callback_group)
        self._ros_may_create("service")
        check_is_valid_srv_type(srv_type)
        _check_service_qos(qos_profile)
        name = checked_name(self, srv_name, service=True)
        service = Service(self, srv_type, srv_name, callback, group, qos_profile)
        service.endpoint = ServiceEndpoint(self._ros_id, name, type_name(srv_type), service.notify, srv_type)
        self._ros_enter(service, group)
        self._ros_bus.create_service(service.endpoint)
        return service

    def create_client(
        self,
        srv_type: ServiceType,
        srv_name: str,
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: CallbackGroup | None = None,
    ) -> Client:
        """Create a service client."""
        group = self._ros_group(callback_group)
        self._ros_may_create("client")
        check_is_valid_srv_type(srv_type)
        _check_service_qos(qos_profile)
        name = checked_name(self, srv_name, service=True)
        client = Client(self, srv_type, srv_name, qos_profile, group)
        client.endpoint = ClientEndpoint(self._ros_id, name, type_name(srv_type), client.notify, srv_type)
        self._ros_enter(client, group)
        self._ros_bus.create_client(client.endpoint)
        return client

    def create_timer(
        self,
        timer_period_sec: float,
        callback: Callable[..., object] | None,
        callback_group: CallbackGroup | None = None,
        clock: Clock | None = None,
        autostart: bool = True,
    ) -> Timer:
        """Create a timer with a period (s) of a clock, by default the node's own."""
        period = int(float(timer_period_sec) * S_TO_NS)
        group = self._ros_group(callback_group)
        self.context.require_running("timer")
        timer = Timer(callback, group, period, clock or self.get_clock(), context=self.context, autostart=autostart)
        self._ros_enter(timer, group)
        return timer

    def create_guard_condition(
        self, callback: Callable[[], object] | None, callback_group: CallbackGroup | None = None
    ) -> GuardCondition:
        """Create a guard condition."""
        group = self._ros_group(callback_group)
        self.context.require_running("guard_condition")
        guard = GuardCondition(callback, group, context=self.context)
        self._ros_enter(guard, group)
        return guard

    def create_rate(self, frequency: float, clock: Clock | None = None) -> Rate:
        """Create a rate (Hz); it ticks while another thread spins the node."""
        if frequency <= 0:
            raise ValueError("frequency must be > 0")
        timer = self.create_timer(1.0 / frequency, None, ReentrantCallbackGroup(), clock)
        rate = Rate(timer, node=self)
        self._ros_rates[rate] = timer
        return rate

    def add_waitable(self, waitable: Waitable) -> None:
        """Add a waitable to the node."""
        self._ros_waitables[waitable] = None

    def remove_waitable(self, waitable: Waitable) -> None:
        """Remove a waitable from the node."""
        self._ros_waitables.pop(waitable, None)

    def destroy_publisher(self, publisher: Publisher) -> bool:
        """Destroy a publisher; returns whether it was one of this node's."""
        if publisher not in self._ros_publishers:
            return False
        del self._ros_publishers[publisher]
        for handler in publisher.event_handlers:
            self._ros_entities.pop(handler, None)
        publisher.destroy()
        return True

    def _ros_destroy(self, entity: Entity, kind: type) -> bool:
        if entity not in self._ros_entities or not isinstance(entity, kind):
            return False
        del self._ros_entities[entity]
        for handler in getattr(entity, "event_handlers", ()):
            self._ros_entities.pop(handler, None)
        entity.destroy()
        return True

    def destroy_subscription(self, subscription: Subscription) -> bool:
        """Destroy a subscription; returns whether it was one of this node's."""
        return self._ros_destroy(subscription, Subscription)

    def destroy_client(self, client: Client) -> bool:
        """Destroy a client; returns whether it was one of this node's."""
        return self._ros_destroy(client, Client)

    def destroy_service(self, service: Service) -> bool:
        """Destroy a service; returns whether it was one of this node's."""
        return self._ros_destroy(service, Service)

    def destroy_timer(self, timer: Timer) -> bool:
        """Destroy a timer; returns whether it was one of this node's."""
        return self._ros_destroy(timer, Timer)

    def destroy_guard_condition(self, guard: GuardCondition) -> bool:
        """Destroy a guard condition; returns whether it was one of this node's."""
        return self._ros_destroy(guard, GuardCondition)

    def destroy_rate(self, rate: Rate) -> bool:
        """Destroy a rate; returns whether it was one of this node's."""
        timer = self._ros_rates.pop(rate, None)
        if timer is None:
            return False
        rate.destroy()
        return self.destroy_timer(timer)

    def _ros_of(self, kind: type) -> list[Any]:
        return [each for each in self._ros_entities if isinstance(each, kind)]

    @property
    def publishers(self) -> Iterator[Publisher]:
        """The node's publishers, except the one of `/rosout`."""
        rosout = None if self._ros_rosout is None else self._ros_rosout.publisher
        yield from [each for each in self._ros_publishers if each is not rosout]

    @property
    def subscriptions(self) -> Iterator[Subscription]:
        """The node's subscriptions."""
        yield from self._ros_of(Subscription)

    @property
    def clients(self) -> Iterator[Client]:
        """The node's service clients."""
        yield from self._ros_of(Client)

    @property
    def services(self) -> Iterator[Service]:
        """The node's service servers."""
        yield from self._ros_of(Service)

    @property
    def timers(self) -> Iterator[Timer]:
        """The node's timers."""
        yield from self._ros_of(Timer)

    @property
    def guards(self) -> Iterator[GuardCondition]:
        """The node's guard conditions."""
        yield from self._ros_of(GuardCondition)

    @property
    def waitables(self) -> Iterator[Waitable]:
        """The node's waitables."""
        yield from list(self._ros_waitables)


def _check_service_qos(profile: object) -> None:
    """Raise `AttributeError` unless a service's QoS is a profile: only topics accept a depth."""
    if not isinstance(profile, QoSProfile):
        raise AttributeError(f"'{type(profile).__name__}' object has no attribute 'get_c_qos_profile'")


def _event_reporter(handlers: list[EventHandler]) -> OnEvent:
    """Return a function that passes a bus event to the handlers of its kind."""

    def report(kind: Event, what: object) -> None:
        for handler in handlers:
            if kind in handler.kinds:
                handler.on_event(kind, what)

    return report


def _listener(handlers: list[EventHandler]) -> Callable[[], None] | None:
    """Return a function that passes a message event to its handlers; None without any, as messages are frequent."""
    watching = [handler for handler in handlers if "message" in handler.kinds]
    return partial(_event_reporter(watching), "message", None) if watching else None


def _notifier(subscription: Subscription, handlers: list[EventHandler]) -> Callable[[], None]:
    heard = _listener(handlers)
    if heard is None:
        return subscription.notify

    def notify() -> None:
        heard()
        subscription.notify()

    return notify
