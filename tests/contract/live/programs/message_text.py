"""How messages print and compare."""

from geometry_msgs.msg import Point, Twist, Vector3
from sensor_msgs.msg import Range
from std_msgs.msg import Header, String

print(Twist())
print(Point(x=1.0, y=2.5))
print(String(data="it's") == String(data="it's"), String() == Vector3(), repr(Header(frame_id="map")))
print(Twist.get_fields_and_field_types())
print(Range.ULTRASOUND, Range(radiation_type=Range.INFRARED).radiation_type)
print(Twist.__slots__, [str(each) for each in Vector3.SLOT_TYPES][0].split(" ")[0][:40])
