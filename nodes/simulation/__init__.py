"""A planar robot world on pymunk, without ROS: fixed 10 ms steps and one seeded generator make every run repeatable."""
