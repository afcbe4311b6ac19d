"""A planar robot world on pymunk, without ROS. Fixed steps of 10 ms and one seeded generator make runs repeatable."""
