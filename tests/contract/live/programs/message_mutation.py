"""Messages keep references to the values they are given."""

from geometry_msgs.msg import Pose, Twist
from std_msgs.msg import Float64MultiArray

twist = Twist()
linear = twist.linear
linear.x = 2.0
print(twist.linear.x, twist.linear is linear)
values = [1.0, 2.0]
array = Float64MultiArray(data=values)
values.append(3.0)
print(list(array.data))
array.data.append(4.0)
print(list(array.data), type(array.data).__name__)
first, second = Pose(), Pose()
first.position.x = 1.0
print(second.position.x, first == second)
