"""The values that message fields accept."""

import numpy
from geometry_msgs.msg import Point
from sensor_msgs.msg import Image, JointState, LaserScan
from std_msgs.msg import Bool, Byte, Float64, Int8, String, UInt8

for make in (
    lambda: Point(x=1),
    lambda: Point(x="1"),
    lambda: Int8(data=200),
    lambda: UInt8(data=-1),
    lambda: Float64(data=5),
    lambda: String(data=5),
    lambda: Bool(data=1),
    lambda: Byte(data=b"a"),
    lambda: JointState(name=["a"], position=[1.0, 2.0]),
    lambda: JointState(position=numpy.array([1.0, 2.0])),
    lambda: JointState(position=["a"]),
    lambda: LaserScan(ranges=[1.0, 2.0]),
    lambda: Image(data=b"abc"),
):
    try:
        message = make()
        print(type(message).__name__)
    except Exception as error:
        print(type(error).__name__)
print(JointState(position=numpy.array([1.0, 2.0])).position)
