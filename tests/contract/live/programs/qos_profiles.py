"""Profiles, their texts, comparisons and errors."""

from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    QoSCompatibility,
    QoSPresetProfiles,
    QoSProfile,
    ReliabilityPolicy,
    qos_check_compatible,
    qos_profile_sensor_data,
)

profile = QoSProfile(history=HistoryPolicy.KEEP_LAST, depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
print(profile.depth, profile.history, profile.reliability, profile.durability, profile.liveliness)
print(
    profile == qos_profile_sensor_data, QoSPresetProfiles.get_from_short_key("sensor_data") == qos_profile_sensor_data
)
print(DurabilityPolicy.get_from_short_key("transient_local"), ReliabilityPolicy.short_keys())
for call in (
    lambda: QoSProfile(),
    lambda: QoSProfile(depth=-1),
    lambda: QoSProfile(history="last", depth=1),
    lambda: QoSProfile(wrong=1, depth=1),
):
    try:
        print(call())
    except Exception as error:
        print(type(error).__name__)
reliable = QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE)
compatible, reason = qos_check_compatible(profile, reliable)
print(compatible == QoSCompatibility.ERROR, reason)
print(qos_check_compatible(reliable, profile)[0] == QoSCompatibility.OK)
